"""Writes files whole or not at all, and delivers what a user asked for where they said."""

from __future__ import annotations

import errno
import os
import sys
import tempfile
from pathlib import Path


def write(path: Path, content: bytes) -> None:
    """Put a whole file in its place in one step."""
    path.parent.mkdir(parents=True, exist_ok=True)
    handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=".part-")
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(content)
        os.chmod(temporary, 0o644)
        os.replace(temporary, path)
    except BaseException:
        Path(temporary).unlink(missing_ok=True)
        raise


def deliver(path: Path, content: bytes) -> None:
    """Write what a user asked for where they said: `-` is standard output, links are followed.

    A regular file is replaced in one step; a device or pipe is written into. Raises OSError,
    also where the folder is missing: a mistyped path must not make one.
    """
    if str(path) == "-":
        sys.stdout.buffer.write(content)
        return
    if path.exists() and not path.is_file():
        with path.open("wb") as file:
            file.write(content)
        return
    target = path.resolve()
    if not target.parent.is_dir():
        raise FileNotFoundError(errno.ENOENT, "no such folder", str(target.parent))
    write(target, content)
