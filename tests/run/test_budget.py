"""Claims about which jobs fit a budget, from costs and errors of past runs, as small tables."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from tests.support.fabricated import cost, entry, manifest, record, some
from vv.ask import Knobs, Run, Status
from vv.records.job_record import Record
from vv.run import narrowing, pace
from vv.run.pace import Pace, paces, piles


@dataclasses.dataclass(eq=False)
class Job:
    """As much of a job as its place in a budget depends on."""

    variant: str
    dt: float | None
    settled: Run | None = None
    code: str = "a"
    scheme: str = "x"
    case: str = "bounce"

    @property
    def ask(self) -> Any:
        blocks, spheres = (0,) * 2, some(mass=np.ones(3))
        goal = some(steps=lambda dt: round(1.0 / dt))
        return some(knobs=Knobs(self.dt), scene=some(spheres=spheres, blocks=blocks), goal=goal)


def came(
    variant: str, dt: float | None, seconds: float, error: float = 1e-5, **changes: Any
) -> Record:
    """A record whose run took so long, with this error of at most 1e-3."""
    verdict = "pass" if error <= 1e-3 else "fail"
    spent = dataclasses.replace(cost(), startup=0.0, setup=0.0, solve_wall=seconds, output=0.0,
                                solve_cpu=9.0)  # fmt: skip
    given = {"quantities": [entry(verdict, {"max": error})], "cost": spent, **changes}
    return record("a/x", variant, dt, **given)


def kept(
    jobs: list[Job], records: list[Record], budget: float, monkeypatch: pytest.MonkeyPatch
) -> list[tuple[str, float | None]]:
    plan: Any = SimpleNamespace(jobs=jobs)
    monkeypatch.setattr(
        narrowing, "with_jobs_kept", lambda plan, keep: [job for job in plan.jobs if keep(job)]
    )
    found: Any = narrowing.within_budget(plan, budget, [manifest(*records)])
    return [(job.variant, job.dt) for job in found]


STEPS = (4e-3, 2e-3, 1e-3)
PAST = {("T1", 4e-3): 1.0, ("T1", 2e-3): 2.0, ("T1", 1e-3): 4.0,
        ("T2", 4e-3): 1.0, ("T2", 2e-3): 2.0, ("T2", 1e-3): 4.0}  # fmt: skip


@pytest.mark.parametrize(
    ("errors", "budget", "wanted"),
    [
        ({}, 6.0, [("T1", 4e-3), ("T1", 2e-3), ("T2", 4e-3), ("T2", 2e-3)]),
        ({}, 5.9, [("T1", 4e-3), ("T1", 2e-3), ("T2", 4e-3)]),
        ({}, 3.0, [("T1", 4e-3), ("T2", 4e-3)]),
        ({"T2": 9e-4}, 3.0, [("T2", 4e-3), ("T2", 2e-3)]),  # closer to its bound
        ({"T1": 9e-4, "T2": 2e-3}, 3.0, [("T2", 4e-3), ("T2", 2e-3)]),  # beyond its bound
        ({}, 10.0, [("T1", 4e-3), ("T1", 2e-3), ("T1", 1e-3), ("T2", 4e-3), ("T2", 2e-3)]),
        ({}, 14.0, [*PAST]),
    ],
)
def test_the_two_cheapest_rungs_of_all_come_first_and_of_these_the_closest(
    errors: Mapping[str, float],
    budget: float,
    wanted: list[tuple[str, float]],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    jobs = [Job(*place) for place in PAST]
    records = [came(*place, seconds, errors.get(place[0], 1e-5)) for place, seconds in PAST.items()]
    assert kept(jobs, records, budget, monkeypatch) == wanted


def test_what_cannot_run_costs_nothing_and_what_is_new_a_second_and_comes_first(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    refused = Job("T1", 4e-3, Run(Status.REFUSED, "no"))
    jobs = [refused, Job("T2", 4e-3), Job("T3", 4e-3), Job("T4", 4e-3)]
    lost = came("T4", 4e-3, 0.25, status="error", quantities=[])
    records = [came("T2", 4e-3, 0.5), lost]
    assert kept(jobs, records, 0.0, monkeypatch) == [("T1", 4e-3)]
    assert kept(jobs, records, 1.5, monkeypatch) == [("T1", 4e-3), ("T2", 4e-3), ("T3", 4e-3)]
    assert kept(jobs, records, 2.0, monkeypatch) == [("T1", 4e-3), ("T3", 4e-3), ("T4", 4e-3)]


@pytest.mark.parametrize(
    ("quantities", "close"),
    [
        ([entry("pass", {"max": 5e-4}), entry("pass", {"max": 2e-4})], 0.5),
        ([entry("pass", {"max": 2e-4}), entry("pass", {"max": 5e-4}, tolerance=1e-2)], 0.2),
        ([entry("no-reference", {}, tolerance=None)], 0.0),
        ([entry("fail", {"max": 5e-3})], math.inf),
    ],
)
def test_a_job_is_as_close_to_its_tolerance_as_its_closest_quantity(
    quantities: list[Any], close: float
) -> None:
    one = record("a/x", "T1", 4e-3, quantities=quantities)
    job: Any = Job("T1", 4e-3)
    assert narrowing._closeness_to_tolerance(job, {pace.key_of(one): one}) == pytest.approx(close)
    assert narrowing._closeness_to_tolerance(job, {}) == math.inf


def test_what_failed_is_what_turns_a_gate_red_by_itself() -> None:
    fine, bad = came("T1", 4e-3, 1.0), came("T1", 2e-3, 1.0, 5e-3)
    lost = record("a/x", "T2", 4e-3, status="diverged", reason="it blew up")
    refused = record("a/x", "T3", 4e-3, status="refused", reason="no")
    assert narrowing.failing_records(manifest(fine, bad, lost, refused)) == [bad, lost]
    assert narrowing.failing_keys(manifest(fine, bad)) == {("bounce", "T1", "a/x", "dt=0.002")}


def test_the_newest_run_of_a_job_says_how_long_it_takes() -> None:
    old, new = came("T1", 4e-3, 5.0), came("T1", 4e-3, 1.0)
    known = pace.past([manifest(new), manifest(old, came("T2", 4e-3, 2.0))])
    assert {place[1]: one.cost.solve_wall for place, one in known.items()} == {"T1": 1.0, "T2": 2.0}


@pytest.mark.parametrize(
    ("record", "recorded", "declared", "dt", "due"),
    [
        (came("T1", 4e-3, 2.0), 7.0, (1e-3, 1e-4), 4e-3, Pace(0.0, 2.0)),
        (came("T1", 4e-3, 2.0, status="error"), 7.0, (1e-3, 1e-4), 4e-3, Pace(0.0, 7.0)),
        (None, 7.0, (1e-3, 1e-4), 4e-3, Pace(0.0, 7.0)),
        (None, None, (1e-3, 1e-4), 4e-3, Pace(0.0, 250 * (1e-3 + 1e-4 * (3 + 2)))),
        (None, None, (1e-3, 1e-4), None, Pace(0.0, 1e-3 + 1e-4 * (3 + 2))),
        (None, None, (0.0, 0.0), 4e-3, Pace(0.0, pace.UNKNOWN)),
    ],
)
def test_a_job_takes_as_long_as_it_did_or_as_was_recorded_or_as_its_scheme_declares(
    record: Record | None,
    recorded: float | None,
    declared: tuple[float, float],
    dt: float | None,
    due: Pace,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    job: Any = Job("T1", dt)
    known = {} if recorded is None else {pace.key(job): recorded}
    monkeypatch.setattr(pace, "seconds_recorded", lambda folder, code, case: known)
    refused: Any = Job("T2", dt, Run(Status.REFUSED, "no"))
    scheme = some(name="x", pace=declared)
    plan: Any = some(jobs=[job, refused], adapters={"a": some(schemes=[scheme])})
    found = paces(plan, [manifest(*([record] if record else []))], [Path("recorded")])
    assert [*found] == [id(job)]
    assert dataclasses.astuple(found[id(job)]) == pytest.approx(dataclasses.astuple(due))


def test_the_start_of_a_program_is_counted_apart_from_what_follows() -> None:
    spent = dataclasses.replace(cost(), startup=3.0, setup=1.0, solve_wall=2.0, output=0.5)
    one = came("T1", 4e-3, 0.0, cost=spent)
    job: Any = Job("T1", 4e-3)
    plan: Any = some()
    assert pace._pace(plan, job, {pace.key_of(one): one}, {}) == Pace(3.0, 3.5)


@pytest.mark.parametrize(
    ("seconds", "count", "shares"),
    [
        ([1.0, 5.0, 3.0, 2.0], 2, [(1, 0), (2, 3)]),
        ([4.0, 4.0, 1.0], 2, [(0, 2), (1,)]),
        ([1.0], 3, [(0,)]),
        ([0.0, 0.0, 0.0], 2, [(0, 2), (1,)]),
    ],
)
def test_the_longest_job_is_placed_first_and_on_the_smallest_pile(
    seconds: list[float], count: int, shares: list[tuple[int, ...]]
) -> None:
    assert [*piles(seconds, count)] == [tuple(sorted(share)) for share in shares]
