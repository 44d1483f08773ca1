"""Claims about timed costs: which jobs are due, and which session answers for them."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import Any

import pytest

from tests.support.fabricated import record, some
from vv.ask import Cost
from vv.records.manifest import Machine, TimedRun
from vv.records.outcomes import CostKind
from vv.run import session, timing_phase
from vv.run.limits import Limits, Timing
from vv.store.store import Store

HERE = Machine("P", 2, "S", "f00")
KEYS = {0: "aa", 1: "bb", 2: "cc", 3: "dd"}


def plan_of(*timed: bool) -> Any:
    return some(jobs=[some(timed=one, label=f"job {n}") for n, one in enumerate(timed)])


def run(cpu: float, output: float = 0.0) -> TimedRun:
    return TimedRun(**dataclasses.asdict(Cost(solve_cpu=cpu, output=output, repeats=3)),
                    relative=(cpu, 2 * cpu))  # fmt: skip


RAN, LOST = record("a/x", "T1", 1e-3), record("a/x", "T1", 1e-3, status="error")


def test_gaps_are_jobs_that_were_to_be_timed_and_ran_and_have_no_cost() -> None:
    plan = plan_of(True, True, True, False)
    assert timing_phase.gaps(plan, [RAN, LOST, RAN, RAN], {2}) == ("job 0",)
    assert timing_phase.gaps(plan, [RAN, LOST, RAN, RAN], {0, 2}) == ()


@pytest.mark.parametrize(("fresh", "cpu", "visits"), [(False, 1.0, 0), (True, 5.0, 1)])
def test_a_stored_session_answers_unless_a_new_one_is_asked_for(
    fresh: bool, cpu: float, visits: int, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    measured: list[Any] = []

    def measure(plan: object, numbers: list[int], *_: object) -> dict[str, TimedRun]:
        measured.append(numbers)
        return {KEYS[n]: run(1.0 if len(measured) == 1 else 5.0) for n in numbers}

    monkeypatch.setattr(timing_phase, "_measure", measure)
    plan, place = plan_of(True, False, True, True), some(timer=lambda: HERE)
    records, store = [RAN, RAN, LOST, RAN], Store(tmp_path)
    first = timing_phase.timed_costs(plan, records, KEYS, store, 1.0, False, place)
    again = timing_phase.timed_costs(plan, records, KEYS, store, 1.0, fresh, place)
    assert measured == [[0, 3]] * (1 + visits)
    assert {n: one.solve_cpu for n, one in first.items()} == {0: 1.0, 3: 1.0}
    assert {n: one.solve_cpu for n, one in again.items()} == {0: cpu, 3: cpu}
    assert {one.kind for one in again.values()} == {CostKind.TIMED}


@pytest.mark.parametrize(("timed", "judged", "output"), [(0.0, 2.0, 2.0), (3.0, 2.0, 3.0)])
def test_output_is_that_of_the_judged_run_if_less_was_written_while_it_was_timed(
    timed: float, judged: float, output: float
) -> None:
    one = dataclasses.replace(RAN, cost=dataclasses.replace(RAN.cost, output=judged))
    assert timing_phase._with_output(run(1.0, timed), one).output == output


def test_the_last_session_gives_costs_to_what_is_still_the_same(tmp_path: Path) -> None:
    store = Store(tmp_path)
    assert timing_phase.last_costs(plan_of(True, True), KEYS, store) == {}
    store.keep_timings("session", {"bb": run(7.0), "zz": run(9.0)})
    found = timing_phase.last_costs(plan_of(True, True), KEYS, store)
    assert {n: (one.solve_cpu, one.session, one.kind) for n, one in found.items()} == {
        1: (7.0, "session", CostKind.TIMED)
    }


@pytest.mark.parametrize(
    ("timing", "fresh", "asked"),
    [
        (Timing.NONE, False, {}),
        (Timing.NONE, True, {}),
        (Timing.LAST, True, "last"),
        (Timing.STORED, False, False),
        (Timing.STORED, True, True),
        (Timing.NEW, False, True),
    ],
)
def test_costs_come_from_the_session_that_is_asked_for(
    timing: Timing, fresh: bool, asked: object, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(session, "last_costs", lambda *_: "last")
    monkeypatch.setattr(session, "timed_costs", lambda plan, records, runs, store, timeout, new,
                        place, begin: new)  # fmt: skip
    nothing: Any = some(runs={}, store=None)
    found: Any = session._costs(nothing, [], nothing, Limits(1, 1.0, fresh, timing), nothing, print)
    assert found == asked


def test_after_the_first_failure_nothing_more_is_taken_and_nothing_is_timed() -> None:
    told: list[Any] = []
    progress: Any = some(done=told.append)
    finished = [(2, RAN), (0, LOST), (1, RAN)]
    whole = session._until(iter(finished), progress, None)
    assert list(whole) == [2, 0, 1]
    part = session._until(iter(finished), progress, lambda one: one is LOST)
    assert part == {2: RAN, 0: LOST}
    assert told == [RAN, LOST, RAN, RAN, LOST]
    assert session._untimed(Limits(3, 2.0, True, Timing.NEW)) == Limits(3, 2.0, True, Timing.NONE)
