"""The fingerprint of a frozen value: equal data gives an equal digest, on every machine."""

import dataclasses
import enum
import hashlib
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np


def digest(*values: Any) -> str:
    """SHA-256, as 64 hexadecimal digits, of frozen data.

    Dataclasses, arrays, mappings, sets, tuples, enumeration members and plain scalars are
    understood. Raises TypeError for anything else: a value without a stable form has no digest.
    """
    sha = hashlib.sha256()
    for value in values:
        for chunk in _chunks(value):
            sha.update(len(chunk).to_bytes(8, "little"))
            sha.update(chunk)
    return sha.hexdigest()


def _chunks(value: Any) -> Iterator[bytes]:
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        yield type(value).__name__.encode()
        for field in dataclasses.fields(value):
            yield field.name.encode()
            yield from _chunks(getattr(value, field.name))
    elif isinstance(value, enum.Enum):
        yield f"{type(value).__name__}.{value.name}".encode()
    elif isinstance(value, np.ndarray):
        yield f"array{value.dtype.str}{value.shape}".encode()
        yield np.ascontiguousarray(value).tobytes()
    elif isinstance(value, Mapping):
        yield f"map{len(value)}".encode()
        for key in sorted(value, key=str):
            yield from _chunks(key)
            yield from _chunks(value[key])
    elif isinstance(value, frozenset):
        yield f"set{len(value)}".encode()
        yield from sorted(digest(member).encode() for member in value)
    elif isinstance(value, tuple | list):
        yield f"list{len(value)}".encode()
        for member in value:
            yield from _chunks(member)
    elif value is None or isinstance(value, bool | int | float | str):
        yield f"{type(value).__name__}:{value!r}".encode()
    else:
        raise TypeError(f"{type(value).__name__} has no digest; use frozen data")
