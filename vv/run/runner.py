"""Starts worker processes for batches of asks, collects answers, and ends workers that hang."""

from __future__ import annotations

import contextlib
import multiprocessing
import os
import shutil
import signal
import time
from collections import deque
from collections.abc import Callable, Generator, Iterable, Iterator, Sequence
from dataclasses import dataclass
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from pathlib import Path

from vv.ask import Run, Status
from vv.base.processes import (
    end_those_in,
    end_with_descendants,
    name_of_signal,
)
from vv.run.limits import late
from vv.run.process import Batch, work

GRACE = 5.0  # additional s for a batch, for the start of its program


@dataclass(eq=False)
class _Worker:
    """A running batch with its progress and the deadline of its present ask; timeout [s].

    known: the batches that its process can answer; `orders` sends the index of the next one.
    """

    batch: Batch
    known: Sequence[Batch]
    process: BaseProcess
    pipe: Connection
    orders: Connection
    scratch: Path
    timeout: float
    deadline: float
    answered: int = 0
    failed: bool = False
    hung_up: bool = False

    @property
    def complete(self) -> bool:
        """Whether all asks of its batch are answered."""
        return self.answered == len(self.batch.asks)

    def goes_on_with(self, waiting: deque[Batch]) -> bool:
        """Order the next waiting batch if the process can answer it; returns whether it can."""
        fits = self.complete and not self.hung_up and self.batch.stays
        if not (fits and waiting and any(one is waiting[0] for one in self.known)):
            return False
        try:
            self.orders.send(next(i for i, one in enumerate(self.known) if one is waiting[0]))
        except OSError:  # the process has ended
            return False
        self.batch, self.answered = waiting.popleft(), 0
        self.deadline = time.monotonic() + self.timeout + GRACE
        return True


def run_batches(
    batches: Iterable[Batch], workers: int, timeout: float, scratch: Callable[[], Path]
) -> Generator[tuple[int, Run], None, None]:
    """Yield (number, run) as answers come in, from at most `workers` processes at a time.

    timeout: seconds for each ask. A worker that exceeds it is killed with all its descendants; if a
    worker dies, the ask in progress fails. In both cases a new worker takes the rest of the batch.
    """
    waiting = deque(batches)
    running: list[_Worker] = []
    try:
        while waiting or running:
            while waiting and len(running) < workers:
                running.append(_start(waiting.popleft(), waiting, timeout, scratch()))
            for worker in list(running):
                yield from _answers(worker)
            over = [w for w in running if _is_over(w)]
            for worker in [w for w in over if not w.goes_on_with(waiting)]:
                running.remove(worker)
                yield from _finish(worker, waiting)
            _sleep_until_news(running)
    finally:
        for worker in running:
            _kill(worker)


def _start(batch: Batch, waiting: Iterable[Batch], timeout: float, scratch: Path) -> _Worker:
    context = multiprocessing.get_context("fork")
    receiver, sender = context.Pipe(duplex=False)
    orders, orderer = context.Pipe(duplex=False)
    later = [one for one in waiting if one.stays and one.adapter is batch.adapter]
    known = (batch, *later) if batch.stays else (batch,)
    process = context.Process(target=work, args=(known, orders, sender, scratch), daemon=True)
    process.start()
    with contextlib.suppress(OSError):  # the worker does the same; whoever comes first
        os.setpgid(process.pid or 0, process.pid or 0)
    sender.close()
    orders.close()
    deadline = time.monotonic() + timeout + GRACE
    return _Worker(batch, known, process, receiver, orderer, scratch, timeout, deadline)


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
    return worker.complete or worker.hung_up or time.monotonic() > worker.deadline


def _finish(worker: _Worker, waiting: deque[Batch]) -> Iterator[tuple[int, Run]]:
    """End a worker: the ask in progress fails, the rest of its batch is queued again."""
    left = worker.batch.rest(worker.answered)
    if worker.hung_up:
        worker.process.join()
    _kill(worker)
    refused_to_go_on = worker.hung_up and worker.process.exitcode == 0 and worker.answered > 0
    if left.asks and not refused_to_go_on:
        status = Status.ERROR if worker.hung_up else Status.TIMEOUT
        how = _how_it_died(worker) if worker.hung_up else late(left.asks[0], worker.timeout)
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
        return f"the worker was killed by {name_of_signal(-code)}"
    if code == 0:
        return f"the adapter answered {worker.answered} of {asks} asks and stopped"
    return f"the worker ended early with exit code {code}"


def _kill(worker: _Worker) -> None:
    """End a worker with all its descendants, also those in other process groups."""
    if worker.process.is_alive():
        end_with_descendants(worker.process.pid or 0)
    with contextlib.suppress(ProcessLookupError, PermissionError):
        os.killpg(worker.process.pid or 0, signal.SIGKILL)
    worker.process.join()
    if worker.hung_up or worker.failed:
        end_those_in(worker.scratch)
    worker.pipe.close()
    worker.orders.close()


def _sleep_until_news(running: Sequence[_Worker]) -> None:
    if running:
        nearest = min(worker.deadline for worker in running) - time.monotonic()
        pipes: list[Connection] = [worker.pipe for worker in running]
        wait(pipes, timeout=max(0.0, min(nearest, 1.0)))
