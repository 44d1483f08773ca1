"""Reads plain data as records, each field checked.

How a class is read follows from its fields, once for each class.
"""

from __future__ import annotations

import dataclasses
import enum
import functools
import types
import typing
from collections.abc import Hashable, Mapping
from typing import Any, TypeVar

from vv.records.codec.damaged import MISSING, DamagedError, refuse
from vv.records.codec.plain_values import PLAIN_READERS, Reader, number, whole
from vv.records.codec.reader_source import class_reader, mapping_reader
from vv.records.codec.writing import Json, words
from vv.records.fields import SPREAD

Kind = TypeVar("Kind")


def read(kind: type[Kind], data: object, name: str) -> Kind:
    """Plain data as an object of that class; raises DamagedError, which calls it `name`."""
    try:
        found: Kind = _reader(typing.cast(Hashable, kind))(data)
    except DamagedError as error:
        raise error.within(name) from None
    return found


def members(kind: type, data: object) -> Json:
    """Some fields of a class, read from the members of an object; raises DamagedError."""
    readers = _readers(kind)
    if type(data) is not dict:
        refuse(data, "must be an object")
    try:
        return {member: readers[member](one) for member, one in data.items()}
    except (DamagedError, KeyError):
        for member, one in data.items():
            if member not in readers:
                unknown = f"is not a field of {kind.__name__}"
                raise DamagedError(one, unknown, f".{member}") from None
            _inside(f".{member}", readers[member], one)
        raise


@functools.cache
def _readers(kind: Any) -> dict[str, Reader]:
    """The function that reads each field of a class."""
    return {name: _reader(hint) for name, hint in typing.get_type_hints(kind).items()}


@functools.cache
def _reader(kind: Any) -> Reader:
    """The function that reads a value of a type."""
    origin, arguments = typing.get_origin(kind), typing.get_args(kind)
    if origin in (types.UnionType, typing.Union):
        return _or_none(next(one for one in arguments if one is not type(None)))
    if origin is tuple:
        return _items(arguments)
    if origin is not None:
        return _entries(*arguments)
    if dataclasses.is_dataclass(kind):
        return _fields(kind)
    if isinstance(kind, type) and issubclass(kind, enum.Enum):
        return _member_of(kind)
    return PLAIN_READERS[kind]


def _or_none(kind: Any) -> Reader:
    inner = _reader(kind)
    if inner is number:  # the most frequent type
        return lambda data: data if data is None else number(data)
    return lambda data: None if data is None else inner(data)


def _items(kinds: tuple[Any, ...]) -> Reader:
    """The reader of a tuple of any length, tuple[X, ...], or of a given length."""
    readers = tuple(_reader(kind) for kind in kinds if kind is not ...)

    def items(data: Any) -> tuple[Any, ...]:
        if type(data) is not list:
            refuse(data, "must be a list")
        if kinds[-1] is not ... and len(readers) != len(data):
            refuse(data, f"must be a list of {len(readers)}")
        each = readers if kinds[-1] is not ... else readers * len(data)
        try:
            return tuple([reader(one) for reader, one in zip(each, data, strict=True)])
        except DamagedError:
            for place, one in enumerate(data):
                _inside(f"[{place}]", each[place], one)
            raise

    return items


def _entries(key_kind: Any, kind: Any) -> Reader:
    key_reader, inner = _reader(key_kind), _reader(kind)
    build = mapping_reader(key_kind, kind, key_reader, inner, _listed(key_kind))

    def entries(data: Any) -> dict[Any, Any]:
        if type(data) is not dict:
            refuse(data, "must be an object")
        try:
            whole: dict[Any, Any] = build(data)
            return whole
        except DamagedError:
            for key, one in data.items():
                _inside(f".{key}", inner, one)
            raise

    return entries


def _fields(kind: Any) -> Reader:
    """The reader of a class from its fields; other members go to the field that is spread."""
    hints, readers = typing.get_type_hints(kind), _readers(kind)
    spread = next((f.name for f in dataclasses.fields(kind) if SPREAD in f.metadata), None)

    whole = class_reader(kind, hints, readers, _listed)

    def build(data: Any) -> Any:
        try:
            return whole(data)
        except (AttributeError, KeyError, TypeError, ValueError):
            _diagnose(kind, readers, data)
            raise

    def gather(data: Any) -> Any:
        if type(data) is not dict:
            refuse(data, "must be an object")
        own = {name: one for name, one in data.items() if name in readers and name != spread}
        rest = {name: one for name, one in data.items() if name not in own}
        return build({**own, spread: rest})

    return build if spread is None else gather


def _diagnose(kind: Any, readers: Mapping[str, Reader], data: Any) -> None:
    """Raise DamagedError for the field that makes data invalid for a class."""
    if type(data) is not dict:
        refuse(data, "must be an object")
    for field in dataclasses.fields(kind):
        bare = field.default is field.default_factory is dataclasses.MISSING
        if field.name in data:
            _inside(f".{field.name}", readers[field.name], data[field.name])
        elif bare:
            raise DamagedError(MISSING, "is missing", f".{field.name}")
    for name in data.keys() - readers.keys():
        raise DamagedError(data[name], f"is not a field of {kind.__name__}", f".{name}")
    try:
        kind(**{name: readers[name](one) for name, one in data.items()})
    except ValueError as error:
        raise DamagedError(MISSING, str(error)) from error


def _member_of(kind: type[enum.Enum]) -> Reader:
    if issubclass(kind, enum.IntFlag):
        return lambda data: kind(whole(data))
    members = _listed(kind) or {}

    def member(data: Any) -> enum.Enum:
        found = members.get(data) if type(data) is str else None
        return found if found is not None else refuse(data, f"must be of {', '.join(members)}")

    return member


def _listed(kind: Any) -> dict[str, enum.Enum] | None:
    """The members of an enum by the names that records write; None for other types."""
    if not (isinstance(kind, type) and issubclass(kind, enum.Enum)):
        return None
    if issubclass(kind, enum.IntFlag):
        return None
    return {name: member for member, name in words(kind).items()}


def _inside(place: str, inner: Reader, data: Any) -> Any:
    try:
        return inner(data)
    except DamagedError as error:
        raise error.within(place) from None
