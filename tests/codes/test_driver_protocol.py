"""The half of a driver that all drivers share: sines, what is timed, and what is printed."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from vv.codes import driver_protocol


def test_sines_and_their_rates_are_summed_along_each_axis() -> None:
    sines: driver_protocol.Sines = [([1.0, -2.0, 4.0], 3.0, 0.5), ([0.0, 5.0, 0.5], 2.0, -0.3)]
    for t in (0.0, 0.7):
        one, other = 3.0 * t + 0.5, 2.0 * t - 0.3
        for derivative, (a, b) in enumerate([
            (math.sin(one), math.sin(other)),
            (3.0 * math.cos(one), 2.0 * math.cos(other)),
            (-9.0 * math.sin(one), -4.0 * math.sin(other)),
        ]):  # fmt: skip
            due = [a, -2.0 * a + 5.0 * b, 4.0 * a + 0.5 * b]
            assert driver_protocol.swung(sines, t, derivative) == pytest.approx(due, abs=1e-14)


class Clock:
    """CPU and wall time, of which wall runs twice as fast, and a solve that takes given seconds."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, *steps: float) -> None:
        self.now, self.steps, self.watched = 100.0, list(steps), list[bool]()
        monkeypatch.setattr("time.process_time", lambda: self.now)
        monkeypatch.setattr("time.perf_counter", lambda: 2.0 * self.now)

    def simulate(
        self, ask: dict[str, Any], watched: bool, watch: driver_protocol.Stopwatch
    ) -> tuple[Any, dict[str, Any]]:
        self.watched.append(watched)
        for part, seconds in (("setup", 0.25 * len(self.watched)), ("steps", self.steps.pop(0))):
            self.now += seconds
            watch.lap(part)
        self.now += 8.0
        watch.lap("reading")
        self.now += 1.0
        watch.lap("reading")  # laps of one part are added
        return np.zeros((1, 2, 3)), {"unknowns": 3}


@pytest.mark.parametrize(
    ("repeat", "steps", "least", "repeats", "spread"),
    [
        (0.0, [4.0], 4.0, 1, 0.0),
        (1.0, [4.0, 3.0, 2.0, 5.0], 2.0, 3, 1.5),  # the first only fills caches; at least three
        (16.0, [4.0, 3.0, 2.0, 5.0, 4.0], 2.0, 4, 1.5),
        (14.0, [4.0, 3.0, 2.0, 5.0], 2.0, 3, 1.5),
        (1.0, [4.0, 0.0, 0.0, 0.0], 0.0, 3, 0.0),
    ],
)
def test_steps_are_done_again_until_they_took_long_enough_and_the_least_is_told(
    monkeypatch: pytest.MonkeyPatch, repeat: float, steps: list[float], least: float,
    repeats: int, spread: float,
) -> None:  # fmt: skip
    clock = Clock(monkeypatch, *steps)
    _, facts = driver_protocol.solve({"steps": 7}, clock.simulate, repeat)
    assert clock.steps == []
    assert clock.watched == [True, *[False] * (len(steps) - 1)]
    assert facts == {
        "status": "ran", "reason": "", "steps": 7, "unknowns": 3, "setup": 0.25, "solve_cpu": least,
        "solve_wall": 2 * least, "output": 9.0, "repeats": repeats, "spread": spread,
    }  # fmt: skip


def test_what_is_not_finite_diverged() -> None:
    def simulate(*_: object) -> tuple[Any, dict[str, Any]]:
        return np.array([1.0, np.inf]), {}

    with pytest.raises(driver_protocol.RunError, match="not finite") as refused:
        driver_protocol.solve({"steps": 7}, simulate, 0.0)
    assert refused.value.status == "diverged"


def test_the_ask_that_is_filled_in_is_answered_in_print(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    ask = {"steps": 4, "stride": 2, "dt": 0.25, "observe": [["velocity", 3]]}
    monkeypatch.setattr(driver_protocol, "ASK", ask)
    clock = Clock(monkeypatch, 4.0)
    driver_protocol.serve(clock.simulate)
    _, *lines = capsys.readouterr().out.splitlines()
    assert lines == ["# t [s], velocity of body 3: x, y, z [SI]", "0 0 0 0", "0.5 0 0 0"]
