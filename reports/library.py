"""Reads uPlot, the script with which a reader zooms into charts, from a Python package.

The package youplot has uPlot 1.6.31 as its authors released it (MIT licence), in 50 kB and without
any dependency. Only the files are read: nothing of the package is imported. Without the package,
pages are the same except for the zoom.
"""

from __future__ import annotations

import functools
import importlib.util
from pathlib import Path

PACKAGE = "youplot"
SCRIPT = "uplot.iife.min.js"
STYLE = "uplot.min.css"


def script() -> str:
    """The script, which a page loads when a reader zooms; empty if it is missing."""
    return _read(SCRIPT)


def style() -> str:
    """The style of uPlot, which is part of that of all pages; empty if it is missing."""
    return _read(STYLE)


@functools.cache
def _read(name: str) -> str:
    found = importlib.util.find_spec(PACKAGE)
    if found is None or found.origin is None:
        return ""
    return (Path(found.origin).parent / "vendor" / name).read_text(encoding="utf-8")
