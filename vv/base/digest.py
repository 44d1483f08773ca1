"""SHA-256 digests of frozen data: equal data has an equal digest on every machine."""

import dataclasses
import enum
import hashlib
import itertools
from collections.abc import Mapping
from typing import Any

import numpy as np

PLAIN_TYPES = frozenset({bool, int, float, str, type(None)})


def digest(*values: Any) -> str:
    """SHA-256, as 64 hexadecimal digits, of frozen data.

    Accepts dataclasses, arrays, mappings, frozen sets, tuples, lists, enumeration members and
    plain scalars. Names of dataclasses, of their fields and of enumeration members are part of
    the digest. Raises TypeError for a value of any other type.
    """
    chunks: list[bytes] = []
    for value in values:
        _append_chunks(value, chunks)
    sizes = (len(chunk).to_bytes(8, "little") for chunk in chunks)
    whole = itertools.chain.from_iterable(zip(sizes, chunks, strict=True))
    return hashlib.sha256(b"".join(whole)).hexdigest()


def _append_chunks(value: Any, chunks: list[bytes]) -> None:
    """Append the bytes that identify a value; plain scalars, the most common, are tried first."""
    if type(value) in PLAIN_TYPES:
        chunks.append(f"{type(value).__name__}:{value!r}".encode())
    elif isinstance(value, enum.Enum):
        chunks.append(f"{type(value).__name__}.{value.name}".encode())
    elif dataclasses.is_dataclass(value) and not isinstance(value, type):
        chunks.append(type(value).__name__.encode())
        for field in dataclasses.fields(value):
            chunks.append(field.name.encode())
            _append_chunks(getattr(value, field.name), chunks)
    elif isinstance(value, np.ndarray):
        chunks.append(f"array{value.dtype.str}{value.shape}".encode())
        chunks.append(value.tobytes())
    elif isinstance(value, Mapping):
        chunks.append(f"map{len(value)}".encode())
        for key in sorted(value, key=str):
            _append_chunks(key, chunks)
            _append_chunks(value[key], chunks)
    elif isinstance(value, frozenset):
        chunks.append(f"set{len(value)}".encode())
        chunks += sorted(digest(member).encode() for member in value)
    elif isinstance(value, tuple | list):
        chunks.append(f"list{len(value)}".encode())
        for member in value:
            _append_chunks(member, chunks)
    elif isinstance(value, bool | int | float | str):
        chunks.append(f"{type(value).__name__}:{value!r}".encode())
    else:
        raise TypeError(f"{type(value).__name__} has no digest; use frozen data")
