"""Claims about a sphere that bounces to rest: how long it is run, and when bounces are judged."""

import math

import numpy as np
import pytest

from cases.hard.parts._settling_bounds import _margin
from cases.hard.settling import CASE
from reference_solutions.contact import settling
from vv.ask import History, Knobs, Method
from vv.case import Count, Exact, Ladder, Trial
from vv.engines import dem, exact

USUAL = CASE.defaults("drop")


def declared(**given: float) -> Trial:
    """The trial at parameters other than the case's own."""
    return CASE.declare("drop", {**USUAL, **given})


def bounds(**given: float) -> Exact:
    """The judge of the number of bounces."""
    judge = declared(**given).quantities[1].judge
    assert isinstance(judge, Exact)
    return judge


@pytest.mark.parametrize(
    ("given", "duration"), [({}, 0.8), ({"m": 2.7, "kn": 1.96e6}, 1.9165940), ({"eta": 60.0}, 0.8)]
)
def test_a_run_lasts_twice_as_long_as_the_sphere_bounces(
    given: dict[str, float], duration: float
) -> None:
    study = declared(**given).study
    assert isinstance(study, Ladder)
    assert isinstance(study.goal, History)
    assert study.goal.duration == pytest.approx(duration, rel=1e-7)
    assert study.goal.duration >= 2.0 * settling.stages(**{**USUAL, **given})[-1].begin


@pytest.mark.parametrize("given", [{"m": 2.7, "kn": 1.96e6}, {"eta": 10.0}, {"eta": 1200.0}])
def test_bounces_are_counted_in_any_number(given: dict[str, float]) -> None:
    trial = declared(**given)
    count = trial.quantities[1]
    assert isinstance(count, Count)
    assert callable(count.reference)
    assert set(bounds(**given).tolerances) == {Method.EXACT, Method.SECOND_ORDER}
    for run in (
        exact.solve(trial.study.ask(Knobs())),
        dem.solve_default(trial.study.ask(Knobs(1e-4))),
    ):
        assert count.observe(run) == count.reference()


def kn_of(low: float, high: float) -> float:
    """The stiffness [N/m] at which the number of bounces changes, between two that differ."""

    def number(kn: float) -> int:
        return len(settling.stages(**{**USUAL, "kn": kn}))

    assert number(low) != number(high)
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if number(middle) == number(low) else (low, middle)
    return low


FIRST, SECOND, EXACT = Method.FIRST_ORDER, Method.SECOND_ORDER, Method.EXACT


@pytest.mark.parametrize(
    ("part", "judged"),
    [
        (-0.02, {EXACT, SECOND}), (-5e-3, {EXACT}), (-5e-5, {EXACT}),
        (5e-5, set()), (5e-3, {EXACT}), (0.02, {EXACT, SECOND}),
    ],
)  # fmt: skip
def test_bounces_are_judged_where_an_error_of_the_method_changes_none(
    part: float, judged: set[Method]
) -> None:
    """Beside a stiffness from which there is one bounce more, whose flight is very short there."""
    found = bounds(kn=kn_of(1e6, 1.05e6) * (1.0 + part))
    assert set(found.tolerances) == judged
    assert set(found.not_judged) == {FIRST, SECOND, EXACT} - judged


@pytest.mark.parametrize(
    "given", [{}, {"eta": 60.0}, {"kn": 1.01e6, "g": 3.0}, {"m": 2.0}, {"eta": 1700.0}],
    ids=str,
)  # fmt: skip
def test_the_number_is_as_far_from_changing_as_the_nearer_of_the_last_two_swings(
    given: dict[str, float],
) -> None:
    """The oscillation that stays rises by exp(-pi n/w_d) of what it sank below its rest."""
    law = {**USUAL, **given}
    stages, sunk = settling.stages(**law), law["m"] * law["g"] / law["kn"]
    n = law["eta"] / (2.0 * law["m"])
    rate = math.sqrt(law["kn"] / law["m"] - n * n)
    *_, flight, last = stages
    t = last.begin + np.linspace(0.0, math.pi / rate, 20001)
    deepest = -float(settling.settling(t, **law).min() + law["height"]) - sunk
    stays = 1.0 - deepest * math.exp(-math.pi * n / rate) / sunk
    swing = math.hypot(1.0, flight.v / math.sqrt(law["kn"] / law["m"]) / sunk)
    leaves = swing - 1.0 if flight.v else math.inf  # with so much drag it never leaves the floor
    assert flight.flies
    assert _margin(law, law, stages) == pytest.approx(min(stays, leaves), rel=1e-4)
