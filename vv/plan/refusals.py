"""Determines which jobs are refused, in several processes if that takes long."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

from vv.ask import Run
from vv.base.parallel import parallel_map
from vv.plan.plan import Job


def settle(jobs: Sequence[Job], processes: int) -> None:
    """Determine the outcome of each job that need not run, such as a refusal: see `Job.settled`.

    The jobs of a variant are handled together, since they share a scene and what is derived from
    it.
    """
    grouped = itertools.groupby(jobs, key=lambda job: (job.case, job.variant))
    variants = [list(group) for _, group in grouped]
    for variant, outcomes in zip(
        variants, parallel_map(_outcomes, variants, processes), strict=True
    ):
        for job, outcome in zip(variant, outcomes, strict=True):
            job.settle_as(outcome)


def _outcomes(jobs: Sequence[Job]) -> list[Run | None]:
    return [job.settled for job in jobs]
