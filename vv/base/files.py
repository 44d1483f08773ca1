"""Writes files atomically, and writes output to the place that a user named."""

from __future__ import annotations

import errno
import os
import sys
import tempfile
from pathlib import Path


def write_whole(path: Path, content: bytes) -> None:
    """Write bytes to a temporary file beside `path` and rename it: no reader sees half a file.

    Makes missing folders. Raises OSError.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=".part-")
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(content)
        os.chmod(temporary, 0o644)
        os.replace(temporary, path)
    except BaseException as error:
        Path(temporary).unlink(missing_ok=True)
        if isinstance(error, OSError) and error.errno and not error.filename:  # as on a full disk
            raise OSError(error.errno, error.strerror, str(path)) from error
        raise


def write_output(path: Path, content: bytes) -> None:
    """Write bytes to the place that a user named; `-` is standard output, links are followed.

    A regular file is replaced as a whole; a device or pipe is written to. Raises OSError, also if
    the folder does not exist: a mistyped path must not create one.
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
    write_whole(target, content)
