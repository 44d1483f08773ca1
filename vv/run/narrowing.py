"""Narrows a plan: to what failed last time, what a change can affect, what fits a budget."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

from vv.base.closure import import_closure
from vv.base.errors import UsageError
from vv.gate.judgement import record_findings
from vv.plan.keys import MEASURING, roots
from vv.plan.plan import Job, Plan, with_jobs_kept
from vv.plan.project import Project
from vv.records.job_record import Record
from vv.records.manifest import Manifest
from vv.records.reading import ran, settings
from vv.run.pace import Key, key, key_of, past

EVERYTHING = ("pyproject.toml", "requirements.lock")  # they decide the versions of libraries
SECONDS = {"s": 1.0, "min": 60.0, "h": 3600.0}
UNKNOWN = 1.0  # the assumed duration [s] of a job that never ran


def failing_keys(manifest: Manifest) -> set[Key]:
    """The keys of the jobs whose records turn a gate red."""
    return {key_of(record) for record in failing_records(manifest)}


def failing_records(manifest: Manifest) -> list[Record]:
    """The records of an invocation that by themselves turn a gate red."""
    return [record for record in manifest.records if _wrong(record)]


def failing_places(manifest: Manifest) -> dict[tuple[str, ...], list[str]]:
    """The CASE:VARIANT of the results that turn a gate red, by their changed parameters.

    The parameters are those that a user changed, as --set takes them; empty where none was.
    """
    found: dict[tuple[str, ...], dict[str, None]] = {}
    for record in failing_records(manifest):
        found.setdefault(tuple(settings(record)), {})[f"{record.case}:{record.variant}"] = None
    return {texts: [*places] for texts, places in found.items()}


def _wrong(record: Record) -> bool:
    """Whether a record by itself turns a gate red."""
    return any(finding.case for finding in record_findings([record]))


def affected(project: Project, plan: Plan, changed: Iterable[Path]) -> Plan:
    """The jobs whose case or code imports a changed file, directly or indirectly."""
    files = frozenset(changed)
    places = roots(project)
    if any(path.name in EVERYTHING for path in files):
        return plan
    case_files = project.case_files()
    cases = {
        name
        for name in plan.cases
        if _touched(import_closure([case_files[name], *MEASURING], places), files)
    }
    codes = {
        name
        for name in plan.adapters
        if _touched([*import_closure(project.adapter_files(name), places)], files)
    }
    return with_jobs_kept(plan, lambda job: job.case in cases or job.code in codes)


def _touched(sources: Iterable[Path], changed: frozenset[Path]) -> bool:
    """Whether a source changed, or a file in its folder, which it may have read, was deleted."""
    own = frozenset(sources)
    deleted = {path.parent for path in changed if not path.exists()}
    return not own.isdisjoint(changed) or any(path.parent in deleted for path in own)


def budget_seconds(text: str) -> float:
    """A budget as typed, 60s, 5min or 1h; plain numbers are seconds."""
    match = re.fullmatch(r"\s*(\d+(?:\.\d*)?)\s*(s|min|h)?\s*", text)
    if match is None or float(match[1]) <= 0:
        raise UsageError(f"--budget '{text}': not a duration such as 60s, 5min or 1h")
    return float(match[1]) * SECONDS[match[2] or "s"]


def within_budget(plan: Plan, budget: float, manifests: Sequence[Manifest]) -> Plan:
    """The most informative jobs that fit a budget [s], by the costs of past runs, newest first.

    Jobs that are new or did not pass come first, then those closest to their tolerance; of each
    scheme and variant the two cheapest rungs come before any other. Jobs that cannot run cost
    nothing.
    """
    known = past(manifests)
    costs = {id(job): _cost(job, known) for job in plan.jobs}
    waiting: dict[tuple[str, ...], list[Job]] = {}
    for job in sorted(plan.jobs, key=lambda job: costs[id(job)]):
        waiting.setdefault(key(job)[:3], []).append(job)
    ranked = sorted(
        (max(0, place - 1), -_closeness_to_tolerance(job, known), costs[id(job)], number)
        for ladder in waiting.values()
        for place, job in enumerate(ladder)
        for number in [plan.jobs.index(job)]
    )
    kept, spent = set(), 0.0
    for _, _, cost, number in ranked:
        if spent + cost <= budget:
            spent += cost
            kept.add(id(plan.jobs[number]))
    return with_jobs_kept(plan, lambda job: id(job) in kept)


def _cost(job: Job, known: Mapping[Key, Record]) -> float:
    if job.settled is not None:
        return 0.0
    record = known.get(key(job))
    if record is None or not ran(record):
        return UNKNOWN
    return record.cost.elapsed


def _closeness_to_tolerance(job: Job, known: Mapping[Key, Record]) -> float:
    """How close a job was to its tolerance; infinite if it is new or did not pass."""
    record = known.get(key(job))
    if record is None or _wrong(record):
        return math.inf
    pairs = ((one.error, one.tolerance) for one in record.quantities)
    return max((error / bound for error, bound in pairs if error and bound), default=0.0)
