"""Claims about output times: whole steps, and never beyond the duration."""

import pytest

from vv.ask import History


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
