"""Claims about output times: whole steps, and never beyond the duration."""

import math
from typing import Any

import numpy as np
import pytest

from vv.ask import Bracket, Cost, History, Knobs


@pytest.mark.parametrize(
    ("duration", "interval", "times"),
    [
        (1.0, 0.25, [0.0, 0.25, 0.5, 0.75, 1.0]),
        (0.9, 0.25, [0.0, 0.25, 0.5, 0.75]),
        (0.3, 0.1, [0.0, 0.1, 0.2, 0.3]),  # 0.3/0.1 is rounded to less than 3
    ],
)
def test_without_a_step_outputs_come_every_interval(
    duration: float, interval: float, times: list[float]
) -> None:
    assert History(duration, interval).times(None) == pytest.approx(times)


@pytest.mark.parametrize(
    ("dt", "stride", "steps"),
    [(0.1, 2, 10), (0.05, 5, 20), (0.3, 1, 3), (0.11, 2, 8)],
)
def test_with_a_step_outputs_come_at_the_whole_steps_nearest_to_the_interval(
    dt: float, stride: int, steps: int
) -> None:
    goal = History(1.0, 0.25)
    assert (goal.stride(dt), goal.steps(dt)) == (stride, steps)
    assert goal.times(dt) == pytest.approx([dt * n for n in range(0, steps + 1, stride)])


@pytest.mark.parametrize(
    ("duration", "interval", "dt", "steps"),
    [(0.3, 0.1, 0.1, 3), (1e6, 1e6, 0.1, 10**7), (0.0299, 0.01, 0.01, 2)],
)
def test_rounding_takes_no_step_from_a_run_short_or_long(
    duration: float, interval: float, dt: float, steps: int
) -> None:
    assert History(duration, interval).steps(dt) == steps


@pytest.mark.parametrize(
    "given",
    [{"dt": 0.0}, {"dt": -1.0}, {"dt": math.inf}, {"kn": 0.0}, {"kn": math.inf}, {"kn": math.nan},
     {"dd": -0.1}, {"dd": 1.1}],
)  # fmt: skip
def test_a_knob_out_of_range_is_named(given: dict[str, float]) -> None:
    (name,) = given
    with pytest.raises(ValueError, match=f"{name} = "):
        Knobs(**given)


def test_knobs_may_be_small_and_hand_on_nothing_or_all() -> None:
    assert (Knobs(1e-9, 1e-9, 0.0).dd, Knobs(dd=1.0).dd, Knobs().dt) == (0.0, 1.0, None)


@pytest.mark.parametrize("given", [(1.0, 0.0), (1.0, 1.1), (math.inf, 0.1), (math.nan, 0.1)])
def test_an_interval_is_positive_and_no_longer_than_the_duration(
    given: tuple[float, float],
) -> None:
    with pytest.raises(ValueError, match="0 < interval <= duration"):
        History(*given)
    assert History(1.0, 1.0).times(None).tolist() == [0.0, 1.0]


@pytest.mark.parametrize(
    ("given", "said"),
    [((1.0, 1.0), "span"), ((math.inf, 1.0), "span"), ((2.0, 0.0), "bound"),
     ((2.0, math.inf), "bound"), ((2.0, 1.0, 1), "tries"), ((2.0, 1.0, 2, 0), "rounds")],
)  # fmt: skip
def test_a_bracket_out_of_range_is_named(given: Any, said: str) -> None:
    with pytest.raises(ValueError, match=said):
        Bracket(*given)
    assert Bracket(1.1, 0.1, 2, 1).tries == 2


@pytest.mark.parametrize(
    ("largest", "limits"),
    [([1.0, 2.0, 3.0], (3.0, None)), ([1.0, 5.0, 2.0], (1.0, 2.0)), ([5.0, 5.0, 5.0], (0.0, 1.0)),
     ([1.0, 4.0, math.inf], (2.0, 3.0)), ([1.0, math.nan, 1.0], (1.0, 2.0))],
)  # fmt: skip
def test_the_limit_lies_below_all_that_is_unstable(
    largest: list[float], limits: tuple[float, float | None]
) -> None:
    tried = np.column_stack([[1.0, 2.0, 3.0], largest])
    assert Bracket(3.0, 4.0).stability_limits(tried) == limits


def test_a_cost_is_not_negative() -> None:
    assert Cost(spread=0.0).spread == 0.0
    with pytest.raises(ValueError, match=r"Cost\.output = -1"):
        Cost(output=-1.0)
