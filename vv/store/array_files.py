"""Reads the arrays of npz files quickly, since a report reads thousands of them."""

from __future__ import annotations

import functools
import io
import tokenize
import zipfile
import zlib
from typing import Any

import numpy as np

from vv.base.files import LARGEST

ENDING = ".npy"
DAMAGED = (  # raised by zipfile and numpy for damaged or unsupported files
    zipfile.BadZipFile, zlib.error, tokenize.TokenError, RuntimeError, MemoryError, EOFError,
    TypeError, KeyError,
)  # fmt: skip
FIRST = b"\x93NUMPY\x01\x00"  # a plain array file, version 1.0
START = len(FIRST) + 2  # where its header begins, after the length of the header


def arrays_in(content: bytes) -> dict[str, Any]:
    """The arrays in a file by name; raises ValueError for a file of any other kind.

    Nothing is unpickled, and no array is unpacked that would not fit in memory.
    """
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as file:
            if sum(one.file_size for one in file.infolist()) > LARGEST:
                raise ValueError("its unpacked size exceeds the limit")
            return {name.removesuffix(ENDING): _array(file.read(name)) for name in file.namelist()}
    except DAMAGED as error:
        raise ValueError(f"it holds no arrays: {error}") from error


def _array(data: bytes) -> Any:
    if not data.startswith(FIRST):
        return np.lib.format.read_array(io.BytesIO(data), allow_pickle=False)
    end = START + int.from_bytes(data[len(FIRST) : START], "little")
    shape, columns_first, kind = _described(data[len(FIRST) : end])
    if kind.hasobject or columns_first:
        return np.lib.format.read_array(io.BytesIO(data), allow_pickle=False)
    return np.frombuffer(data, kind, offset=end).reshape(shape).copy()


@functools.lru_cache(maxsize=1024)
def _described(head: bytes) -> tuple[tuple[int, ...], bool, np.dtype[Any]]:
    """The shape, order and type of an array, from its header with the length before it."""
    return np.lib.format.read_array_header_1_0(io.BytesIO(head))
