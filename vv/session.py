"""One invocation: answer jobs from the store or by running, measure, time, and write it down."""

from __future__ import annotations

import dataclasses
import datetime
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from vv import keys
from vv.ask import Run, Status
from vv.dossier import dossiers
from vv.gate import judge, read_disagreements
from vv.plan import Job, Plan
from vv.project import Project
from vv.provenance import provenance
from vv.record import checked, described, measured
from vv.runner import Batch, run_batches
from vv.store import Store
from vv.timing_phase import timed_costs

Progress = Callable[[Job, Run], None]
Record = dict[str, Any]


@dataclass(frozen=True)
class Limits:
    """How an invocation may use the machine: processes, seconds per job, the store or not."""

    workers: int
    timeout: float
    fresh: bool = False
    timing: bool = False


def carry_out(
    project: Project, plan: Plan, limits: Limits, progress: Progress, command: Sequence[str]
) -> Record:
    """Run what is not stored, judge all, keep the manifest; returns it with its name."""
    store = Store(project.data())
    run_keys = keys.run_keys(project, plan)
    record_keys = keys.record_keys(project, plan, run_keys)
    records = dict(_records(plan, limits, store, run_keys, record_keys, progress))
    ordered = [records[number] for number in range(len(plan.jobs))]
    if limits.timing:
        costs = timed_costs(plan, ordered, run_keys, store, limits.timeout, limits.fresh)
        ordered = [_with_cost(record, costs.get(i)) for i, record in enumerate(ordered)]
    now = datetime.datetime.now(datetime.UTC)
    known = read_disagreements(project.root / "cases" / "disagreements.toml")
    manifest = {
        "provenance": provenance(project.root, command, now),
        "cases": dossiers(plan),
        "records": judge(ordered, known, now.date().isoformat()),
    }
    name = f"{now:%Y%m%dT%H%M%S.%f}Z-{os.getpid()}"
    store.keep_manifest(name, manifest)
    return {**manifest, "name": name}


def _records(
    plan: Plan,
    limits: Limits,
    store: Store,
    run_keys: Mapping[int, str],
    record_keys: Mapping[int, str],
    progress: Progress,
) -> Iterator[tuple[int, Record]]:
    """Yield (job number, record): first those that need no running, then as runs come in."""
    waiting = {}
    for number, job in enumerate(plan.jobs):
        key = record_keys[number]
        stored = not limits.fresh and job.settled is None
        if stored and (record := store.record(key)) is not None:
            yield number, {**_identity(plan, job, key), **record}
        elif (run := store.run(run_keys[number]) if stored else job.settled) is not None:
            yield number, _kept(plan, job, run, key, store)
        else:
            waiting[number] = job
    for number, run in run_batches(
        batches(waiting, plan, limits.workers), limits.workers, limits.timeout, store.scratch
    ):
        job = plan.jobs[number]
        whole = checked(run, job.ask)
        store.keep_run(run_keys[number], whole)
        progress(job, whole)
        yield number, _kept(plan, job, whole, record_keys[number], store)


def batches(waiting: Mapping[int, Job], plan: Plan, workers: int) -> list[Batch]:
    """One batch per scheme, or pieces of one where there are fewer schemes than workers.

    External programs come first: they take longest.
    """
    groups: dict[tuple[str, str], list[int]] = {}
    for number, job in waiting.items():
        groups.setdefault((job.code, job.scheme), []).append(number)
    pieces = max(1, workers // max(1, len(groups)))
    made = []
    for (code, scheme), numbers in groups.items():
        for piece in range(pieces):
            share = tuple(numbers[piece::pieces])
            asks = tuple(waiting[number].ask for number in share)
            if share:
                made.append(Batch(plan.adapters[code], scheme, share, asks))
    return sorted(made, key=lambda batch: not plan.found[batch.adapter.name].files)


def _kept(plan: Plan, job: Job, run: Run, key: str, store: Store) -> Record:
    """Measure a run, keep the record if it ran, and return it with its identity."""
    entries, arrays = [], {}
    if run.status is Status.RAN:
        for quantity in plan.trials[job.case, job.variant].quantities:
            entry, series = measured(run, quantity, job.method, job.ask.knobs)
            entries.append(entry)
            arrays.update(series)
    record = {**described(run), "quantities": entries}
    if run.status is Status.RAN:
        store.keep_record(key, record, arrays)
    return {**_identity(plan, job, key), **record}


def _identity(plan: Plan, job: Job, key: str) -> Record:
    """What a record is about; `key` leads to the arrays of its series."""
    return {
        "case": job.case,
        "variant": job.variant,
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
