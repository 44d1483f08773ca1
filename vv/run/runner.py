"""Runs batches of asks in worker processes: parallel, timed out, and crash-proof."""

from __future__ import annotations

import contextlib
import ctypes
import multiprocessing
import os
import shutil
import signal
import time
import traceback
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from pathlib import Path

from vv.ask import Ask, Run, Status
from vv.base.processes import (
    adopt_orphans,
    end_children,
    end_descendants,
    end_those_in,
    end_with_descendants,
)
from vv.codes.adapter import Adapter
from vv.run.search import answers

GRACE = 5.0  # s a batch gets besides, for the start of its program


@dataclass(frozen=True, eq=False)
class Batch:
    """Asks that one worker answers in order; numbers: what the caller knows them by."""

    adapter: Adapter
    scheme: str
    numbers: tuple[int, ...]
    asks: tuple[Ask, ...]
    repeat: float = 0.0

    def rest(self, answered: int) -> Batch:
        """The asks after the first `answered` ones."""
        later = slice(answered, None)
        return Batch(self.adapter, self.scheme, self.numbers[later], self.asks[later], self.repeat)


@dataclass(eq=False)
class _Worker:
    """A running batch: how far it is, and when its present ask is overdue; timeout [s]."""

    batch: Batch
    process: BaseProcess
    pipe: Connection
    scratch: Path
    timeout: float
    deadline: float
    answered: int = 0
    failed: bool = False
    hung_up: bool = False


def run_batches(
    batches: Iterable[Batch], workers: int, timeout: float, scratch: Callable[[], Path]
) -> Iterator[tuple[int, Run]]:
    """Yield (number, run) as answers come in, from at most `workers` processes at a time.

    timeout: seconds for each ask. A worker that overruns it is killed with all it started; one
    that dies fails the ask in flight; the rest of its batch goes to a new worker either way.
    """
    waiting = deque(batches)
    running: list[_Worker] = []
    try:
        while waiting or running:
            while waiting and len(running) < workers:
                running.append(_start(waiting.popleft(), timeout, scratch()))
            for worker in list(running):
                yield from _answers(worker)
            for worker in [w for w in running if _is_over(w)]:
                running.remove(worker)
                yield from _finish(worker, waiting)
            _sleep_until_news(running)
    finally:
        for worker in running:
            _kill(worker)


def _start(batch: Batch, timeout: float, scratch: Path) -> _Worker:
    context = multiprocessing.get_context("fork")
    receiver, sender = context.Pipe(duplex=False)
    process = context.Process(target=_work, args=(batch, sender, scratch), daemon=True)
    process.start()
    with contextlib.suppress(OSError):  # the worker does the same; whoever comes first
        os.setpgid(process.pid or 0, process.pid or 0)
    sender.close()
    deadline = time.monotonic() + timeout + GRACE
    return _Worker(batch, process, receiver, scratch, timeout, deadline)


def _work(batch: Batch, pipe: Connection, scratch: Path) -> None:
    """In the worker: answer the asks, one message each."""
    with contextlib.suppress(OSError):
        os.setpgid(0, 0)
    _die_with_parent()
    adopt_orphans()
    if batch.repeat > 0:  # timed: one core, whatever the program would take
        os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})
    with open(scratch / "worker.log", "wb", buffering=0) as log:
        os.dup2(log.fileno(), 1)
        os.dup2(log.fileno(), 2)
    try:
        for run in answers(batch.adapter, batch.asks, batch.scheme, scratch, batch.repeat):
            pipe.send(run)
    except Exception as error:
        traceback.print_exc()
        pipe.send(failed(error))
    end_children()  # what a program has left behind


def failed(error: Exception) -> Run:
    """What comes of an adapter or a measurement that raised an error: what it says, and where."""
    last = traceback.extract_tb(error.__traceback__)[-1]
    where = f"{Path(last.filename).name}:{last.lineno}"
    return Run(Status.ERROR, f"{type(error).__name__}: {error} ({where})")


def _die_with_parent() -> None:
    """Have the kernel end this worker, and what it started, when the parent is gone."""
    signal.signal(signal.SIGTERM, lambda *_: _end_all())
    with contextlib.suppress(OSError, AttributeError):  # only Linux has prctl
        ctypes.CDLL(None).prctl(1, signal.SIGTERM)
    parent = multiprocessing.parent_process()
    if parent is not None and os.getppid() != parent.pid:  # gone before the kernel was told
        _end_all()


def _end_all() -> None:
    """End what this worker started, and the worker."""
    end_descendants(os.getpid())
    os.killpg(0, signal.SIGKILL)


def _answers(worker: _Worker) -> Iterator[tuple[int, Run]]:
    try:
        while worker.answered < len(worker.batch.asks) and worker.pipe.poll():
            run = worker.pipe.recv()
            yield worker.batch.numbers[worker.answered], run
            worker.answered += 1
            worker.failed |= run.status is not Status.RAN
            worker.deadline = time.monotonic() + worker.timeout
    except (EOFError, OSError):
        worker.hung_up = True


def _is_over(worker: _Worker) -> bool:
    complete = worker.answered == len(worker.batch.asks)
    return complete or worker.hung_up or time.monotonic() > worker.deadline


def _finish(worker: _Worker, waiting: deque[Batch]) -> Iterator[tuple[int, Run]]:
    """End a worker; what it left over is queued, after the ask in flight has been failed."""
    left = worker.batch.rest(worker.answered)
    if worker.hung_up:
        worker.process.join()
    _kill(worker)
    refused_to_go_on = worker.hung_up and worker.process.exitcode == 0 and worker.answered > 0
    if left.asks and not refused_to_go_on:
        status = Status.ERROR if worker.hung_up else Status.TIMEOUT
        late = f"no answer in time, --timeout {worker.timeout:g} s"
        how = _how_it_died(worker) if worker.hung_up else late
        yield left.numbers[0], Run(status, f"{how}; see {worker.scratch}")
        worker.failed = True
        left = left.rest(1)
    if left.asks:
        waiting.append(left)
    if not worker.failed:
        shutil.rmtree(worker.scratch, ignore_errors=True)


def _how_it_died(worker: _Worker) -> str:
    code, asks = worker.process.exitcode, len(worker.batch.asks)
    if code is not None and code < 0:
        return f"the worker was killed by {signal.Signals(-code).name}"
    if code == 0:
        return f"the adapter answered {worker.answered} of {asks} asks and stopped"
    return f"the worker ended early with exit code {code}"


def _kill(worker: _Worker) -> None:
    """End a worker with all that it started, whichever process group that is in by now."""
    if worker.process.is_alive():
        end_with_descendants(worker.process.pid or 0)
    with contextlib.suppress(ProcessLookupError, PermissionError):
        os.killpg(worker.process.pid or 0, signal.SIGKILL)
    worker.process.join()
    if worker.hung_up or worker.failed:
        end_those_in(worker.scratch)
    worker.pipe.close()


def _sleep_until_news(running: Sequence[_Worker]) -> None:
    if running:
        nearest = min(worker.deadline for worker in running) - time.monotonic()
        pipes: list[Connection] = [worker.pipe for worker in running]
        wait(pipes, timeout=max(0.0, min(nearest, 1.0)))
