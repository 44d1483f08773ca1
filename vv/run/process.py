"""A worker process: answers the asks of batches, and ends when its parent is gone."""

from __future__ import annotations

import contextlib
import ctypes
import dataclasses
import multiprocessing
import os
import signal
import traceback
from collections.abc import Sequence
from dataclasses import dataclass
from multiprocessing.connection import Connection
from pathlib import Path

from vv.ask import Ask, Run, Status
from vv.base.processes import adopt_orphans, end_children, end_descendants
from vv.codes.adapter import Adapter
from vv.run.search import answers


@dataclass(frozen=True, eq=False)
class Batch:
    """Asks that one worker answers in order; numbers: the caller's numbers of the asks.

    stays: whether the worker may continue with another batch of the same adapter, for which its
    kernels or a waiting program are then already in memory.
    """

    adapter: Adapter
    scheme: str
    numbers: tuple[int, ...]
    asks: tuple[Ask, ...]
    repeat: float = 0.0
    stays: bool = False

    def rest(self, answered: int) -> Batch:
        """The asks after the first `answered` ones."""
        later = slice(answered, None)
        return dataclasses.replace(self, numbers=self.numbers[later], asks=self.asks[later])


def work(known: Sequence[Batch], orders: Connection, pipe: Connection, scratch: Path) -> None:
    """Answer the first batch, with one message per ask, and then the batches that are ordered."""
    with contextlib.suppress(OSError):
        os.setpgid(0, 0)
    die_with_parent()
    adopt_orphans()
    if known[0].repeat > 0:  # timing uses one core, even if the program would use more
        os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})
    with open(scratch / "worker.log", "wb", buffering=0) as log:
        os.dup2(log.fileno(), 1)
        os.dup2(log.fileno(), 2)
    batch = known[0]
    may_wait = batch.adapter.found().may_wait or contextlib.nullcontext
    with may_wait():
        while _answered(batch, pipe, scratch) and batch.stays and len(known) > 1:
            batch = known[orders.recv()]
    end_children()  # programs that wait for more asks, and orphaned children


def _answered(batch: Batch, pipe: Connection, scratch: Path) -> bool:
    """Answer the asks of a batch; returns whether the worker may go on."""
    sent = 0
    try:
        for run in answers(batch.adapter, batch.asks, batch.scheme, scratch, batch.repeat):
            pipe.send(run)
            sent += 1
    except Exception as error:
        traceback.print_exc()
        if sent < len(batch.asks):
            pipe.send(failed(error))
        return False
    return True


def failed(error: Exception) -> Run:
    """The run of an adapter or measurement that raised an error: its message and location."""
    last = traceback.extract_tb(error.__traceback__)[-1]
    where = f"{Path(last.filename).name}:{last.lineno}"
    return Run(Status.ERROR, f"{type(error).__name__}: {error} ({where})")


def die_with_parent() -> None:
    """Let the operating system end this worker and its children when the parent ends."""
    signal.signal(signal.SIGTERM, lambda *_: _end_all())
    with contextlib.suppress(OSError, AttributeError):  # only Linux has prctl
        ctypes.CDLL(None).prctl(1, signal.SIGTERM)
    parent = multiprocessing.parent_process()
    if parent is not None and os.getppid() != parent.pid:  # the parent ended before the call
        _end_all()


def _end_all() -> None:
    """End all processes that this worker started, and the worker."""
    end_descendants(os.getpid())
    os.killpg(0, signal.SIGKILL)
