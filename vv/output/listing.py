"""Lists what there is: cases, codes, and the jobs that a plan would run."""

from __future__ import annotations

from collections.abc import Container, Sequence
from typing import TYPE_CHECKING

from vv.output.terminal import say

if TYPE_CHECKING:
    from vv.case import Case
    from vv.codes.adapter import Adapter
    from vv.plan.plan import Job, Plan

STORED = "stored"


def print_jobs(plan: Plan, stored: Container[int]) -> None:
    """Each job in a line, with why it would not run; stored: the numbers of those answered."""
    fates = {number: _fate(job, number in stored) for number, job in enumerate(plan.jobs)}
    for number, job in enumerate(plan.jobs):
        say(f"{job.label}{f'  ({fates[number]})' if fates[number] else ''}")
    run, kept = (sum(fate == which for fate in fates.values()) for which in ("", STORED))
    say(f"{len(plan.jobs)} jobs, {run} would run, {kept} are stored")


def _fate(job: Job, stored: bool) -> str:
    if job.settled:
        return f"{job.settled.status.value}: {job.settled.reason}"
    return STORED if stored else ""


def print_cases(cases: Sequence[Case]) -> None:
    """Cases with their variants."""
    for case in cases:
        say(f"{case.name}  {case.title} [{case.source.doi or case.source.citation}]")
        width = max((len(variant.name) for variant in case.variants), default=0)
        for variant in case.variants:
            say(f"  {case.name}:{variant.name:<{width}}  {variant.summary}")


def print_codes(adapters: Sequence[Adapter]) -> None:
    """Codes with version, place, schemes, and how to install those that are missing."""
    for adapter in adapters:
        found = adapter.found()
        state = f"{found.version}  {found.path}" if found.installed else "not installed"
        say(f"{adapter.name}  {state}")
        if not found.installed:
            say(f"  to install: {found.how_to_install}")
        for scheme in adapter.schemes:
            knobs = ", ".join(scheme.knobs) or "none"
            lowered = [f"; {m.value} in scenes with {t.value}" for t, m in scheme.lowered.items()]
            how = f"[{scheme.method.value}{''.join(lowered)}; knobs: {knobs}]"
            say(f"  {adapter.name}/{scheme.name}: {scheme.summary} {how}")
