"""Claims about batches of decks that LIGGGHTS runs: what a solve costs, and what a death costs."""

from __future__ import annotations

import functools
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from adapters.liggghts import ADAPTER
from adapters.liggghts.deck import deck, silent_deck
from adapters.liggghts.setup import Setup
from cases.contact.single_contact import CASE
from tests.scenes.blocks.sliding_blocks import Frame, incline
from tests.support.adapters import live_asks
from tests.support.adapters.live_asks import TRIALS, error
from tests.support.installed import only_with
from vv.ask import Ask, Displacement, History, Knobs, Run, Status
from vv.codes import external

pytestmark = only_with(ADAPTER)
ran = functools.partial(live_asks.ran, ADAPTER)
STEPS = [TRIALS["T1"].study.ask(Knobs(dt=dt)) for dt in (1e-3, 1e-7, 5e-4)]


def poisoned(written: Callable[..., str]) -> Callable[..., str]:
    """Writes decks in which LIGGGHTS refuses the mass of the second of STEPS."""

    def write(setup: Setup, *more: object) -> str:
        text = written(setup, *more)
        return text.replace(" mass ", " mass -") if setup.ask is STEPS[1] else text

    return write


def test_a_timed_run_is_the_cost_of_the_loop_alone_and_of_long_ones_taken_once(
    tmp_path: Path,
) -> None:
    asks = [TRIALS["T3"].study.ask(Knobs(dt=dt)) for dt in (1e-3, 1e-4, 1e-5)]
    short, longer, longest = ran(asks, "default", tmp_path, 1e-3)
    assert (short.cost.startup > 0, longer.cost.startup, longest.cost.startup) == (True, 0.0, 0.0)
    assert (short.cost.repeats >= 3, longest.cost.repeats) == (True, 1)
    for run in (short, longer, longest):
        assert min(run.cost.setup, run.cost.solve_cpu) > 0
        assert (run.model, dict(run.values)) == (ADAPTER.describe(asks[0], "default"), {})
    assert longer.cost.solve_cpu > 3 * short.cost.solve_cpu  # ten times the steps
    assert longest.cost.solve_cpu > 3 * longer.cost.solve_cpu


def test_a_death_in_timing_costs_the_ask_in_flight(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("adapters.liggghts.batch.silent_deck", poisoned(silent_deck))
    runs = list(ADAPTER.run(STEPS, "default", tmp_path, 1e-3))
    assert [run.status for run in runs] == [Status.RAN, Status.ERROR, Status.RAN]
    assert [run.cost.repeats >= 3 for run in runs] == [True, False, True]


def test_a_poisoned_deck_in_a_batch_fails_alone_and_says_why(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("adapters.liggghts.batch.deck", poisoned(deck))
    runs = list(ADAPTER.run(STEPS, "default", tmp_path, 0.0))
    assert [run.status for run in runs] == [Status.RAN, Status.ERROR, Status.RAN]
    assert "exit code 1" in runs[1].reason
    assert "Invalid mass" in runs[1].reason
    assert runs[2].cost.startup > 0  # a program of its own
    assert error(runs[2], "T1") < 1e-4


def test_an_answer_stands_though_its_program_died_later(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Nothing is read before the program ended, so that its log tells of the death by then."""

    def after_the_end(count: int, launch: external.Launch, collect: external.Collect) -> list[Run]:
        program = launch(range(count))
        program.process.wait()
        return [collect(i, program) or Run(Status.ERROR, "no answer") for i in range(count)]

    monkeypatch.setattr(external, "run_batch", after_the_end)
    monkeypatch.setattr("adapters.liggghts.batch.deck", poisoned(deck))
    first, second, _ = ADAPTER.run(STEPS, "default", tmp_path, 0.0)
    assert (first.status, first.reason) == (Status.RAN, "")
    assert second.status is Status.ERROR
    assert "Invalid mass" in second.reason


def test_where_no_program_could_be_started_all_asks_fail_with_the_reason(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def start(*_: object) -> external.Process:
        raise OSError("no more processes")

    monkeypatch.setattr(external, "start", start)
    runs = list(ADAPTER.run(STEPS, "default", tmp_path, 0.0))
    assert {run.status for run in runs} == {Status.ERROR}
    assert {run.reason for run in runs} == {"the program could not be started: no more processes"}
    assert len(runs) == len(STEPS)


def test_a_killed_program_costs_the_ask_in_flight(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    programs: list[external.Process] = []
    start = external.start

    def noted(*call: object) -> external.Process:
        programs.append(start(*call))  # type: ignore[arg-type]
        return programs[-1]

    monkeypatch.setattr(external, "start", noted)
    answers = iter(ADAPTER.run(STEPS, "default", tmp_path, 0.0))
    first = next(answers)
    programs[0].process.kill()
    second, third = answers
    assert [run.status for run in (first, second, third)] == [Status.RAN, Status.ERROR, Status.RAN]
    assert "SIGKILL" in second.reason
    assert len(programs) == 2


def test_the_step_that_charges_springs_is_no_part_of_the_loop_s_time(tmp_path: Path) -> None:
    scene = incline(Frame(20.0), 30.0)
    ask = Ask(scene, History(2.0, 0.02), (Displacement(1),), Knobs(1e-4, 1e9))
    (run,) = ran([ask], "default", tmp_path, repeat=0.01)
    assert run.cost.solve_cpu > 2e-3  # 20 000 steps; the charge takes one


def test_a_long_solve_states_less_than_its_elapsed_time_and_most_of_it(tmp_path: Path) -> None:
    """On a core of its own it is what LIGGGHTS' own timer says; on a shared one it is its share."""
    ask = CASE.declare("T1", CASE.defaults("T1")).study.ask(Knobs(dt=1e-6))
    (run,) = ADAPTER.run([ask], "default", tmp_path, 0.05)
    assert 0.05 * run.cost.solve_wall < run.cost.solve_cpu <= 1.01 * run.cost.solve_wall
    clock = np.loadtxt(next(tmp_path.glob("*/time-*.cpu")), usecols=0)
    assert (np.diff(clock) > 0).all()
