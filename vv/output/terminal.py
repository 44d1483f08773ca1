"""Prints lines: results on standard output, progress, notes and errors on standard error."""

from __future__ import annotations

import sys

USAGE = 64  # the exit status of a usage error, vv.records.finding.Bit.USAGE


def say(text: str) -> None:
    """Print a line."""
    print(text, flush=True)


def note(text: str) -> None:
    """Print a line on standard error, so that results on standard output can be piped."""
    print(text, file=sys.stderr, flush=True)


def complain(text: str) -> int:
    """Print an error line and return the exit status of a usage error."""
    print(f"vv: {text}", file=sys.stderr)
    return USAGE
