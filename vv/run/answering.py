"""Turns each job into a record: from the store, from a refusal, or by running it."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass

from vv.ask import Run, Status
from vv.base.notices import notice
from vv.case import Grid, Search, Trial, has_setting, last_stable_step
from vv.plan import keys
from vv.plan.plan import Job, Plan
from vv.plan.project import Project
from vv.plan.refusals import settle
from vv.records.checking import checked, within
from vv.records.job_record import ModelSummary, Record, RunSummary
from vv.records.outcomes import StudyKind
from vv.records.quantity import MeasuredQuantity
from vv.records.record import measured, summarised
from vv.run.batching import batches
from vv.run.executor import Executor
from vv.run.limits import Limits, hopeless
from vv.run.process import failed
from vv.scene import Vector
from vv.store.store import Store


@dataclass(frozen=True)
class StoredJobs:
    """The store, and by the number of a job the keys of its run and of its record."""

    store: Store
    runs: Mapping[int, str]
    records: Mapping[int, str]

    @classmethod
    def of(cls, project: Project, plan: Plan, store: Store) -> StoredJobs:
        runs = keys.run_keys(project, plan)
        return cls(store, runs, keys.record_keys(project, plan, runs))


def records_of(
    plan: Plan, limits: Limits, stored: StoredJobs, place: Executor, begin: Callable[[int], None]
) -> Iterator[tuple[int, Record]]:
    """Yield (job number, record): first those that need no running, then as runs come in.

    A stored result of a code that is installed needs no check for refusal: its key covers all that
    a refusal depends on. begin: called with the number of jobs that have to run.
    """
    unknown, store = {}, stored.store
    for number, job in enumerate(plan.jobs):
        usable = not limits.fresh and plan.found[job.code].installed
        if usable and (record := _known(plan, number, stored)) is not None:
            yield number, record
        else:
            unknown[number] = job
    settle([*unknown.values()], limits.workers)
    waiting = {}
    for number, job in unknown.items():
        outcome = job.settled or hopeless(job.ask, limits.timeout)
        if outcome is None:
            waiting[number] = job
        else:
            yield number, _measured(plan, job, outcome, stored.records[number], store)
    begin(len(waiting))
    loads = {plan.found[job.code].load for job in waiting.values()}
    for load in filter(None, loads):
        load()
    due = batches(waiting, plan, place)
    for number, run in place.run(due, limits.timeout) if due else ():
        job = plan.jobs[number]
        whole = checked(run, job.ask)
        store.keep_run(stored.runs[number], whole)
        yield number, _measured(plan, job, whole, stored.records[number], store)


def _known(plan: Plan, number: int, stored: StoredJobs) -> Record | None:
    """The record of a job from the store; None if the job has to be run."""
    job, key, store = plan.jobs[number], stored.records[number], stored.store
    if (summary := _summary(plan, job, key, store)) is not None:
        return _record(plan, job, key, summary)
    run = store.run(stored.runs[number])
    if run is None:
        return None
    found = checked(run, job.ask)
    record = _measured(plan, job, found, key, store) if found.status is Status.RAN else None
    if record is not None and record.status is Status.RAN:
        return record
    why = (record or found).reason
    notice(f"the stored run {stored.runs[number]}: {why}; it is ignored and run again")
    return None


def _summary(plan: Plan, job: Job, key: str, store: Store) -> RunSummary | None:
    """The stored summary of a job; None if its series or a quantity is missing."""
    summary = store.summary(key)
    if summary is None or store.series(key, summary.quantities) is None:
        return None
    quantities = plan.trials[job.case, job.variant].quantities
    due = [one.name for one in quantities if summary.status is Status.RAN]
    if [one.name for one in summary.quantities] == due:
        return summary
    notice(f"the stored record {key} does not have all quantities; it is ignored and made again")
    return None


def _measured(plan: Plan, job: Job, run: Run, key: str, store: Store) -> Record:
    """Measure a run, store the measured summary if the run is meaningful, and return the record.

    A run with a quantity that cannot be measured has failed, since the case may depend on that
    quantity.
    """
    trial = plan.trials[job.case, job.variant]
    chosen = not has_setting(trial.study, job.ask.knobs)
    quantities: list[MeasuredQuantity] = []
    arrays: dict[str, Vector] = {}
    try:
        for quantity in trial.quantities if run.status is Status.RAN else ():
            one, series = measured(
                run, quantity, job.method, job.ask.knobs, job.modified, chosen=chosen
            )
            quantities.append(one)
            arrays.update(series)
    except Exception as error:
        run, quantities = failed(error), []
    run = within(run, trial.unexplained, job.method, job.ask.knobs)
    summary = summarised(run, tuple(quantities), _largest_step(trial, run))
    says = (Status.RAN, Status.DIVERGED) if isinstance(trial.study, Grid) else (Status.RAN,)
    if run.status in says:
        store.keep_summary(key, summary, arrays)
    return _record(plan, job, key, summary)


def _largest_step(trial: Trial, run: Run) -> float | None:
    """The step that a search found; None of a run that failed, and of other studies."""
    if not isinstance(trial.study, Search) or run.status is not Status.RAN:
        return None
    return last_stable_step(run, trial.study.bracket)


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
        changed=job.changed,
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
        largest_step=run.largest_step,
    )
