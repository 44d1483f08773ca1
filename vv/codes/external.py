"""Runs external programs in folders, finds out why they ended, and continues their batch.

Time limits belong to the runner, which ends the worker's process group and all descendants; a
program is therefore started in the same group.
"""

from __future__ import annotations

import contextlib
import os
import subprocess
import tempfile
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from vv.ask import Run, Status
from vv.base.processes import end_with_descendants, name_of_signal

POLL = 0.02  # s between two checks for a result; one costs about 10 us
LARGEST_LOG = 64_000_000  # bytes of output after which a program is stopped, before it fills a disk
TAIL = 65_536  # bytes of a log in which its last lines are looked for
LONGEST = 300  # characters of a line that is quoted
FAREWELL = 2.0  # s that a program may take to end after its last answer


@dataclass(frozen=True)
class Process:
    """A started program: its process, the file that takes its output, its start [s, monotonic].

    errors: the file that takes its standard error, where that is kept apart from its output.
    """

    process: subprocess.Popen[bytes]
    log: Path
    started: float
    errors: Path | None = None


def new_folder(scratch: Path, name: str = "run") -> Path:
    """An empty folder in `scratch`, for the files of one call of an adapter.

    Files are named by the number of an ask. In a folder that was used before, the answer to an
    earlier ask of that number would be read before, or in place of, the one that is due.
    """
    return Path(tempfile.mkdtemp(prefix=f"{name}-", dir=scratch))


def start(
    command: Sequence[str],
    folder: Path,
    extra: Mapping[str, str] | None = None,
    errors: Path | None = None,
    stdin: int = subprocess.DEVNULL,
) -> Process:
    """Start a command in a folder, on one thread, with home and temporary folder there too.

    Standard output and error go to a log file in the folder, program-N.log; errors: a separate file
    for standard error, if wanted. extra: further environment variables. stdin: as for
    `subprocess.Popen`; it is not buffered. Raises OSError if the command cannot be started.
    """
    log = folder / f"program-{len(list(folder.glob('program-*.log')))}.log"
    own = {"HOME": str(folder), "TMPDIR": str(folder), "OMP_NUM_THREADS": "1"}
    with log.open("wb") as output, (errors or log).open("ab") as complaints:
        started = time.monotonic()
        process = subprocess.Popen(
            command,
            cwd=folder,
            env={**os.environ, **own, **(extra or {})},
            stdin=stdin,
            bufsize=0,
            stdout=output,
            stderr=complaints if errors else subprocess.STDOUT,
        )
    return Process(process, log, started, errors)


def await_end(program: Process, folder: Path) -> str | None:
    """Wait until a program ends; None, or the reason if it was stopped for too much output."""
    ended = False
    while not ended:
        with contextlib.suppress(subprocess.TimeoutExpired):
            program.process.wait(POLL)
            ended = True
        if sum(size for _, size in sizes(folder)) > LARGEST_LOG:
            stop(program)
            return (
                f"the program was stopped because it wrote more than {LARGEST_LOG / 1e6:g} MB of "
                f"output; {last_lines(program.errors or program.log, 1)}"
            )
    return None


def sizes(folder: Path) -> Iterator[tuple[Path, int]]:
    """Yield (file, bytes) of all files below a folder; links are not followed."""
    for place, _, names in os.walk(folder):
        for path in (Path(place, name) for name in names):
            with contextlib.suppress(OSError):  # it may have been removed meanwhile
                yield path, path.lstat().st_size


def stop(program: Process, patience: float = 0.0) -> None:
    """Wait `patience` seconds for a program to end by itself, then end it and its children."""
    try:
        program.process.wait(patience)
    except subprocess.TimeoutExpired:
        end_with_descendants(program.process.pid)
        program.process.wait()


def how_it_ended(program: Process, lines: int = 5) -> str:
    """How an ended program ended, with the last lines of its log."""
    code = program.process.returncode
    ending = f"exit code {code}" if code >= 0 else f"signal {name_of_signal(-code)}"
    complains = program.errors is not None and bool(_lines(program.errors))
    return f"{ending}; {last_lines((complains and program.errors) or program.log, lines)}"


def last_lines(log: Path, count: int) -> str:
    """The last non-empty lines of a log, joined, or a phrase that says there are none."""
    kept = _lines(log)[-count:]
    return "last output: " + " | ".join(kept) if kept else "no output"


def last_line(log: Path) -> str:
    """The last non-empty line of a log; empty if there is none."""
    return "".join(_lines(log)[-1:])


def _lines(log: Path) -> list[str]:
    text = _tail(log) if log.is_file() else ""  # the program may have put a pipe in its place
    kept = [line.strip() for line in text.splitlines() if line.strip()]
    return [one if len(one) <= LONGEST else f"{one[:LONGEST]}..." for one in kept]


def _size(log: Path) -> int:
    """The size of a log in bytes; 0 if the program removed it."""
    return log.stat().st_size if log.is_file() else 0


def _tail(log: Path) -> str:
    with log.open("rb") as file:
        file.seek(max(0, log.stat().st_size - TAIL))
        return file.read().decode(errors="replace")


Launch = Callable[[Sequence[int]], Process]
Collect = Callable[[int, Process], Run | None]
Dismiss = Callable[[Process, bool], None]


def end(program: Process, whole: bool) -> None:
    """End a program; if it has answered all its asks, give it a moment to end by itself."""
    stop(program, FAREWELL if whole else 0.0)


def run_batch(
    count: int, launch: Launch, collect: Collect, dismiss: Dismiss = end
) -> Iterator[Run]:
    """Yield one Run per ask 0 .. count - 1, in order, from one program or, if needed, more.

    launch(indices) starts a program that answers those asks in that order; collect(index, program)
    returns an answer, or None while it is incomplete; dismiss(program, whole) ends the program. If
    a program ends early, its finished asks are kept, the ask in progress fails with the reason why
    the program ended, and the rest are rerun, one program each.
    """
    answered = 0
    for run in _answers(range(count), launch, collect, dismiss):
        answered += 1
        yield run
    for index in range(answered, count):
        yield from _answers([index], launch, collect, dismiss)


def _answers(
    indices: Sequence[int], launch: Launch, collect: Collect, dismiss: Dismiss
) -> Iterator[Run]:
    """Yield the answers of one program, and a failure for the ask during which it ended."""
    if not indices:
        return
    try:
        program = launch(indices)
    except OSError as error:
        yield Run(Status.ERROR, f"the program could not be started: {error}")
        return
    whole = False
    try:
        for index in indices:
            run = _awaited(index, program, collect)
            yield run or Run(Status.ERROR, _why_no_answer(program))
            if run is None:
                return
        whole = True
    finally:
        dismiss(program, whole)


def _why_no_answer(program: Process) -> str:
    """Why an ended program gave no answer; only the beginning of an oversized log is kept."""
    how = how_it_ended(program)
    if _size(program.log) <= LARGEST_LOG:
        return f"the program ended early: {how}"
    os.truncate(program.log, TAIL)
    return f"the program was stopped because it wrote over {LARGEST_LOG:g} bytes of output; {how}"


def _awaited(index: int, program: Process, collect: Collect) -> Run | None:
    """The answer to an ask, once it is complete; None if the program ended without it."""
    while True:
        ended = program.process.poll() is not None  # before reading: a last answer counts
        run = collect(index, program)
        if run is not None or ended:
            return run
        if _size(program.log) > LARGEST_LOG:
            stop(program)
            return None
        time.sleep(POLL)
