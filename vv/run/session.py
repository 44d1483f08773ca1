"""One invocation: answer jobs from the store or by running, measure, time, and write it down."""

from __future__ import annotations

import dataclasses
import datetime
import enum
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from vv.ask import Run, Status
from vv.case import Grid
from vv.gate.all_checks import Terms, judged
from vv.plan import keys
from vv.plan.plan import Job, Plan
from vv.plan.project import Project
from vv.records.record import checked, described, measured
from vv.run.dossier import dossiers
from vv.run.runner import Batch, failed, run_batches
from vv.run.timing_phase import gaps, last_costs, timed_costs
from vv.store.provenance import provenance
from vv.store.store import Store

Record = dict[str, Any]
Progress = Callable[[Record], None]


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
    own, where a result without one is only noted.
    """

    workers: int
    timeout: float
    fresh: bool = False
    timing: Timing = Timing.NONE
    against: Path | None = None


def now_utc() -> datetime.datetime:
    """The time, as everything that is written down states it."""
    return datetime.datetime.now(datetime.UTC)


def carry_out(
    project: Project,
    plan: Plan,
    limits: Limits,
    progress: Progress,
    command: Sequence[str],
    clock: Callable[[], datetime.datetime] = now_utc,
) -> Record:
    """Run what is not stored, judge all, keep the manifest; returns it with its name."""
    store = Store(project.data())
    store.clear_scratch()
    run_keys = keys.run_keys(project, plan)
    record_keys = keys.record_keys(project, plan, run_keys)
    records: dict[int, Record] = {}
    for number, record in _records(plan, limits, store, run_keys, record_keys):
        records[number] = record
        progress(record)
    ordered = [records[number] for number in range(len(plan.jobs))]
    costs = _costs(plan, ordered, run_keys, store, limits)
    ordered = [_with_cost(record, costs.get(i)) for i, record in enumerate(ordered)]
    now = clock()
    terms = Terms(now.date(), limits.against, limits.timing is Timing.NEW)
    manifest = {
        "provenance": provenance(project.root, command, now),
        "codes": {
            code: _code(project, plan, code) for code in sorted({job.code for job in plan.jobs})
        },
        "cases": dossiers(plan),
        "untimed": gaps(plan, ordered, costs) if limits.timing in MEASURED else [],
        **judged(project, plan, ordered, terms),
    }
    name = f"{now:%Y%m%dT%H%M%S.%f}Z-{os.getpid()}"
    store.keep_manifest(name, manifest)
    return {**manifest, "name": name}


def _costs(
    plan: Plan,
    records: Sequence[Record],
    run_keys: Mapping[int, str],
    store: Store,
    limits: Limits,
) -> dict[int, dict[str, Any]]:
    """Job number -> timed cost, from the session that the limits ask for."""
    if limits.timing is Timing.NONE:
        return {}
    if limits.timing is Timing.LAST:
        return last_costs(plan, run_keys, store)
    new = limits.fresh or limits.timing is Timing.NEW
    return timed_costs(plan, records, run_keys, store, limits.timeout, new)


def _code(project: Project, plan: Plan, code: str) -> Record:
    """What was found of a code. files: names and digests, none for what is only source."""
    found = plan.found[code]
    digests = keys.executables(project, plan, code)
    return {"version": found.version, "installed": found.installed, "files": digests}


def _records(
    plan: Plan,
    limits: Limits,
    store: Store,
    run_keys: Mapping[int, str],
    record_keys: Mapping[int, str],
) -> Iterator[tuple[int, Record]]:
    """Yield (job number, record): first those that need no running, then as runs come in.

    What stands of a code that is here was not refused: its key holds all that a refusal hangs on.
    """
    waiting = {}
    for number, job in enumerate(plan.jobs):
        key = record_keys[number]
        stored = not limits.fresh and plan.found[job.code].installed
        if stored and (record := store.record(key)) is not None:
            yield number, {**_identity(plan, job, key), **record}
        elif (run := _known(job, run_keys[number], store if stored else None)) is not None:
            yield number, _kept(plan, job, run, key, store)
        else:
            waiting[number] = job
    loads = {plan.found[job.code].load for job in waiting.values()}
    for load in filter(None, loads):
        load()
    for number, run in run_batches(
        batches(waiting, plan, limits.workers), limits.workers, limits.timeout, store.scratch
    ):
        job = plan.jobs[number]
        whole = checked(run, job.ask)
        store.keep_run(run_keys[number], whole)
        yield number, _kept(plan, job, whole, record_keys[number], store)


def _known(job: Job, key: str, store: Store | None) -> Run | None:
    """What comes of a job without running it: what is stored, or else a refusal."""
    return (store.run(key) if store else None) or job.settled


def batches(waiting: Mapping[int, Job], plan: Plan, workers: int) -> list[Batch]:
    """One batch per scheme, or pieces of one where there are fewer schemes than workers.

    First a batch of each engine that compiles its kernels, which its other schemes then find;
    then external programs, which take longest. In each searches are last: what needs no rounds
    is then answered by a program that starts once.
    """
    groups: dict[tuple[str, str], list[int]] = {}
    for number, job in sorted(waiting.items(), key=lambda item: item[1].ask.search is not None):
        groups.setdefault((job.code, job.scheme), []).append(number)
    pieces = max(1, workers // max(1, len(groups)))
    made = []
    for (code, scheme), numbers in groups.items():
        for piece in range(pieces):
            share = tuple(numbers[piece::pieces])
            asks = tuple(waiting[number].ask for number in share)
            if share:
                made.append(Batch(plan.adapters[code], scheme, share, asks))
    first = {batch.adapter.name: batch for batch in reversed(made)}

    def turn(batch: Batch) -> int:
        if plan.found[batch.adapter.name].files:
            return 1
        return 0 if first[batch.adapter.name] is batch else 2

    return sorted(made, key=turn)


def _kept(plan: Plan, job: Job, run: Run, key: str, store: Store) -> Record:
    """Measure a run, keep the record if it says something, and return it with its identity.

    A run of which a quantity cannot be measured has failed: it may be what the case is to show.
    """
    trial = plan.trials[job.case, job.variant]
    entries: list[Record] = []
    arrays: dict[str, Any] = {}
    try:
        for quantity in trial.quantities if run.status is Status.RAN else ():
            entry, series = measured(run, quantity, job.method, job.ask.knobs)
            entries.append(entry)
            arrays.update(series)
    except Exception as error:
        run, entries = failed(error), []
    record = {**described(run), "quantities": entries}
    says = (Status.RAN, Status.DIVERGED) if isinstance(trial.study, Grid) else (Status.RAN,)
    if run.status in says:
        store.keep_record(key, record, arrays)
    return {**_identity(plan, job, key), **record}


def _identity(plan: Plan, job: Job, key: str) -> Record:
    """What a record is about; `key` leads to the arrays of its series."""
    return {
        "case": job.case,
        "variant": job.variant,
        "study": type(plan.trials[job.case, job.variant].study).__name__.lower(),
        "parameters": dict(job.parameters),
        "modified": job.modified,
        "code": job.code,
        "scheme": job.scheme,
        "code_version": plan.found[job.code].version,
        "method": job.method.name.lower().replace("_", "-"),
        "rung": dataclasses.asdict(job.ask.knobs),
        "key": key,
    }


def _with_cost(record: Record, cost: Mapping[str, Any] | None) -> Record:
    return record if cost is None else {**record, "cost": {**cost, "kind": "timed"}}
