"""Claims about the summary for a pull request: what stands in which part, line by line."""

from __future__ import annotations

import dataclasses
from typing import Any

import pytest

from tests.support.fabricated import entry, record
from tests.support.fabricated import manifest as manifest_of
from vv.ask import Knobs
from vv.output.markdown import headline, summary
from vv.records.finding import Aspect, Bit, Finding
from vv.records.recorded import RecordedResult


def told(kind: str, text: str, **of: Any) -> Finding:
    given = {"check": Aspect.ACCURACY, "case": "bounce", "variant": "T1", "label": "a/a", **of}
    return Finding(kind=kind, text=text, **given)


def test_a_summary_has_each_finding_in_its_part_and_each_number_in_its_place() -> None:
    made = [record("a/a", "T1", 1e-3, quantities=[entry(verdict, {"max": 1e-4})])
            for verdict in ("pass", "pass", "fail")]  # fmt: skip
    findings = [
        told("worse", "error 2e-5", check=Aspect.REGRESSION, bit=Bit.ACCURACY, size=3.0),
        told("better", "error 1e-5", check=Aspect.REGRESSION, size=2.0, case="fall"),
        told("no baseline", "none yet", check=Aspect.REGRESSION, variant="", label=""),
        told("fail", "too far", bit=Bit.ACCURACY, variant="T2", size=9.0),
        told("slower", "for show", bit=Bit.SPEED, enforced=False, label="b/b"),
        told("expiring", "soon | now", variant="T1"),
        told("expiring", "soon | now", variant="T2"),
        told("expiring", "later"),
    ]
    kept = [RecordedResult("bounce", "T1", "fate", "z", Knobs(), "", "7", "2025", days, None, {})
            for days in (12, 12)]  # fmt: skip
    whole = manifest_of(*made, recorded=tuple(kept))
    assert summary(whole, findings).splitlines() == [
        "### Verification: red (1): accuracy or regression",
        "",
        "2 pass, 1 fail. commit `c0ffeec0f` with changes, 2025-01-01T00:00:00+00:00.",
        "",
        "**Changed since the baseline** (2)",
        "",
        "| | where | what |",
        "|-|-|-|",
        "| **worse** | bounce:T1 a/a | error 2e-5 |",
        "| better | fall:T1 a/a | error 1e-5 |",
        "",
        "**Out of tolerance, stopped or missing** (2)",
        "",
        "| | where | what |",
        "|-|-|-|",
        "| **fail** | bounce:T2 a/a | too far |",
        "| slower | bounce:T1 b/b | for show |",
        "",
        "- bounce: none yet",
        "- bounce: soon \\| now (2 times)",
        "- bounce: later",
        '- fall became better: `vv accept fall --reason "..."` keeps it',
        "- fate is not installed: the report shows results of 7 recorded 12 days ago, which do not "
        "affect the verdict here",
    ]
    nowhere = dataclasses.replace(whole.provenance, commit="", dirty=False)
    bare = dataclasses.replace(whole, provenance=nowhere, recorded=())
    assert summary(bare, []).splitlines() == [
        "### Verification: green", "", "2 pass, 1 fail. 2025-01-01T00:00:00+00:00."
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("bit", "word"),
    [
        (Bit.ACCURACY, "red (1): accuracy or regression"),
        (Bit.CONSERVATION, "red (2): conservation"),
        (Bit.SPEED, "red (4): speed"),
        (Bit.CRASH, "red (8): crash or divergence"),
        (Bit.TIMEOUT, "red (16): timeout"),
        (Bit.INCOMPLETE, "red (32): incomplete"),
        (Bit.SPEED | Bit.CRASH, "red (12): speed, crash or divergence"),
        (Bit(0), "green"),
    ],
)
def test_a_headline_has_the_exit_status_and_a_word_for_each_of_its_bits(
    bit: Bit, word: str
) -> None:
    assert headline([told("it", "is", bit=bit)]) == word


@pytest.mark.parametrize(("count", "rows", "more"), [(15, 15, ""), (17, 15, "2 more")])
def test_a_part_of_a_summary_has_fifteen_rows_and_says_how_many_more_there_are(
    count: int, rows: int, more: str
) -> None:
    red = [told("fail", f"red {n}", bit=Bit.ACCURACY) for n in range(count)]
    notes = [told("expiring", f"note {n}") for n in range(count)]
    lines = summary(manifest_of(), [*red, *notes]).splitlines()
    assert f"**Out of tolerance, stopped or missing** ({count})" in lines
    assert sum("| red " in line for line in lines) == rows
    assert sum(": note " in line for line in lines) == rows
    assert (f"| | | and {more}: see the report |" in lines, f"- and {more}" in lines) == (
        bool(more),
    ) * 2
