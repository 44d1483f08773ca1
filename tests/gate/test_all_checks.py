"""What the gate adds to the checks of single results: nothing timed, and baselines in short."""

import datetime
from dataclasses import replace

import pytest

from tests.support.acceptances import ACCEPTANCE, accepted, ran
from tests.support.fabricated import cost
from vv.gate.all_checks import GateOptions, _summary, _untimed


@pytest.mark.parametrize(
    ("asked", "timed", "red"),
    [
        (True, [False, False], True),
        (True, [False, True], False),
        (True, [True, True], False),
        (True, [], True),
        (False, [False], False),
    ],
)
def test_a_timing_session_that_timed_nothing_is_red(
    asked: bool, timed: list[bool], red: bool
) -> None:
    options = GateOptions(datetime.date(2027, 1, 1), timing=asked)
    found = _untimed([ran(cost=cost(timed=one)) for one in timed], options)
    assert [one.red for one in found] == ([True] if red else [])


def test_a_baseline_in_short_says_how_many_results_came_by_each_acceptance() -> None:
    whole = accepted(ran(), ran(variant="T2"), ran(variant="T3"))
    (first,) = whole.acceptances
    name = next(iter(whole.results))
    results = {**whole.results, name: replace(whole.results[name], by="2")}
    both = _summary(
        replace(whole, results=results, acceptances={first: ACCEPTANCE, "2": ACCEPTANCE})
    )
    assert both.results == 3
    assert [one.results for one in both.acceptances] == [2, 1]
