"""Claims about timing: one call without a budget, else the least of several calls."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace

import pytest

from adapters import exact
from tests.scenes.small_scenes import small_scene
from vv.ask import Ask, Displacement, History, Run, Status
from vv.codes import timed
from vv.codes.timing import run_timed


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


def test_a_clock_that_moves_in_ticks_costs_no_million_calls(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Ticks of 4 ms, which a process with a limit of CPU time has, and calls of 10 microseconds."""
    clock = Clock(*[1e-5] * 20000)
    monkeypatch.setattr("time.process_time", lambda: 4e-3 * (clock.now // 4e-3))
    monkeypatch.setattr("time.perf_counter", clock.read)
    _, cost = timed(clock.solve, 0.05)
    assert clock.calls < 10000
    assert cost.solve_cpu == pytest.approx(1e-5, rel=0.1)
    assert cost.solve_wall == pytest.approx(1e-5)


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


def test_the_least_is_told_of_cpu_and_of_wall_each_a_call_s_share(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Of blocks of 1000 calls, a microsecond each or three; wall runs twice as fast, or 8 times."""
    calls, now = 0, [100.0, 100.0]

    def solve() -> None:
        nonlocal calls
        calls += 1
        late = 1000 < calls <= 2000
        now[0] += 3e-6 if late else 1e-6
        now[1] += 24e-6 if late else 2e-6

    monkeypatch.setattr("time.process_time", lambda: now[0])
    monkeypatch.setattr("time.perf_counter", lambda: now[1])
    _, cost = timed(solve, 4.5e-3)
    assert cost.repeats == calls - 1
    assert cost.solve_cpu == pytest.approx(1e-6, rel=1e-3)
    assert cost.solve_wall == pytest.approx(2e-6, rel=1e-2)
    assert cost.spread == pytest.approx(2.0, rel=0.01)


def test_each_part_of_a_run_is_on_the_clock(monkeypatch: pytest.MonkeyPatch) -> None:
    now = [100.0]
    monkeypatch.setattr("time.process_time", lambda: now[0])
    monkeypatch.setattr("time.perf_counter", lambda: 3.0 * now[0])

    def takes(seconds: float, result: object = None) -> object:
        now[0] += seconds
        return result

    prepared = SimpleNamespace(
        warm=lambda: takes(2.0),
        solve=lambda: takes(4.0, "rows"),
        run=lambda rows: takes(8.0, Run(Status.RAN, str(rows))),
    )
    run = run_timed(lambda: takes(1.0, prepared), 0.0)  # type: ignore[arg-type,return-value]
    cost = run.cost
    assert run.reason == "rows"
    assert (cost.setup, cost.startup, cost.solve_cpu, cost.output) == (1.0, 2.0, 4.0, 8.0)
    assert cost.solve_wall == 12.0


def test_each_part_of_an_exact_run_has_the_time_that_it_took(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """Equations are built in 1 s, the kernel is loaded in 2 s, and output is evaluated in 8 s."""
    clock = iter((0.0, 1.0, 3.0, 7.0, 15.0))
    monkeypatch.setattr(exact, "time", SimpleNamespace(process_time=lambda: next(clock)))
    scene = small_scene(1)
    ask = Ask(scene, History(0.4, 1e-2), (Displacement(1),))
    (run,) = exact.ADAPTER.run([ask], "default", tmp_path, 0.0)
    assert run.cost is not None
    assert (run.cost.setup, run.cost.startup, run.cost.output) == (1.0, 2.0, 8.0)
