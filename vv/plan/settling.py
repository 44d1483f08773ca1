"""Finds out which jobs are refused, in several processes if that takes long."""

from __future__ import annotations

import contextlib
import itertools
import multiprocessing
import signal
import time
from collections.abc import Sequence
from multiprocessing.connection import Connection

from vv.plan.plan import Job

ALONE = 0.3  # CPU s after which the rest is shared out; to do so takes a tenth of that


def settle(jobs: Sequence[Job], processes: int) -> None:
    """Determine the outcome of each job that need not run, such as a refusal: see `Job.settled`."""
    begun = time.process_time()
    for place, job in enumerate(jobs):
        if processes > 1 and time.process_time() - begun > ALONE:
            _share(jobs[place:], processes)
            return
        job.settled  # noqa: B018  # found once, and kept


def _share(jobs: Sequence[Job], processes: int) -> None:
    """The same in forked processes, and one share here; a share that is lost is settled here."""
    context = multiprocessing.get_context("fork")
    own, *others = _shares(jobs, processes)
    helpers = []
    for share in others:
        receiver, sender = context.Pipe(duplex=False)
        helper = context.Process(target=_send_outcomes, args=(share, sender), daemon=True)
        helper.start()
        sender.close()
        helpers.append((share, receiver, helper))
    settle(own, 1)
    for share, receiver, helper in helpers:
        with contextlib.suppress(EOFError, OSError), receiver:
            for job, outcome in zip(share, receiver.recv(), strict=True):
                job.settle_as(outcome)
        helper.join()
        settle(share, 1)


def _shares(jobs: Sequence[Job], count: int) -> list[list[Job]]:
    """The jobs of each variant together, since what is computed of its scene is shared."""
    shares: list[list[Job]] = [[] for _ in range(count)]
    variants = itertools.groupby(jobs, key=lambda job: (job.case, job.variant))
    for share, (_, one) in zip(itertools.cycle(shares), variants, strict=False):
        share.extend(one)
    return shares


def _send_outcomes(jobs: Sequence[Job], sender: Connection) -> None:
    """In a forked process: send the outcomes; nothing after an error, which the parent meets."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the parent ends it
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    with contextlib.suppress(Exception), sender:
        sender.send([job.settled for job in jobs])
