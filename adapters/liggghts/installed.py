"""Finds LIGGGHTS on this machine by looking at files: nothing is started."""

from __future__ import annotations

import functools
import os
import re
import shutil
from pathlib import Path

from vv.codes import Found

HOW = "apt-get install liggghts (Debian, Ubuntu), or set VV_LIGGGHTS to an executable"
PACKAGES = Path("/var/lib/dpkg/status")


def find() -> Found:
    """LIGGGHTS' version, its executable, and the files that decide its results.

    VV_LIGGGHTS, if set, names the executable and no other is looked at.
    """
    return _find(os.environ.get("VV_LIGGGHTS", "liggghts"), os.environ.get("PATH", ""))


@functools.cache  # asked for every job; a search takes some milliseconds
def _find(name: str, path: str) -> Found:
    place = shutil.which(name, path=path)
    if place is None:
        return Found(False, how_to_install=HOW)
    program = Path(place).resolve()
    libraries = _libraries(program)
    return Found(True, _version(program, libraries), place, HOW, (program, *libraries))


def _libraries(program: Path) -> tuple[Path, ...]:
    """The shared libraries of LIGGGHTS, where they lie relative to a program in bin/."""
    beside = program.parent.parent
    patterns = ("lib/liblig*.so*", "lib/*/liblig*.so*")
    return tuple(sorted({p.resolve() for pattern in patterns for p in beside.glob(pattern)}))


def _version(program: Path, libraries: tuple[Path, ...]) -> str:
    """The package's version if the program comes from it, else the version in a library's name."""
    if program == Path("/usr/bin/liggghts") and PACKAGES.is_file():
        text = PACKAGES.read_text(errors="replace")
        found = re.search(r"^Package: liggghts\n(?:.+\n)*?Version: (\S+)", text, re.MULTILINE)
        if found:
            return found.group(1)
    names = [re.search(r"\.so\.(\d+\.\d+\S*)$", library.name) for library in libraries]
    return next((name.group(1) for name in names if name), "")
