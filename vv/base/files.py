"""Reads and writes files safely: atomic writes, only regular files read, devices preserved."""

from __future__ import annotations

import contextlib
import errno
import os
import stat
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO

LARGEST = 1 << 30  # bytes that are read: many times what a session keeps, and they fit in memory


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
        if isinstance(error, OSError) and error.errno:  # which names no file, or the temporary one
            raise OSError(error.errno, error.strerror, str(path)) from error
        raise


def read_whole(path: Path) -> bytes:
    """The content of a file that `opened` opens."""
    with opened(path) as file:
        return file.read()


def opened(path: Path) -> BinaryIO:
    """A regular file opened to be read; raises OSError for any other, or one above LARGEST.

    So a pipe to which nobody writes does not block, and an endless device is not read.
    """
    handle = os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC)
    state = os.fstat(handle)
    if stat.S_ISREG(state.st_mode) and state.st_size <= LARGEST:
        return open(handle, "rb")
    os.close(handle)
    if not stat.S_ISREG(state.st_mode):
        raise OSError(errno.EINVAL, "it is not a regular file", str(path))
    raise OSError(errno.EFBIG, f"it has {state.st_size} bytes, more than are read", str(path))


@contextlib.contextmanager
def with_path(place: str) -> Iterator[None]:
    """Add the path to an OSError that has none, such as that of a full disk."""
    try:
        yield
    except OSError as error:
        raise OSError(error.errno, error.strerror, place) from error


def write_output(path: Path, content: bytes) -> None:
    """Write bytes to the place that a user named; `-` is standard output, links are followed.

    A regular file is replaced as a whole; a device or pipe is written to, and never replaced.
    Raises OSError, as `check_output` does.
    """
    check_output(path)
    if str(path) == "-":
        with with_path("standard output"):
            sys.stdout.buffer.write(content)
            sys.stdout.buffer.flush()
    elif path.exists() and not path.is_file():
        with with_path(str(path)), path.open("wb") as file:
            file.write(content)
    else:
        write_whole(path.resolve(), content)


def check_output(path: Path) -> None:
    """Raise the OSError that writing to this path would raise, before any work is done.

    A missing folder is such an error: a mistyped path must not create a folder.
    """
    if str(path) == "-":
        return
    if path.is_dir():
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(path))
    folder = path.resolve().parent
    if not folder.is_dir():
        raise FileNotFoundError(errno.ENOENT, "no such folder", str(folder))
    place = path if path.exists() and not path.is_file() else folder
    if not os.access(place, os.W_OK):
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES), str(path))
