"""A worker of a cluster: answers the asks of a batch, or holds a timing session.

A batch runs in its own process, which is ended after its timeout together with all its descendants.
A worker refuses a code whose sources or programs are not those of the head.
"""

from __future__ import annotations

import dataclasses
import functools
import multiprocessing
import re
import socket
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from vv.ask import Ask, Run, Status
from vv.base.errors import UsageError
from vv.codes.external import last_lines
from vv.plan import imports, keys
from vv.plan.project import Project
from vv.run.process import Batch
from vv.run.rounds import Timed, rounds
from vv.run.runner import run_batches

PLACE = re.compile(r"; see (\S+)$")  # the end of a reason that names a folder of the worker
Answers = list[tuple[int, Run]]
Measured = tuple[list[Timed], list[str]]  # and why some batches were not timed


@dataclass(frozen=True)
class Task:
    """A batch in the form in which it is sent, with the name and the digest of the code.

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
    repeat: float


def resources(dask_worker: Any) -> list[str]:
    """The resources of this worker."""
    return list(dask_worker.state.total_resources)


def measure(tasks: Sequence[Task], timeout: float) -> Measured:
    """A timing session of these tasks."""
    reasons = {task.code: _why_not(task) for task in tasks}
    batches = [_batch(task) for task in tasks if not reasons[task.code]]
    with tempfile.TemporaryDirectory(prefix="vv-", ignore_cleanup_errors=True) as root:
        seen = rounds(batches, timeout, lambda: Path(tempfile.mkdtemp(dir=root)))
    return seen, [f"{socket.gethostname()}: {reason}" for reason in reasons.values() if reason]


def answer(task: Task, timeout: float) -> Answers:
    """The runs of a task, or for each ask the reason why this worker cannot run it."""
    if reason := _why_not(task):
        return [(n, Run(Status.ERROR, f"{socket.gethostname()}: {reason}")) for n in task.numbers]
    with tempfile.TemporaryDirectory(prefix="vv-", ignore_cleanup_errors=True) as root:
        runs = run_batches([_batch(task)], 1, timeout, lambda: Path(tempfile.mkdtemp(dir=root)))
        return [(number, _with_log(run)) for number, run in runs]


def _batch(task: Task) -> Batch:
    """The batch of a task, with its code loaded."""
    adapter = _project(task).load_adapter(task.code)
    found = adapter.found()
    if found.load:
        found.load()
    asked = task.numbers, task.asks, task.repeat
    return Batch(adapter, task.scheme, *asked, found.worker_stays)


def _project(task: Task) -> Project:
    if task.root is None:
        own = Project(imports.OWN, bundled=imports.OWN == imports.BUNDLE)
        return own.with_programs(task.programs)
    return Project(task.root, programs=task.programs)


@functools.cache
def _digest(root: Path | None, programs: tuple[Path, ...], code: str) -> str:
    """The digest of a code, taken when it was loaded; later edits are not in memory."""
    project = _project(Task(root, programs, code, "", "", (), (), 0.0))
    return keys.code_digest(project, project.load_adapter(code).found(), code)


def _why_not(task: Task) -> str:
    try:
        own = _digest(task.root, task.programs, task.code)
    except UsageError as error:
        return f"{error}; a worker holds one project in memory: restart the workers for another"
    if own != task.digest:
        what = f"the sources, libraries or programs of {task.code} are not those of the head"
        return f"{what}; if they were changed, restart the workers"
    if multiprocessing.current_process().daemon:
        return "a worker must start processes: set distributed.worker.daemon to False"
    return ""


def _with_log(run: Run) -> Run:
    """The run; a folder of this worker in its reason is replaced by the end of the log there."""
    place = PLACE.search(run.reason)
    if place is None:
        return run
    reason = f"{run.reason[: place.start()]}; {last_lines(Path(place[1]) / 'worker.log', 3)}"
    return dataclasses.replace(run, reason=reason)
