"""Claims about the lines on findings: which are merged, marked, and run again by what command."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from tests.support.fabricated import record
from vv.case import Level
from vv.insight.diagnosis import Diagnosis, Pattern
from vv.output.finding_lines import SHOWN, THAN, folded, lines, rerun, since_accepted
from vv.records.finding import Aspect, Bit, Finding


def found(text: str, **of: Any) -> Finding:
    given = {"check": Aspect.ACCURACY, "kind": "fail", "case": "bounce", "variant": "T1",
             "label": "a/x", "rung": "dt=0.001", "quantity": "y", "bit": Bit.ACCURACY}  # fmt: skip
    return Finding(text=text, **{**given, **of})


def said(*findings: Finding, **of: Any) -> list[str]:
    return [*lines(findings, of.pop("records", ()), of.pop("level", Level.DEFAULT), **of)]


@pytest.mark.parametrize(
    ("differs", "merged"),
    [
        ({}, True),
        ({"rung": "dt=0.002"}, True),
        ({"enforced": False}, False),
        ({"check": Aspect.CONSERVATION}, False),
        ({"kind": "xpass"}, False),
        ({"case": "fall"}, False),
        ({"variant": "T2"}, False),
        ({"label": "a/y"}, False),
        ({"quantity": "z"}, False),
    ],
)
def test_findings_that_differ_in_their_setting_alone_are_one(
    differs: dict[str, Any], merged: bool
) -> None:
    one, other = found("one", size=2.0), found("one", **{"size": 1.0, **differs})
    piles = [(pile.finding, pile.others) for pile in folded([other, one])]
    assert piles == ([(one, 1)] if merged else [(one, 0), (other, 0)])


def test_cases_without_a_baseline_are_one_line_that_counts_the_others() -> None:
    bare = {"check": Aspect.REGRESSION, "kind": "no baseline", "bit": Bit(0), "variant": "",
            "label": "", "rung": "", "quantity": ""}  # fmt: skip
    none = [found("no baseline", case=case, **bare) for case in ("bounce", "fall", "slide")]
    assert said(*none) == ["note: bounce and 2 more: no baseline"]
    assert said(*none[:1]) == ["note: bounce: no baseline"]


def test_a_line_says_whether_it_is_red_and_at_how_many_settings() -> None:
    assert said(found("far")) == ["red: bounce:T1 a/x dt=0.001 y: far"]
    assert said(found("far", enforced=False)) == ["reported only: bounce:T1 a/x dt=0.001 y: far"]
    (line,) = said(found("far", bit=Bit(0)), found("far", bit=Bit(0), rung="kn=1"))
    assert line == "note: bounce:T1 a/x dt=0.001 y: far (and at 1 more setting)"
    (line,) = said(*(found("far", rung=f"dt={n}") for n in (1, 2, 3)))
    assert line == "red: bounce:T1 a/x dt=1 y: far (and at 2 more settings)"
    assert said(Finding(Aspect.RUN, "nothing ran", "nothing ran", bit=Bit.INCOMPLETE)) == [
        "red: nothing ran"
    ]


@pytest.mark.parametrize("kind", ["worse", "better", "moved", "slower", "faster"])
def test_a_change_is_told_by_its_own_word(kind: str) -> None:
    told = since_accepted(found("it was 1", kind=kind))
    assert told.startswith(f"bounce:T1 a/x dt=0.001 y: {kind} ")
    assert told.endswith(" accepted: it was 1")
    assert kind in THAN
    assert since_accepted(found("far")) == "bounce:T1 a/x dt=0.001 y: far"
    assert since_accepted(found("now: no", kind="refused otherwise")).endswith(
        "y: not supported, for another reason: now: no"
    )


def test_below_what_is_red_stand_its_command_and_once_the_pattern_of_its_scheme() -> None:
    made = [record(label, "T1", 1e-3) for label in ("a/x", "a/y")]
    looks = [Diagnosis("bounce", "a/x", Pattern.STUCK, "it is late"),
             Diagnosis("bounce", "a/y", Pattern.STUCK, "it is early")]  # fmt: skip
    red = found("far", size=3.0), found("far", quantity="z", size=2.0)
    shown = found("far", label="a/y", enforced=False)
    assert said(*red, shown, records=made, patterns=looks) == [
        "red: bounce:T1 a/x dt=0.001 y: far",
        "  again: vv run bounce:T1 --codes a/x --rung dt=0.001",
        "  pattern: it is late",
        "red: bounce:T1 a/x dt=0.001 z: far",
        "  again: vv run bounce:T1 --codes a/x --rung dt=0.001",
        "reported only: bounce:T1 a/y dt=0.001 y: far",
    ]


@pytest.mark.parametrize(("more", "red"), [(0, 0), (1, 0), (3, 2)])
def test_of_more_than_twelve_the_rest_is_counted_with_its_red_ones(more: int, red: int) -> None:
    first = SHOWN + red
    many = [found("far", quantity=f"q{n}", size=50.0 - n, enforced=n < first)
            for n in range(SHOWN + more)]  # fmt: skip
    head, rest = said(*many)[:SHOWN], said(*many)[SHOWN:]
    assert all(line.startswith("red: ") for line in head)
    assert rest == [f"and {more} more, {red} of them red; the report has them all"] * bool(more)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({}, "vv run bounce:T1 --codes a/x --rung dt=0.001"),
        ({"level": Level.QUICK}, "vv run bounce:T1 --codes a/x --rung dt=0.001"),
        ({"level": Level.PAPER}, "vv run bounce:T1 --codes a/x --rung dt=0.001 --level paper"),
        ({"program": "my own.toml"}, "vv run bounce:T1 --codes 'my own.toml/x' --rung dt=0.001"),
        ({"modified": True}, "vv run bounce:T1 --codes a/x --rung dt=0.001 --set m=0.1234567891"),
        ({"check": Aspect.SPEED}, ""),
        ({"variant": "T2"}, ""),
        ({"dt": None}, "vv run bounce:T1 --codes a/x"),
    ],
)
def test_the_command_runs_the_result_of_a_finding_again(
    changes: dict[str, Any], words: str
) -> None:
    dt = changes.get("dt", 1e-3)
    one = record("a/x", "T1", dt, parameters={"m": 0.1234567891},
                 modified=changes.get("modified", False))  # fmt: skip
    setting = "" if dt is None else "dt=0.001"
    named = {"a": Path(changes["program"])} if "program" in changes else {}
    wrong = found("far", rung=setting, variant=changes.get("variant", "T1"),
                  check=changes.get("check", Aspect.ACCURACY))  # fmt: skip
    at = {("bounce", "T1", "a/x", setting): one}
    assert rerun(wrong, at, changes.get("level", Level.DEFAULT), named) == words
