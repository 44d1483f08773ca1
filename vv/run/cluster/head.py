"""Sends batches to the workers of a dask cluster; this machine keeps store and messages.

Costs are timed in one task by a worker with the resource `timing`, or else on this machine.
"""

from __future__ import annotations

import contextlib
import importlib
import logging
import socket
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import CancelledError
from dataclasses import dataclass
from typing import Any

from vv.ask import Run, Status
from vv.base.errors import UsageError
from vv.base.notices import notice
from vv.plan import imports
from vv.plan.plan import Job
from vv.plan.project import Project
from vv.records.manifest import Machine
from vv.run.cluster.worker import Task, answer, measure, resources
from vv.run.pace import Pace, piles
from vv.run.process import Batch
from vv.run.rounds import Timed, rounds
from vv.store.provenance import machine
from vv.store.store import Store

SCHEME = "dask://"
PATIENCE = 5.0  # s that the scheduler may take to answer
WORTHWHILE = 1.0  # s that a batch should take at least, compared with the 8 ms that a task costs
STARTS = 4.0  # multiples of its program's start-up time that a batch should take at least
LONGEST = 500  # the most characters of a reason
TIMING = "timing"  # the resource of a worker that has a machine of its own


@dataclass(frozen=True)
class Cluster:
    """The workers of a dask scheduler.

    digests: of every code, as the head has it; paces: id of a job -> its expected duration.
    """

    address: str
    project: Project
    digests: Mapping[str, str]
    paces: Mapping[int, Pace]

    def shares(self, jobs: Sequence[Job], schemes: int) -> Iterator[tuple[int, ...]]:
        """Batches of at least a second and several times the start-up time of the program."""
        expected = [self.paces[id(job)] for job in jobs]
        start = max(pace.start for pace in expected)
        rest = [pace.rest for pace in expected]
        count = int(sum(rest) / max(WORTHWHILE, STARTS * start))
        return piles(rest, min(len(jobs), max(1, count)))

    def run(self, batches: Iterable[Batch], timeout: float) -> Iterator[tuple[int, Run]]:
        """Yield (number, run) batch by batch; a batch that kills its worker twice has failed.

        A worker that dies also loses the batches waiting for it; each of these is tried again,
        alone.
        """
        with self._client() as client:
            due = {self._submitted(client, batch, timeout): batch for batch in batches}
            lost = []
            for future in _distributed().as_completed(list(due)):
                came = _came(future)
                if isinstance(came, CancelledError):  # no worker is left to try it again
                    yield from _failed(due[future], "the scheduler is gone")
                elif isinstance(came, Exception):
                    lost.append(due[future])
                else:
                    yield from came
            for batch in lost:
                came = _came(self._submitted(client, batch, timeout))
                failed = isinstance(came, Exception)
                why = f"the worker failed: {type(came).__name__}: {came}"[:LONGEST]
                yield from _failed(batch, why) if failed else came

    def timer(self) -> Machine:
        """The machine of a worker with the resource `timing`; this machine if there is none."""
        with self._client() as client:
            if not _may_time(client):
                return machine()
            found: Machine = _to_time(client, machine).result()
            return found

    def timed(self, batches: Sequence[Batch], timeout: float) -> list[Timed]:
        """Time all batches in one task on that worker; a notice names those not timed."""
        with self._client() as client:
            if not _may_time(client):
                return rounds(batches, timeout, Store(self.project.data()).scratch)
            future = _to_time(client, measure, list(map(self._task, batches)), timeout)
            came = _came(future)
        if isinstance(came, Exception):
            notice(f"nothing was timed: {type(came).__name__}: {came}"[:LONGEST])
            return []
        seen, untimed = came
        for reason in untimed:
            notice(f"not timed: {reason}")
        return list(seen)

    def _submitted(self, client: Any, batch: Batch, timeout: float) -> Any:
        return client.submit(answer, self._task(batch), timeout, pure=False, retries=0)

    def _task(self, batch: Batch) -> Task:
        code, project = batch.adapter.name, self.project
        root = None if project.root == imports.OWN else project.root
        digest = self.digests[code]
        programs, asked = project.programs, (batch.numbers, batch.asks, batch.repeat)
        return Task(root, programs, code, digest, batch.scheme, *asked)

    @contextlib.contextmanager
    def _client(self) -> Iterator[Any]:
        """A connection to the scheduler; raises UsageError where there is none."""
        place = self.address.removeprefix(SCHEME)
        try:
            distributed = _distributed()
        except ImportError as error:
            raise UsageError(f"--executor {self.address}: install vv[dask] to use it") from error
        host, _, port = place.rpartition(":")
        try:
            socket.create_connection((host, int(port)), PATIENCE).close()
            client = distributed.Client(place, timeout=PATIENCE)
        except (OSError, ValueError) as error:
            raise UsageError(f"--executor {self.address}: no scheduler answers there") from error
        with client:
            if not client.nthreads():
                notice(f"{self.address} has no workers yet; jobs wait for the first")
            yield client


def _distributed() -> Any:
    """The optional library; its log of a lost connection is silenced, since vv reports it."""
    library = importlib.import_module("distributed")
    logging.disable()
    return library


def _came(future: Any) -> Any:
    """The result of a task: its answers, or the error that ended it."""
    try:
        return future.result()
    except Exception as error:
        return error


def _failed(batch: Batch, reason: str) -> Iterator[tuple[int, Run]]:
    """A failure for every ask of a batch."""
    yield from ((number, Run(Status.ERROR, reason)) for number in batch.numbers)


def _may_time(client: Any) -> bool:
    """Whether a worker has the resource `timing`."""
    return any(TIMING in found for found in client.run(resources, on_error="ignore").values())


def _to_time(client: Any, what: Callable[..., object], *given: object) -> Any:
    """The future of a call by a worker that may time."""
    return client.submit(what, *given, pure=False, retries=0, resources={TIMING: 1})
