"""Writes records as plain data: an object with a member per field, in their order."""

from __future__ import annotations

import dataclasses
import enum
import functools
import typing
from collections.abc import Callable, Hashable, Mapping
from typing import Any

from vv.records.codec.damaged import MISSING
from vv.records.fields import OMITTED, SPREAD

Json = dict[str, Any]  # plain data, used only between records and files
PLAIN = frozenset((str, int, float, bool, type(None)))


def to_data(value: Any) -> Any:
    """Records, or a container of records, as plain data."""
    kind = type(value)
    return value if kind in PLAIN else _writer(typing.cast(Hashable, kind))(value)


def names(kind: type) -> tuple[str, ...]:
    """The names of the fields of a class, in the order in which they are written."""
    return tuple(name for name, _, _ in _written(kind))


def word(member: enum.Enum) -> str:
    """The name of a member of an enum, as records write it."""
    return words(type(member))[member]


@functools.cache
def _writer(kind: Any) -> Callable[[Any], Any]:
    """The function that converts a value of a type to plain data."""
    if dataclasses.is_dataclass(kind):
        return _object_of(kind)
    if issubclass(kind, Mapping):
        return _members
    if issubclass(kind, tuple | list):
        return lambda value: [one if type(one) in PLAIN else to_data(one) for one in value]
    if issubclass(kind, enum.IntFlag):
        return int
    if issubclass(kind, enum.Enum) and not issubclass(kind, int | str):
        return words(kind).__getitem__
    return lambda value: value  # numpy scalars are converted to floats


def _object_of(kind: Any) -> Callable[[Any], Json]:
    written = _written(kind)

    def write(value: Any) -> Json:
        data: Json = {}
        for name, default, is_spread in written:
            part = getattr(value, name)
            if is_spread:
                data.update(to_data(part))
            elif default is MISSING or part != default:
                data[name] = part if type(part) in PLAIN else to_data(part)
        return data

    return write


def _members(value: Mapping[Any, Any]) -> Json:
    return {
        word(key) if isinstance(key, enum.Enum) else key: one
        if type(one) in PLAIN
        else to_data(one)
        for key, one in value.items()
    }


@functools.cache
def words(kind: Any) -> dict[enum.Enum, str]:
    """The names of all members of an enum, as records write them."""
    return {member: member.name.lower().replace("_", "-") for member in kind}


@functools.cache
def _written(kind: Any) -> tuple[tuple[str, Any, bool], ...]:
    """(name, default at which it is omitted, whether its entries replace it) of each field."""
    return tuple(
        (f.name, f.default if OMITTED in f.metadata else MISSING, SPREAD in f.metadata)
        for f in dataclasses.fields(kind)
    )
