"""A timing session keeps the cheapest round of each solve, and only where it timed them all."""

import dataclasses
from collections.abc import Iterator, Sequence
from pathlib import Path

import pytest

from tests import ROOT
from tests.support.fabricated import record
from vv.ask import Cost, Run
from vv.plan.plan import Job, Options, Plan
from vv.plan.planning import make_plan
from vv.plan.project import Project
from vv.records.job_record import JobCost, Record
from vv.records.manifest import Machine
from vv.run import timing_phase
from vv.run.process import Batch
from vv.run.rounds import Timed
from vv.run.timing_phase import timed_costs
from vv.store.store import Store

HERE = Machine("P", 2, "S", "f00")


class Rounds:
    """An executor that times as it is told; asked: how many sessions there were."""

    def __init__(self, told: Sequence[Timed], machine: Machine = HERE) -> None:
        self.told, self.machine = list(told), machine
        self.asked = 0
        self.batches: Sequence[Batch] = ()

    def shares(self, jobs: Sequence[Job], schemes: int) -> Iterator[tuple[int, ...]]:
        raise NotImplementedError

    def run(self, batches: object, timeout: float) -> Iterator[tuple[int, Run]]:
        raise NotImplementedError

    def timer(self) -> Machine:
        return self.machine

    def timed(self, batches: Sequence[Batch], timeout: float) -> list[Timed]:
        self.asked += 1
        self.batches = batches
        return self.told


@pytest.fixture(scope="module")
def plan() -> Plan:
    return make_plan(Project(ROOT), ["single-contact:T1"], Options(codes=("exact", "dem")))


def costs(
    plan: Plan, store: Store, place: Rounds, told: list[int] | None = None
) -> dict[int, JobCost]:
    """What a session says of the plan's jobs, each of which ran; told: what it says of itself."""
    ran: list[Record] = [record(f"{j.code}/{j.scheme}", j.variant, None) for j in plan.jobs]
    keys = {number: f"run{number}" for number in range(len(plan.jobs))}
    begin = (told if told is not None else []).append
    return timed_costs(plan, ran, keys, store, 1.0, False, place, begin)


def numbers(plan: Plan) -> list[int]:
    return [number for number, job in enumerate(plan.jobs) if job.timed]


def test_the_cheapest_round_counts_and_the_spread_is_over_all(plan: Plan, tmp_path: Path) -> None:
    rounds = [
        (number, Cost(solve_cpu=cpu, solve_wall=cpu, repeats=3, spread=0.5), 10 * cpu)
        for cpu in (2.0, 1.0, 3.0)
        for number in numbers(plan)
    ]
    found = costs(plan, Store(tmp_path), Rounds(rounds))
    assert set(found) == set(numbers(plan)) != set()
    for one in found.values():
        assert (one.solve_cpu, one.repeats) == (1.0, 9)
        assert one.spread == pytest.approx(3.0 * 1.5 - 1.0)  # the dearest repeat of the dearest
        assert one.relative == (10.0, 30.0)


def test_a_worker_may_time_all_of_a_code_scheme_by_scheme(tmp_path: Path) -> None:
    cases = ["responding-block:1d", "single-contact:T1"]
    plan = make_plan(Project(ROOT), cases, Options(codes=("dem", "dda", "exact")))
    place = Rounds([])
    costs(plan, Store(tmp_path), place)
    names = [(batch.adapter.name, batch.scheme) for batch in place.batches]
    assert len({code for code, _ in names}) == 3 < len(names)
    assert names == sorted(names)
    assert all(batch.stays and batch.repeat > 0 for batch in place.batches)


@pytest.mark.parametrize(("missing", "sessions"), [(0, 1), (1, 2)])
def test_a_session_answers_again_only_if_it_timed_all(
    plan: Plan, tmp_path: Path, missing: int, sessions: int
) -> None:
    timed = numbers(plan)[missing:]
    place = Rounds([(number, Cost(solve_cpu=1.0), 1.0) for number in timed])
    store = Store(tmp_path)
    told: list[int] = []
    assert set(costs(plan, store, place, told)) == set(timed)
    assert set(costs(plan, store, place, told)) == set(timed)
    assert place.asked == sessions
    assert told == [len(numbers(plan))] * sessions  # who waits is told for how many settings


def test_a_session_of_another_machine_or_timed_otherwise_is_not_taken_for_this(
    plan: Plan, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    store, told = Store(tmp_path), [(n, Cost(solve_cpu=1.0), 1.0) for n in numbers(plan)]
    here = Rounds(told)
    there = Rounds(told, dataclasses.replace(HERE, fingerprint="b0b"))
    for place in (here, there, here, there):
        costs(plan, store, place)
    assert (here.asked, there.asked) == (1, 1)
    for asked, (name, value) in enumerate((("REPEAT", 0.5), ("ENOUGH", 7), ("DRIFT", 1.3)), 2):
        monkeypatch.setattr(timing_phase, name, value)
        costs(plan, store, here)
        assert here.asked == asked
