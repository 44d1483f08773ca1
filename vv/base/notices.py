"""Prints notices on standard error, each sentence once."""

from __future__ import annotations

import functools
import sys

from vv.base.printable import one_line


@functools.cache
def notice(text: str) -> None:
    """Print a line on standard error, once per process."""
    print(f"vv: {one_line(text)}", file=sys.stderr, flush=True)
