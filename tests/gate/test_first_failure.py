"""Claims about when a run that is to end at the first failure ends."""

from tests import ROOT
from tests.support.fabricated import entry, record
from vv.gate import first_failure
from vv.plan.project import Project

FAILS = first_failure.is_failure(Project(ROOT))


def test_a_result_out_of_bounds_ends_it_and_one_within_does_not() -> None:
    assert FAILS(record("dem/default", "T1", 1e-3, quantities=[entry("fail", {"max": 1.0})]))
    assert not FAILS(record("dem/default", "T1", 1e-3, quantities=[entry("pass", {"max": 0.0})]))


def test_what_is_refused_is_no_reason_to_end_though_nothing_ran() -> None:
    assert not FAILS(record("dem/default", "T1", 1e-3, status="refused", reason="it has no walls"))
