"""Chooses a folder for compiled code: the user must own it, and nobody else may write to it."""

from __future__ import annotations

import os
import stat
import tempfile
from collections.abc import Iterator
from pathlib import Path

from vv.base.notices import notice

OTHERS = stat.S_IWGRP | stat.S_IWOTH


def cache_root(name: str) -> Path:
    """The first usable folder of that name, created for its owner alone if necessary.

    It is in VV_CACHE, in `vv` of the user's cache, or in the user's own temporary folder; never
    with results, which are shared. A folder that others own or may write to is skipped with a
    notice on standard error. Raises OSError if none is usable.
    """
    for root in _roots():
        if _is_usable(root) and _is_usable(root / name):
            return root / name
    raise OSError(f"no folder for {name} can be used; set VV_CACHE to one that is yours alone")


def why_not_trusted(folder: Path) -> str:
    """Why others could have written code into a folder; empty if only this user could."""
    state = folder.stat()
    if state.st_uid != os.geteuid():
        return "another user owns it"
    return "others may write to it" if state.st_mode & OTHERS else ""


def _is_usable(folder: Path) -> bool:
    try:
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        why = why_not_trusted(folder)
    except OSError:
        return False
    if why:
        notice(f"{folder} is not used for compiled code: {why}")
    return not why and os.access(folder, os.W_OK)


def _roots() -> Iterator[Path]:
    if chosen := os.environ.get("VV_CACHE"):
        yield Path(chosen)
    yield Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "vv"
    yield Path(tempfile.gettempdir()) / f"vv-{os.geteuid()}"
