"""Prints lines: results on standard output; progress, notes and errors on standard error.

Control characters are made harmless and line breaks removed, so that no text can control the
terminal or forge a line.
"""

from __future__ import annotations

import contextlib
import io
import sys
from collections.abc import Callable

from vv.base.files import with_path
from vv.base.printable import one_line

LONGEST = 2000  # characters of an error, which may quote what was typed
USAGE = 64  # the exit status of a usage error, vv.records.finding.Bit.USAGE


def say(*lines: str) -> None:
    """Print lines."""
    with with_path("standard output"):
        for line in lines:
            print(one_line(line), flush=True)


def note(text: str) -> None:
    """Print a line on standard error, so that results on standard output can be piped."""
    print(one_line(text), file=sys.stderr, flush=True)


def captured(speaker: Callable[[], None]) -> tuple[list[str], list[str]]:
    """The notes and lines that a call prints, captured instead of printed."""
    notes, lines = io.StringIO(), io.StringIO()
    with contextlib.redirect_stderr(notes), contextlib.redirect_stdout(lines):
        speaker()
    return notes.getvalue().splitlines(), lines.getvalue().splitlines()


def print_error(text: str, *more: str) -> int:
    """Print an error line, and more below it; return the exit status of a usage error."""
    for line in (f"vv: {text}", *more):
        whole = one_line(line)
        print(whole if len(whole) <= LONGEST else f"{whole[:LONGEST]}...", file=sys.stderr)
    return USAGE
