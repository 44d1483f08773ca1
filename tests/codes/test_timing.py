"""Claims about timing: one call without a budget, else the least of several calls."""

from __future__ import annotations

import pytest

from vv.codes import timed


class Clock:
    """A clock for both CPU and wall time that calls move by given amounts."""

    def __init__(self, *costs: float) -> None:
        self.now, self.costs, self.calls = 0.0, list(costs), 0

    def read(self) -> float:
        return self.now

    def solve(self) -> str:
        self.calls += 1
        self.now += self.costs.pop(0)
        return "solved"


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> Clock:
    clock = Clock(5.0, 2.0, 1.0, 3.0, 9.0)
    monkeypatch.setattr("time.process_time", clock.read)
    monkeypatch.setattr("time.perf_counter", clock.read)
    return clock


def test_short_solves_are_timed_many_at_a_time(monkeypatch: pytest.MonkeyPatch) -> None:
    clock = Clock(*[2e-6] * 5000)
    monkeypatch.setattr("time.process_time", clock.read)
    monkeypatch.setattr("time.perf_counter", clock.read)
    _, cost = timed(clock.solve, 4e-3)
    assert cost.solve_cpu == pytest.approx(2e-6)
    assert cost.repeats == clock.calls - 1 >= 2000
    assert cost.spread < 1e-6


def test_without_a_budget_there_is_one_call(clock: Clock) -> None:
    result, cost = timed(clock.solve, 0.0)
    assert (result, clock.calls) == ("solved", 1)
    assert (cost.solve_cpu, cost.solve_wall, cost.repeats, cost.spread) == (5.0, 5.0, 1, 0.0)


def test_a_budget_is_spent_and_the_least_counts_but_for_the_first(clock: Clock) -> None:
    _, cost = timed(clock.solve, 6.0)
    assert clock.calls == 4
    assert (cost.solve_cpu, cost.repeats, cost.spread) == (1.0, 3, 2.0)


def test_a_first_call_beyond_the_budget_is_the_only_one(clock: Clock) -> None:
    _, cost = timed(clock.solve, 4.0)
    assert (clock.calls, cost.solve_cpu, cost.repeats) == (1, 5.0, 1)
