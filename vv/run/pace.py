"""Estimates how long jobs take, from past runs, recorded results, or declarations of schemes."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from vv.gate.recorded import seconds_recorded
from vv.plan.plan import Job, Plan
from vv.records.job_record import Record
from vv.records.manifest import Manifest
from vv.records.reading import in_words, ran, rung

PAST = 10  # the most manifests that are read
UNKNOWN = 0.05  # the assumed duration [s] of a job if nothing is known
Key = tuple[str, str, str, str]


def key(job: Job) -> Key:
    """A job by case, variant, scheme and knobs."""
    return job.case, job.variant, f"{job.code}/{job.scheme}", in_words(job.ask.knobs)


def key_of(record: Record) -> Key:
    """The key of the job that a record belongs to."""
    return record.case, record.variant, record.label, rung(record)


def past(manifests: Iterable[Manifest]) -> dict[Key, Record]:
    """The first record of each job; manifests: newest first."""
    found: dict[Key, Record] = {}
    for manifest in manifests:
        for record in manifest.records:
            found.setdefault(key_of(record), record)
    return found


@dataclass(frozen=True)
class Pace:
    """Expected seconds of a job: start of its program, paid once per batch, and the solve."""

    start: float
    rest: float


def paces(plan: Plan, manifests: Iterable[Manifest], recorded: Sequence[Path]) -> dict[int, Pace]:
    """id of a job -> its pace, for the jobs that have to run.

    recorded: folders of recorded results.
    """
    known = past(manifests)
    due = [job for job in plan.jobs if job.settled is None]
    kept: dict[Key, float] = {}
    for code, case in dict.fromkeys((job.code, job.case) for job in due):
        for folder in recorded:
            kept.update(seconds_recorded(folder, code, case))
    return {id(job): _pace(plan, job, known, kept) for job in due}


def _pace(plan: Plan, job: Job, known: Mapping[Key, Record], kept: Mapping[Key, float]) -> Pace:
    record = known.get(key(job))
    if record is not None and ran(record):
        return Pace(record.cost.startup, record.cost.elapsed - record.cost.startup)
    schemes = {scheme.name: scheme for scheme in plan.adapters[job.code].schemes}
    step, body = schemes[job.scheme].pace
    dt, scene = job.ask.knobs.dt, job.ask.scene
    steps = job.ask.goal.steps(dt) if dt else 1
    expected = steps * (step + body * (len(scene.spheres.mass) + len(scene.blocks)))
    return Pace(0.0, kept.get(key(job)) or expected or UNKNOWN)


def piles(seconds: Sequence[float], count: int) -> Iterator[tuple[int, ...]]:
    """Distributes jobs of known durations [s] to a few piles of about equal total duration.

    Yields the places in each pile, ascending. The longest job is placed first, each on the pile
    that is smallest so far.
    """
    loads, shares = [0.0] * count, [list[int]() for _ in range(count)]
    for place in sorted(range(len(seconds)), key=lambda place: -seconds[place]):
        least = min(range(count), key=lambda pile: (loads[pile], len(shares[pile])))
        loads[least] += seconds[place]
        shares[least].append(place)
    yield from (tuple(sorted(share)) for share in shares if share)
