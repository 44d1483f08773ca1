"""Answers batches by the workers of a dask cluster; keys, store and messages stay at the head.

A worker runs a batch as this machine would, in a process of its own that is timed out and ended
with all that it started. It refuses a code whose sources or programs are not those of the head.
"""

from __future__ import annotations

import contextlib
import dataclasses
import functools
import importlib
import multiprocessing
import re
import shutil
import socket
import tempfile
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from vv.ask import Ask, Run, Status
from vv.base.errors import UsageError
from vv.codes.external import last_lines
from vv.plan import imports, keys
from vv.plan.project import Project
from vv.run.runner import Batch, run_batches

SCHEME = "dask://"
PATIENCE = 20.0  # s to find the scheduler
LONGEST = 500  # characters of a reason
PLACE = re.compile(r"; see (\S+)$")  # how a reason ends that names a folder of the worker
Answers = list[tuple[int, Run]]


@dataclass(frozen=True)
class Task:
    """A batch as it travels: the code by its name, and the digest that it has at the head.

    root: the folder of the project, which must be there for the workers too; None for what came
    with vv. programs: TOML files of further codes.
    """

    root: Path | None
    programs: tuple[Path, ...]
    code: str
    digest: str
    scheme: str
    numbers: tuple[int, ...]
    asks: tuple[Ask, ...]


@dataclass(frozen=True)
class Cluster:
    """The workers of a dask scheduler; digests: of every code, as the head has it."""

    address: str
    project: Project
    digests: Mapping[str, str]

    @property
    def workers(self) -> int:
        """The threads of all workers."""
        with self._client() as client:
            return max(1, sum(map(int, client.nthreads().values())))

    def run(self, batches: Iterable[Batch], timeout: float) -> Iterator[tuple[int, Run]]:
        """Yield (number, run) batch by batch; what kills its worker twice has failed.

        A dying worker takes with it what waits there: that is tried again, alone.
        """
        with self._client() as client:
            due = {self._submitted(client, batch, timeout): batch for batch in batches}
            lost = []
            for future in _distributed().as_completed(list(due)):
                if future.exception() is None:
                    yield from future.result()
                else:
                    lost.append(due[future])
            for batch in lost:
                future = self._submitted(client, batch, timeout)
                error = future.exception()
                reason = f"the worker failed: {type(error).__name__}: {error}"[:LONGEST]
                failed = [(number, Run(Status.ERROR, reason)) for number in batch.numbers]
                yield from failed if error is not None else future.result()

    def _submitted(self, client: Any, batch: Batch, timeout: float) -> Any:
        return client.submit(answer, self._task(batch), timeout, pure=False, retries=0)

    def _task(self, batch: Batch) -> Task:
        code, project = batch.adapter.name, self.project
        root = None if project.root == imports.OWN else project.root
        digest = self.digests[code]
        return Task(root, project.programs, code, digest, batch.scheme, batch.numbers, batch.asks)

    @contextlib.contextmanager
    def _client(self) -> Iterator[Any]:
        """A connection to the scheduler; raises UsageError where there is none."""
        try:
            client = _distributed().Client(self.address.removeprefix(SCHEME), timeout=PATIENCE)
        except ImportError as error:
            raise UsageError(f"--executor {self.address}: install vv[dask] to use it") from error
        except (OSError, ValueError) as error:
            raise UsageError(f"--executor {self.address}: no scheduler answers there") from error
        with client:
            yield client


def _distributed() -> Any:
    """The library, which is optional."""
    return importlib.import_module("distributed")


def answer(task: Task, timeout: float) -> Answers:
    """In a worker: what comes of a task, or for every ask the reason why it cannot be taken on."""
    if reason := _why_not(task):
        return [(n, Run(Status.ERROR, f"{socket.gethostname()}: {reason}")) for n in task.numbers]
    adapter = _project(task).load_adapter(task.code)
    if load := adapter.found().load:
        load()
    batch = Batch(adapter, task.scheme, task.numbers, task.asks)
    root = Path(tempfile.mkdtemp(prefix="vv-"))
    try:
        runs = run_batches([batch], 1, timeout, lambda: Path(tempfile.mkdtemp(dir=root)))
        return [(number, _told(run)) for number, run in runs]
    finally:
        shutil.rmtree(root, ignore_errors=True)


def _project(task: Task) -> Project:
    if task.root is None:
        own = Project(imports.OWN, bundled=imports.OWN == imports.BUNDLE)
        return own.with_programs(task.programs)
    return Project(task.root, programs=task.programs)


@functools.cache
def _digest(root: Path | None, programs: tuple[Path, ...], code: str) -> str:
    """The digest of a code when it was first asked for: later edits are not in memory."""
    project = _project(Task(root, programs, code, "", "", (), ()))
    return keys.code_digest(project, project.load_adapter(code).found(), code)


def _why_not(task: Task) -> str:
    if _digest(task.root, task.programs, task.code) != task.digest:
        what = f"the sources, libraries or programs of {task.code} are not those of the head"
        return f"{what}; if they were changed, restart the workers"
    if multiprocessing.current_process().daemon:
        return "a worker must start processes: set distributed.worker.daemon to False"
    return ""


def _told(run: Run) -> Run:
    """The run; where its reason names a folder of the worker, with the end of the log in it."""
    place = PLACE.search(run.reason)
    if place is None:
        return run
    told = f"{run.reason[: place.start()]}; {last_lines(Path(place[1]) / 'worker.log', 3)}"
    return dataclasses.replace(run, reason=told)
