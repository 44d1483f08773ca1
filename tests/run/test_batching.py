"""Claims about batches for a cluster: a second or more each, by what is on record of their jobs."""

from __future__ import annotations

import contextlib
import dataclasses
import socket
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests import ROOT
from tests.support.fabricated import cost, manifest, record
from vv.ask import History, Knobs
from vv.codes import Found
from vv.plan.plan import Options, Plan
from vv.plan.planning import make_plan
from vv.plan.project import Project
from vv.records.manifest import Manifest
from vv.run.batching import batches
from vv.run.cluster.head import Cluster
from vv.run.executor import Local
from vv.run.pace import Pace, paces, piles

T1 = "single-contact:T1"
NOWHERE = "dask://nowhere:1"


@pytest.fixture(scope="module")
def plan() -> Plan:
    return make_plan(Project(ROOT), [T1], Options(codes=("dem", "kratos")))


def shared(plan: Plan, rest: float, start: float = 0.0) -> list[int]:
    """The sizes of batches on a cluster where every job takes so long [s]."""
    waiting = {n: job for n, job in enumerate(plan.jobs) if job.scheme == "default"}
    waiting = {n: job for n, job in waiting.items() if job.code == "dem"}
    expected = {id(job): Pace(start, rest) for job in plan.jobs}
    place = Cluster(NOWHERE, Project(ROOT), {}, expected)
    return sorted(len(batch.asks) for batch in batches(waiting, plan, place))


