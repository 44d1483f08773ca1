"""Claims about when a run that is to end at the first failure ends."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from tests import ROOT
from tests.support.fabricated import entry, record, some
from vv.case import Check
from vv.gate import first_failure
from vv.plan.project import Project
from vv.records.job_record import Record

FAILS = first_failure.is_failure(Project(ROOT))
KNOWN = """
[[disagreement]]
code = "dem"
schemes = "*"
versions = "*"
case = "bounce"
variants = ["T1"]
quantity = "y"
dt = 1e-3
error = [0.5, 2.0]
reason = "drag is late"
expires = 2999-01-01
"""
BROKEN = """
[[breach]]
code = "dem"
schemes = "*"
versions = "*"
case = "bounce"
variants = ["T1"]
law = "penetration *"
rungs = ["*"]
breach = [0.01, 0.02]
reason = "soft springs"
expires = 2999-01-01
"""


BAD = entry("fail", {"max": 1.0})


def result(verdict: str = "fail", name: str = "y", **changes: Any) -> Record:
    judged = entry(verdict, {"max": 1.0}, name=name)
    given = {"quantities": [judged], **changes}
    return record("dem/default", given.pop("variant", "T1"), 1e-3, **given)


def test_a_result_out_of_bounds_ends_it_and_one_within_does_not() -> None:
    assert FAILS(result("fail"))
    assert not FAILS(result("pass"))


def test_what_is_refused_is_no_reason_to_end_though_nothing_ran() -> None:
    assert not FAILS(record("dem/default", "T1", 1e-3, status="refused", reason="it has no walls"))


def sunk(seen: float) -> Record:
    """A record that passes and whose ledger shows how far a body sank [m], of 0.001."""
    ledger = {"terms": {}, "unaccounted": 0.0, "peak": 1.0, "bound": 1e-9,
              "audits": {"penetration [m]": (seen, 1e-3)}}  # fmt: skip
    return result("pass", ledger=ledger)


@pytest.mark.parametrize(
    ("told", "one", "ends"),
    [
        ("", result(), True),
        (KNOWN, result(), False),
        (KNOWN, result(name="z"), True),
        (KNOWN.replace("2999", "1999"), result(), True),
        (KNOWN, result(quantities=[entry("fail", {"max": 1.0}, judge="invariant")]), True),
        (KNOWN, result(variant="T2"), True),
        (KNOWN, result(quantities=[entry("pass", {}, name="z"), BAD]), False),
        (KNOWN, result(quantities=[entry("fail", {}, name="z"), BAD]), True),
        (KNOWN, result(status="diverged", quantities=[]), True),
        (KNOWN, sunk(0.015), True),
        (BROKEN, sunk(0.015), False),
        (BROKEN, sunk(0.03), True),
        (KNOWN + BROKEN, result(), False),
    ],
)  # fmt: skip
@pytest.mark.parametrize("at", ["own", "bundled"])
def test_what_an_entry_of_any_ledger_knows_of_the_quantity_or_law_is_no_reason_to_end(
    told: str, one: Record, ends: bool, at: str, tmp_path: Path
) -> None:
    (tmp_path / at / "cases").mkdir(parents=True)
    (tmp_path / at / "cases" / "disagreements.toml").write_text(told)
    roots = (tmp_path / "own", tmp_path / "bundled")
    project: Any = some(roots=roots, load_case=lambda name: some(enforced=frozenset(Check)))
    assert first_failure.is_failure(project)(one) is ends


@pytest.mark.parametrize("checks", [frozenset(Check), frozenset({Check.CONSERVATION})])
def test_a_result_out_of_bounds_ends_it_where_its_case_enforces_that(
    checks: frozenset[Check], tmp_path: Path
) -> None:
    project: Any = some(roots=(tmp_path,), load_case=lambda name: some(enforced=checks))
    assert first_failure.is_failure(project)(result()) is (Check.ACCURACY in checks)
