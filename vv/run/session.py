"""One invocation: answer jobs from the store or by running, measure, time, and write it down."""

from __future__ import annotations

import dataclasses
import datetime
import enum
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from vv.ask import Run, Status
from vv.base.notices import notice
from vv.case import Grid
from vv.gate.all_checks import GateOptions, judged
from vv.plan import keys
from vv.plan.plan import Job, Plan, with_jobs_kept
from vv.plan.project import Project
from vv.plan.settling import settle
from vv.records.job_record import JobCost, ModelSummary, Record, RunSummary
from vv.records.manifest import CodeFound, Manifest
from vv.records.outcomes import StudyKind
from vv.records.quantity import MeasuredQuantity
from vv.records.record import checked, measured, summarised, within
from vv.run.batching import batches
from vv.run.case_facts import case_facts_of
from vv.run.executor import LOCAL, Executor, Local
from vv.run.runner import failed
from vv.run.timing_phase import gaps, last_costs, timed_costs
from vv.scene import Vector
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


class Timing(enum.Enum):
    """Where timed costs come from: nowhere, the last session, one that is stored, or a new one."""

    NONE = enum.auto()
    LAST = enum.auto()
    STORED = enum.auto()
    NEW = enum.auto()


MEASURED = (Timing.STORED, Timing.NEW)  # where all that is to be timed should be


@dataclass(frozen=True)
class Limits:
    """How an invocation may use the machine: processes, seconds per job, the store or not.

    against: the folder of baselines that every result must have one in; None: the project's
    own, where a result without one is only noted. executor: `local`, or dask://HOST:PORT, the
    scheduler of a cluster that answers what is not stored.
    """

    workers: int
    timeout: float
    fresh: bool = False
    timing: Timing = Timing.NONE
    against: Path | None = None
    executor: str = LOCAL


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
    stored = _Keys.of(project, plan, store)
    records: dict[int, Record] = {}
    place = _executor(project, plan, limits, store)
    for number, record in _records(plan, limits, stored, place, progress.begin):
        records[number] = record
        progress.done(record)
        if until is not None and until(record):
            break
    ordered = [records[number] for number in sorted(records)]
    if len(ordered) < len(plan.jobs):
        kept = {id(plan.jobs[number]) for number in records}
        plan, limits = with_jobs_kept(plan, lambda job: id(job) in kept), _untimed(limits)
    costs = _costs(plan, ordered, stored, limits, place, progress.timing)
    timed = [
        dataclasses.replace(record, cost=costs.get(i, record.cost))
        for i, record in enumerate(ordered)
    ]
    now = clock()
    timer = place.timer() if limits.timing in MEASURED else machine()
    options = GateOptions(now.date(), timer, limits.against, limits.timing is Timing.NEW)
    found = judged(project, plan, timed, options)
    manifest = Manifest(
        provenance=provenance(project.root, command, now),
        codes={code: _code(project, plan, code) for code in sorted({j.code for j in plan.jobs})},
        cases=case_facts_of(plan),
        untimed=gaps(plan, ordered, costs) if limits.timing in MEASURED else (),
        records=found.records,
        findings=found.findings,
        baselines=found.baselines,
        recorded=found.recorded,
        timed_on=None if timer == machine() else timer,
        name=run_name(now),
    )
    store.keep_manifest(manifest)
    return manifest


def _untimed(limits: Limits) -> Limits:
    return dataclasses.replace(limits, timing=Timing.NONE)


@dataclass(frozen=True)
class _Keys:
    """Where results are kept, and the keys of each job's run and record by its number."""

    store: Store
    runs: Mapping[int, str]
    records: Mapping[int, str]

    @classmethod
    def of(cls, project: Project, plan: Plan, store: Store) -> _Keys:
        runs = keys.run_keys(project, plan)
        return cls(store, runs, keys.record_keys(project, plan, runs))


def _costs(
    plan: Plan,
    records: Sequence[Record],
    stored: _Keys,
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
    from vv.run.cluster import Cluster
    from vv.run.pace import PAST, paces

    folders = [root / "cases" / "recorded" for root in project.roots]
    expected = paces(plan, store.newest(PAST, notice), folders)
    return Cluster(limits.executor, project, keys.code_digests(project, plan), expected)


def _records(
    plan: Plan, limits: Limits, stored: _Keys, place: Executor, begin: Callable[[int], None]
) -> Iterator[tuple[int, Record]]:
    """Yield (job number, record): first those that need no running, then as runs come in.

    What stands of a code that is here was not refused: its key holds all that a refusal hangs on.
    """
    unknown, store = {}, stored.store
    for number, job in enumerate(plan.jobs):
        key = stored.records[number]
        usable = not limits.fresh and plan.found[job.code].installed
        if usable and (summary := store.summary(key)) is not None and store.has_series(key):
            yield number, _record(plan, job, key, summary)
        elif usable and (run := store.run(stored.runs[number])) is not None:
            yield number, _kept(plan, job, run, key, store)
        else:
            unknown[number] = job
    settle([*unknown.values()], limits.workers)
    waiting = {number: job for number, job in unknown.items() if job.settled is None}
    for number, job in unknown.items():
        if job.settled is not None:
            yield number, _kept(plan, job, job.settled, stored.records[number], store)
    begin(len(waiting))
    loads = {plan.found[job.code].load for job in waiting.values()}
    for load in filter(None, loads):
        load()
    due = batches(waiting, plan, place)
    for number, run in place.run(due, limits.timeout) if due else ():
        job = plan.jobs[number]
        whole = checked(run, job.ask)
        store.keep_run(stored.runs[number], whole)
        yield number, _kept(plan, job, whole, stored.records[number], store)


def _kept(plan: Plan, job: Job, run: Run, key: str, store: Store) -> Record:
    """Measure a run, store the measured summary if the run is meaningful, and return the record.

    A run of which a quantity cannot be measured has failed: it may be what the case is to show.
    """
    trial = plan.trials[job.case, job.variant]
    quantities: list[MeasuredQuantity] = []
    arrays: dict[str, Vector] = {}
    try:
        for quantity in trial.quantities if run.status is Status.RAN else ():
            one, series = measured(run, quantity, job.method, job.ask.knobs, job.modified)
            quantities.append(one)
            arrays.update(series)
    except Exception as error:
        run, quantities = failed(error), []
    run = within(run, trial.unexplained, job.method, job.ask.knobs)
    summary = summarised(run, tuple(quantities))
    says = (Status.RAN, Status.DIVERGED) if isinstance(trial.study, Grid) else (Status.RAN,)
    if run.status in says:
        store.keep_summary(key, summary, arrays)
    return _record(plan, job, key, summary)


def _annotated(model: ModelSummary | None, inert: str) -> ModelSummary | None:
    """The model; its note names changed parameters that have no effect."""
    if model is None or not inert:
        return model
    return dataclasses.replace(model, note=f"{model.note}; {inert}" if model.note else inert)


def _record(plan: Plan, job: Job, key: str, run: RunSummary) -> Record:
    """The record of a job; `key` is that of its stored series."""
    return Record(
        case=job.case,
        variant=job.variant,
        study=StudyKind(type(plan.trials[job.case, job.variant].study).__name__.lower()),
        parameters=job.parameters,
        modified=job.modified,
        code=job.code,
        scheme=job.scheme,
        code_version=plan.found[job.code].version,
        method=job.method,
        rung=job.ask.knobs,
        key=key,
        status=run.status,
        reason=run.reason,
        cost=run.cost,
        steps=run.steps,
        model=_annotated(run.model, job.inert),
        ledger=run.ledger,
        quantities=run.quantities,
    )
