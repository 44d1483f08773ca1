"""Finds YADE on this machine by looking at files: nothing is started or imported."""

from __future__ import annotations

import functools
import os
import re
from collections.abc import Iterator
from pathlib import Path

from vv.codes import Found

PYTHON = Path("/usr/bin/python3")  # distributions build YADE for their own Python
PLACES = ("lib/*/yade-double/py", "lib/*/yadedaily/py", "lib/*/yade/py", "lib/yade*/py")
HOW = "apt-get install yade (Debian, Ubuntu), or set VV_YADE to the folder that holds yade/"
LIBRARIES = ("../libyade.so", "../libpkg_common.so", "../libpkg_dem.so")
MODULES = ("yade/wrapper.so", "yade/_utils.so", "yade/utils.py")


def find() -> Found:
    """YADE's version, the folder to import it from, and the files that decide its results.

    VV_YADE, if set, names that folder and no other is looked at.
    """
    return _find(os.environ.get("VV_YADE", ""))


@functools.cache  # asked for every job; a search takes some milliseconds
def _find(chosen: str) -> Found:
    for folder in [Path(chosen)] if chosen else _usual():
        if (folder / "yade/wrapper.so").is_file() and PYTHON.is_file():
            inside = [(folder / name).resolve() for name in (*LIBRARIES, *MODULES)]
            files = [PYTHON.resolve(), *inside]
            present = tuple(path for path in files if path.is_file())
            return Found(True, _version(folder), str(folder), HOW, present)
    return Found(False, how_to_install=HOW)


def _usual() -> Iterator[Path]:
    for prefix in (Path("/usr"), Path("/usr/local")):
        for pattern in PLACES:
            yield from sorted(prefix.glob(pattern))


def _version(folder: Path) -> str:
    """The version of YADE in its configuration module; empty if there is none."""
    config = folder / "yade/config.py"
    text = config.read_text(errors="replace") if config.is_file() else ""
    found = re.search(r"^version\s*=\s*['\"]([^'\"]+)", text, re.MULTILINE)
    return found.group(1) if found else ""
