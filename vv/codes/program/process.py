"""Runs a program on one question in an empty folder, and reads its answer and cost."""

from __future__ import annotations

import contextlib
import dataclasses
import os
import resource
import shutil
import signal
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from vv.ask import Ask, Cost, Model, Run, Status
from vv.codes import external
from vv.codes.program import answer
from vv.codes.program.result import RESULT

ASK = "ask.json"
REFUSED = 3  # the exit code with which a program refuses what it is asked
TOO_LARGE = (-signal.SIGXFSZ, 128 + signal.SIGXFSZ)  # how it, or a shell of it, ends by `_bounded`
JITTER = 0.02  # CPU s by which clocks of a program and of the system may differ
WHOLE = "its cost is that of the whole process, start and output included"


@dataclass(frozen=True)
class Question:
    """What a program is asked: the ask, its text as ask.json, and what the declaration promises."""

    ask: Ask
    text: str
    model: Model


def run(command: Sequence[str], asked: Question, scratch: Path, name: str) -> Run:
    """Put a question to a program in a new folder, which is removed unless something went wrong.

    name: what the name of the folder begins with.
    """
    folder = external.new_folder(scratch, name)
    (folder / ASK).write_text(asked.text)
    before, begun = _cpu_of_children(), time.perf_counter()
    try:
        with _bounded():
            program = external.start(command, folder, errors=folder / "stderr.log")
    except OSError as error:
        return Run(Status.ERROR, f"{command[0]} cannot be started: {error.strerror}")
    _fix_bound(program)
    try:
        too_much = external.await_end(program, folder)
    finally:
        external.stop(program)
    spent = Cost(solve_wall=time.perf_counter() - begun, solve_cpu=_cpu_of_children() - before)
    found = _answer(program, asked, folder, too_much, spent)
    if found.status is Status.RAN:
        shutil.rmtree(folder, ignore_errors=True)
    else:
        _shorten(folder)
    return found


def _answer(
    program: external.Process, asked: Question, folder: Path, too_much: str | None, spent: Cost
) -> Run:
    """What an ended program says, by its exit code and by what it wrote."""
    if too_much:
        return Run(Status.ERROR, too_much)
    code = program.process.returncode
    if code == REFUSED:
        reason = external.last_line(folder / "stderr.log")
        return Run(Status.REFUSED, reason or f"exit code {REFUSED}, and no reason on stderr")
    if code != 0:
        how = external.how_it_ended(program)
        return Run(Status.ERROR, f"{_grew()}; {how}" if code in TOO_LARGE else how)
    found, stepping = answer.read(folder, asked.ask, asked.model)
    return _costed(found, stepping, spent) if found.status is Status.RAN else found


def _costed(found: Run, stepping: float | None, spent: Cost) -> Run:
    """The run with its cost: stepping [CPU s] if the program stated it, else all that was spent."""
    if stepping is None:
        cost = dataclasses.replace(spent, whole=True)
        return dataclasses.replace(found, cost=cost, model=found.model and _noted(found.model))
    beside = spent.solve_cpu - stepping
    if beside < -JITTER:
        stated = f"{RESULT}: solve_cpu = {stepping:g} s"
        return Run(Status.ERROR, f"{stated}; the whole process took {spent.solve_cpu:.3g} CPU s")
    wall = max(0.0, spent.solve_wall - beside)
    cost = Cost(startup=max(0.0, beside), solve_cpu=stepping, solve_wall=wall)
    return dataclasses.replace(found, cost=cost)


def _noted(model: Model) -> Model:
    note = f"{model.note}; {WHOLE}" if model.note else WHOLE
    return dataclasses.replace(model, note=note)


def _cpu_of_children() -> float:
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def _shorten(folder: Path) -> None:
    """Cut the files of a failed run to a readable size."""
    for path, size in external.sizes(folder):
        if size > external.LARGEST_LOG:
            os.truncate(path, external.TAIL)


def _grew() -> str:
    return f"the program was stopped because a file that it wrote exceeded {_most() / 1e6:g} MB"


def _most() -> int:
    """Bytes of a file: what lies in the folder is noticed first."""
    return 2 * external.LARGEST_LOG


@contextlib.contextmanager
def _bounded() -> Iterator[None]:
    """Limit the size of files, also of deleted ones that are still open.

    A child process inherits the limit before it can start others.
    """
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    unbound = resource.RLIM_INFINITY
    least = min(one for one in (_most(), soft, hard) if one != unbound)
    resource.setrlimit(resource.RLIMIT_FSIZE, (least, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))


def _fix_bound(program: external.Process) -> None:
    """Prevent the program from raising its limit."""
    with contextlib.suppress(OSError):  # it has ended
        resource.prlimit(program.process.pid, resource.RLIMIT_FSIZE, (_most(), _most()))