def test_a_batch_takes_a_second_or_more(plan: Plan) -> None:
    whole = sum(shared(plan, 1e-3))
    assert shared(plan, 1e-3) == [whole]
    assert shared(plan, 2.0) == [1] * whole
    assert shared(plan, 2.001 / whole) == [whole // 2, whole - whole // 2]


def test_a_batch_takes_several_times_what_its_program_takes_to_start(plan: Plan) -> None:
    whole = sum(shared(plan, 1e-3))
    assert shared(plan, 2.0, start=0.5 * whole) == [whole]


@given(st.lists(st.floats(0.0, 10.0), min_size=1, max_size=30), st.integers(1, 40))
def test_piles_hold_every_place_once_and_none_exceeds_the_mean_by_more_than_one(
    seconds: list[float], count: int
) -> None:
    shares = list(piles(seconds, count))
    assert sorted(place for share in shares for place in share) == list(range(len(seconds)))
    heaviest = max(sum(seconds[place] for place in share) for share in shares)
    assert heaviest <= sum(seconds) / count + max(seconds) + 1e-9


def test_the_longest_are_shared_out_first_since_the_short_ones_fill_up() -> None:
    assert list(piles([1.0, 1.0, 5.0, 1.0, 2.0], 2)) == [(2,), (0, 1, 3, 4)]


def test_a_job_takes_what_it_took_last_time(plan: Plan) -> None:
    job = next(job for job in plan.jobs if job.code == "dem")
    last = record("dem/default", job.variant, job.ask.knobs.dt, case=job.case, cost=cost(cpu=3.0))
    found = paces(plan, [manifest(last)], [])
    assert found[id(job)] == Pace(last.cost.startup, last.cost.elapsed - last.cost.startup)


def test_a_job_that_never_ran_here_takes_what_was_recorded_of_it_or_its_scheme_expects() -> None:
    plan = make_plan(Project(ROOT), [T1], Options(codes=("yade",)))
    job = next(job for job in plan.jobs if job.settled is None and job.scheme == "default")
    expected = paces(plan, [], [])[id(job)].rest
    step, body = plan.adapters["yade"].schemes[0].pace
    assert expected == job.ask.goal.steps(job.ask.knobs.dt or 0.0) * (step + 2 * body)
    kept = paces(plan, [], [ROOT / "cases" / "recorded"])[id(job)].rest
    assert kept != expected


@pytest.mark.parametrize(
    ("dt", "spheres", "blocks", "seconds"),
    [
        (0.01, 3, 2, 200 * (3e-3 + 5 * 2e-4)),
        (0.01, 0, 1, 200 * (3e-3 + 2e-4)),
        (None, 2, 0, 3e-3 + 2 * 2e-4),
    ],
)
def test_a_scheme_takes_what_its_steps_and_bodies_cost_each_step_or_once_without_steps(
    dt: float | None, spheres: int, blocks: int, seconds: float
) -> None:
    assert expected(dt, spheres, blocks, (3e-3, 2e-4)) == pytest.approx(seconds)


def test_a_job_of_which_nothing_is_known_takes_a_moment() -> None:
    assert expected(0.01, 3, 2, (0.0, 0.0)) == 0.05


def expected(dt: float | None, spheres: int, blocks: int, pace: tuple[float, float]) -> float:
    """Seconds of a job of 2 s whose scheme has a pace, of which nothing is on record."""
    scene = SimpleNamespace(spheres=SimpleNamespace(mass=[1.0] * spheres), blocks=[None] * blocks)
    ask = SimpleNamespace(knobs=Knobs(dt), scene=scene, goal=History(2.0, 1.0))
    scheme = SimpleNamespace(name="plain", pace=pace)
    job = SimpleNamespace(case="c", variant="v", code="x", scheme="plain", ask=ask, settled=None)
    adapters = {"x": SimpleNamespace(schemes=[SimpleNamespace(name="other", pace=(9, 9)), scheme])}
    plan: Any = SimpleNamespace(jobs=[job], adapters=adapters)
    return paces(plan, [], [])[id(job)].rest


def test_only_what_ran_tells_how_long_a_job_takes_and_the_newest_of_it(plan: Plan) -> None:
    job = next(job for job in plan.jobs if job.code == "dem" and job.settled is None)
    dt = job.ask.knobs.dt

    def told(status: str, cpu: float) -> Manifest:
        spent = dataclasses.replace(cost(), startup=0.25, solve_wall=cpu)
        kept = {"case": job.case, "status": status, "cost": spent}
        return manifest(record(f"dem/{job.scheme}", job.variant, dt, **kept))

    newest, older = told("ran", 3.0), told("ran", 7.0)
    assert paces(plan, [newest, older], [])[id(job)] == Pace(0.25, 3.0 + 2e-3)
    assert paces(plan, [told("timeout", 3.0), older], [])[id(job)] == Pace(0.0, 0.05)


def test_processes_here_share_a_scheme_where_there_are_fewer_schemes_than_they_are(
    plan: Plan, tmp_path: Path
) -> None:
    jobs = [job for job in plan.jobs if job.code == "dem"][:5]
    assert list(Local(4, lambda: tmp_path).shares(jobs, 2)) == [(0, 2, 4), (1, 3)]
    assert list(Local(1, lambda: tmp_path).shares(jobs, 2)) == [(0, 1, 2, 3, 4)]


def test_the_schemes_that_come_last_are_shared_out_where_they_have_many_jobs(
    tmp_path: Path,
) -> None:
    plan = make_plan(Project(ROOT), ["single-contact"], Options(codes=("dem",)))
    whole = dict(enumerate(plan.jobs))
    made = batches(whole, plan, Local(2, lambda: tmp_path))
    assert [batch.scheme for batch in made] == ["default", "published", "published"]
    assert sorted(n for batch in made for n in batch.numbers) == sorted(whole)
    few = {n: job for n, job in whole.items() if job.variant == "T1"}
    assert [one.scheme for one in batches(few, plan, Local(2, lambda: tmp_path))] == [
        "default",
        "published",
    ]


def test_programs_come_code_by_code_and_a_worker_stays_with_one_that_waits(tmp_path: Path) -> None:
    cases = ["single-contact", "responding-block:1d"]
    codes = {"dem": Found(True), "liggghts": Found(True, files=(tmp_path,))}
    codes["yade"] = Found(True, files=(tmp_path,), may_wait=contextlib.nullcontext)
    plan = make_plan(Project(ROOT), cases, Options(codes=tuple(codes)))
    plan = dataclasses.replace(plan, found=codes)
    jobs = sorted(enumerate(plan.jobs), key=lambda job: (job[1].scheme != "default", job[1].code))
    made = batches(dict(jobs), plan, Local(1, lambda: tmp_path))
    names = [batch.adapter.name for batch in made if batch.adapter.name != "dem"]
    assert len(names) > len(set(names)) == 2
    assert names == sorted(names)
    assert {(batch.adapter.name, batch.stays) for batch in made} == {
        ("dem", True),
        ("liggghts", False),
        ("yade", True),
    }


def test_a_port_where_nothing_listens_is_told_at_once(plan: Plan) -> None:
    pytest.importorskip("distributed")
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        place = Cluster(f"dask://127.0.0.1:{free.getsockname()[1]}", Project(ROOT), {}, {})
        with pytest.raises(Exception, match="no scheduler answers there"):
            place.timer()
