"""Programs that are started once and then answer several batches of asks.

Such a program reads lines from its standard input. Each line is the path of a file that lists the
paths of asks, one per line, which it answers in that order. It ends at the end of its input.
"""

from __future__ import annotations

import contextlib
import subprocess
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from vv.codes import external
from vv.codes.external import Process


class ReusedProgram:
    """The program of a code: one that waits for asks, or a new one."""

    def __init__(self) -> None:
        self._may_wait = False
        self._waiting: Process | None = None

    @contextlib.contextmanager
    def may_wait(self) -> Iterator[None]:
        """Let the program wait for more asks in this block; the caller ends it afterwards."""
        before, self._may_wait = self._may_wait, True
        try:
            yield
        finally:
            self._may_wait = before

    def ask(
        self,
        command: Sequence[str],
        folder: Path,
        extra: Mapping[str, str],
        asks: Sequence[Path],
    ) -> Process:
        """Send asks to the waiting program, or to one started as by `vv.codes.external.start`."""
        listed = folder / f"asks-{len(list(folder.glob('asks-*.txt')))}.txt"
        listed.write_text("".join(f"{path}\n" for path in asks))
        waiting, self._waiting = self._waiting, None
        if waiting is not None:
            if _told(waiting, listed):
                return waiting
            _end(waiting, False)
        program = external.start(command, folder, extra, stdin=subprocess.PIPE)
        _told(program, listed)  # if it has ended already, its answer will be missing
        return program

    def dismiss(self, program: Process, whole: bool) -> None:
        """Keep a program that has answered its whole list waiting; end any other."""
        if whole and self._may_wait:
            self._waiting = program
            return
        _end(program, whole)


def _told(program: Process, listed: Path) -> bool:
    """Send a list to a program; returns whether the program still ran and could read it."""
    if program.process.poll() is not None or program.process.stdin is None:
        return False
    try:
        program.process.stdin.write(f"{listed}\n".encode())
    except OSError:
        return False
    return True


def _end(program: Process, whole: bool) -> None:
    """Close the input of a program, and make sure that it ends."""
    if program.process.stdin is not None:
        program.process.stdin.close()
    external.end(program, whole)
