"""Carries out one invocation: jobs become records, which are timed, judged and kept."""

from __future__ import annotations

import dataclasses
import datetime
from collections.abc import Callable, Iterable, Sequence
from typing import Protocol

from vv.base.notices import notice
from vv.gate.all_checks import GateOptions, judged
from vv.plan import keys
from vv.plan.plan import Plan, with_jobs_kept
from vv.plan.project import Project
from vv.records.job_record import JobCost, Record
from vv.records.manifest import CodeFound, Machine, Manifest
from vv.run.answering import StoredJobs, records_of
from vv.run.case_facts import case_facts_of
from vv.run.executor import Executor, Local
from vv.run.limits import LOCAL, MEASURED, Limits, Timing
from vv.run.timing_phase import gaps, last_costs, timed_costs
from vv.store.provenance import machine, provenance, run_name
from vv.store.store import Store


class Progress(Protocol):
    """Is notified of the number of jobs to run, of each record, and of the timing phase."""

    def begin(self, jobs: int) -> None:
        """The number of jobs to run is known; later calls of `done` are for these jobs."""

    def done(self, record: Record) -> None:
        """One record is finished."""

    def timing(self, settings: int) -> None:
        """The timing phase begins; it times so many settings, one after the other."""


def now_utc() -> datetime.datetime:
    """The present time in UTC, as all records state it."""
    return datetime.datetime.now(datetime.UTC)


def carry_out(
    project: Project,
    plan: Plan,
    limits: Limits,
    progress: Progress,
    command: Sequence[str],
    clock: Callable[[], datetime.datetime] = now_utc,
    until: Callable[[Record], bool] | None = None,
) -> Manifest:
    """Run what is not stored, judge all, keep the manifest and return it.

    until: after a record for which it holds, nothing more is run, and nothing is timed.
    """
    store = Store(project.data())
    store.clear_scratch()
    stored = StoredJobs.of(project, plan, store)
    place = _executor(project, plan, limits, store)
    records = _until(records_of(plan, limits, stored, place, progress.begin), progress, until)
    if len(records) < len(plan.jobs):
        kept = {id(plan.jobs[number]) for number in records}
        plan, limits = with_jobs_kept(plan, lambda job: id(job) in kept), _untimed(limits)
    ordered = [records[number] for number in sorted(records)]
    costs = _costs(plan, ordered, stored, limits, place, progress.timing)
    timed = [
        dataclasses.replace(record, cost=costs.get(i, record.cost))
        for i, record in enumerate(ordered)
    ]
    measured = limits.timing in MEASURED
    missing = gaps(plan, ordered, costs) if measured else ()
    timer = place.timer() if measured else machine()
    manifest = _manifest(project, plan, limits, timed, missing, timer, command, clock())
    store.manifests.keep(manifest)
    return manifest


def records_alone(project: Project, plan: Plan, limits: Limits, progress: Progress) -> list[Record]:
    """Run what is not stored, and return the records, which are not judged and in no manifest."""
    store = Store(project.data())
    stored = StoredJobs.of(project, plan, store)
    place = _executor(project, plan, limits, store)
    records = _until(records_of(plan, limits, stored, place, progress.begin), progress, None)
    return [records[number] for number in sorted(records)]


def _manifest(
    project: Project,
    plan: Plan,
    limits: Limits,
    records: Sequence[Record],
    untimed: tuple[str, ...],
    timer: Machine,
    command: Sequence[str],
    now: datetime.datetime,
) -> Manifest:
    """Judge the records; the manifest that holds them and where they come from."""
    new = limits.timing is Timing.NEW
    found = judged(project, plan, records, GateOptions(now.date(), timer, limits.against, new))
    return Manifest(
        provenance=provenance(project.root, command, now),
        codes={code: _code(project, plan, code) for code in sorted({j.code for j in plan.jobs})},
        cases=case_facts_of(plan),
        untimed=untimed,
        records=found.records,
        findings=found.findings,
        baselines=found.baselines,
        recorded=found.recorded,
        timed_on=None if timer == machine() else timer,
        name=run_name(now),
    )


def _until(
    finished: Iterable[tuple[int, Record]],
    progress: Progress,
    until: Callable[[Record], bool] | None,
) -> dict[int, Record]:
    """Job number -> record: all, or those up to the first for which `until` holds."""
    records: dict[int, Record] = {}
    for number, record in finished:
        records[number] = record
        progress.done(record)
        if until is not None and until(record):
            break
    return records


def _untimed(limits: Limits) -> Limits:
    return dataclasses.replace(limits, timing=Timing.NONE)


def _costs(
    plan: Plan,
    records: Sequence[Record],
    stored: StoredJobs,
    limits: Limits,
    place: Executor,
    begin: Callable[[int], None],
) -> dict[int, JobCost]:
    """Job number -> timed cost, from the timing session that `limits.timing` asks for."""
    if limits.timing is Timing.NONE:
        return {}
    if limits.timing is Timing.LAST:
        return last_costs(plan, stored.runs, stored.store)
    new = limits.fresh or limits.timing is Timing.NEW
    return timed_costs(plan, records, stored.runs, stored.store, limits.timeout, new, place, begin)


def _code(project: Project, plan: Plan, code: str) -> CodeFound:
    """What was found of a code. files: names and digests, none for what is only source."""
    found = plan.found[code]
    return CodeFound(found.version, found.installed, keys.executables(project, found))


def _executor(project: Project, plan: Plan, limits: Limits, store: Store) -> Executor:
    """The executor that `limits.executor` names."""
    if limits.executor == LOCAL:
        return Local(limits.workers, store.scratch)
    from vv.run.cluster.head import Cluster
    from vv.run.pace import PAST, paces

    folders = [root / "cases" / "recorded" for root in project.roots]
    expected = paces(plan, store.manifests.newest(PAST, notice), folders)
    return Cluster(limits.executor, project, keys.code_digests(project, plan), expected)
