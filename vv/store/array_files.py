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
DAMAGED = (  # what zipfile and numpy raise for what is no zip file, or of a form that they lack
    zipfile.BadZipFile, zlib.error, tokenize.TokenError, RuntimeError, MemoryError, EOFError,
    TypeError, KeyError,
)  # fmt: skip
FIRST = b"\x93NUMPY\x01\x00"  # of the version that plain arrays are written in
START = len(FIRST) + 2  # where a head of that version begins, behind its length


def arrays_in(content: bytes) -> dict[str, Any]:
    """The arrays by name; raises ValueError for any other file.

    Nothing is unpickled, and nothing unpacked that would not fit in memory.
    """
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as file:
            if sum(one.file_size for one in file.infolist()) > LARGEST:
                raise ValueError("what is packed in it is larger than what is read")
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
    """Shape, order and kind of an array, from its head with the length before it."""
    return np.lib.format.read_array_header_1_0(io.BytesIO(head))
