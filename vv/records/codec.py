"""The one place where records are written as JSON and read again, each field checked.

How a class is read and written follows from its fields, once for each class: an object with a
member per field, in their order; enums as their names in small letters, with hyphens.
"""

from __future__ import annotations

import dataclasses
import enum
import functools
import json
import sys
import types
import typing
from collections.abc import Callable, Hashable, Mapping
from typing import Any, NoReturn, TypeVar

from vv.base.reader_source import class_reader, mapping_reader
from vv.records.fields import OMITTED, SPREAD

Json = dict[str, Any]  # plain data, used only between records and files
Reader = Callable[[Any], Any]
Kind = TypeVar("Kind")
PLAIN = frozenset((str, int, float, bool, type(None)))
MISSING = object()
LARGEST = sys.float_info.max


class DamagedError(ValueError):
    """Data that does not fit its class; names the field, the value and the rule."""

    def __init__(self, value: object, rule: str, place: str = "") -> None:
        super().__init__(value, rule, place)
        self.value, self.rule, self.place = value, rule, place

    def __str__(self) -> str:
        shown = "" if self.value is MISSING else f" = {self.value!r:.60}"
        return f"{self.place.removeprefix('.')}{shown}; {self.rule}"

    def within(self, name: str) -> DamagedError:
        """The same error, with the name of the enclosing object in front."""
        return DamagedError(self.value, self.rule, f"{name}{self.place}")


def parse(text: str) -> Any:
    """Parse JSON to plain data; raises ValueError if it is invalid or a number is not finite.

    For data that is not a record; records are read with `read`.
    """
    try:
        return json.loads(text, parse_constant=_not_finite)
    except RecursionError:
        raise DamagedError(MISSING, "must not be nested so deeply", "JSON") from None


def render(value: object, **style: Any) -> str:
    """Records, or a container of records, as JSON text; style: as for `json.dumps`."""
    return dump(to_data(value), **style)


def dump(data: object, **style: Any) -> str:
    """Plain data as JSON text; style: as for `json.dumps`."""
    return json.dumps(data, allow_nan=False, **style)


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
        _refuse(data, "must be an object")
    try:
        return {member: readers[member](one) for member, one in data.items()}
    except (DamagedError, KeyError):
        for member, one in data.items():
            if member not in readers:
                unknown = f"is not a field of {kind.__name__}"
                raise DamagedError(one, unknown, f".{member}") from None
            _inside(f".{member}", readers[member], one)
        raise


def to_data(value: Any) -> Any:
    """Records, or a container of records, as plain data."""
    kind = type(value)
    return value if kind in PLAIN else _writer(typing.cast(Hashable, kind))(value)


def names(kind: type) -> tuple[str, ...]:
    """The names of the fields of a class, in the order in which they are written."""
    return tuple(name for name, _, _ in _written(kind))


def word(member: enum.Enum) -> str:
    """The name of a member of an enum, as records write it."""
    return _words(type(member))[member]


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
        return _words(kind).__getitem__
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
def _words(kind: Any) -> dict[enum.Enum, str]:
    return {member: member.name.lower().replace("_", "-") for member in kind}


@functools.cache
def _written(kind: Any) -> tuple[tuple[str, Any, bool], ...]:
    """(name, default at which it is omitted, whether its entries replace it) of each field."""
    return tuple(
        (f.name, f.default if OMITTED in f.metadata else MISSING, SPREAD in f.metadata)
        for f in dataclasses.fields(kind)
    )


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
    if inner is _number:  # the most frequent type
        return lambda data: data if data is None else _number(data)
    return lambda data: None if data is None else inner(data)


def _items(kinds: tuple[Any, ...]) -> Reader:
    """The reader of a tuple of any length, tuple[X, ...], or of a given length."""
    readers = tuple(_reader(kind) for kind in kinds if kind is not ...)

    def items(data: Any) -> tuple[Any, ...]:
        if type(data) is not list:
            _refuse(data, "must be a list")
        if kinds[-1] is not ... and len(readers) != len(data):
            _refuse(data, f"must be a list of {len(readers)}")
        each = readers if kinds[-1] is not ... else readers * len(data)
        try:
            return tuple([reader(one) for reader, one in zip(each, data, strict=True)])
        except DamagedError:
            for number, one in enumerate(data):
                _inside(f"[{number}]", each[number], one)
            raise

    return items


def _entries(key_kind: Any, kind: Any) -> Reader:
    key_reader, inner = _reader(key_kind), _reader(kind)
    build = mapping_reader(key_kind, kind, key_reader, inner, _listed(key_kind))

    def entries(data: Any) -> dict[Any, Any]:
        if type(data) is not dict:
            _refuse(data, "must be an object")
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
            _refuse(data, "must be an object")
        own = {name: one for name, one in data.items() if name in readers and name != spread}
        rest = {name: one for name, one in data.items() if name not in own}
        return build({**own, spread: rest})

    return build if spread is None else gather


def _diagnose(kind: Any, readers: Mapping[str, Reader], data: Any) -> None:
    """Raise DamagedError for the field that makes data invalid for a class."""
    if type(data) is not dict:
        _refuse(data, "must be an object")
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
        return lambda data: kind(_whole(data))
    members = _listed(kind) or {}

    def member(data: Any) -> enum.Enum:
        found = members.get(data) if type(data) is str else None
        return found if found is not None else _refuse(data, f"must be of {', '.join(members)}")

    return member


def _listed(kind: Any) -> dict[str, enum.Enum] | None:
    """The members of an enum by the names that records write; None for other types."""
    if not (isinstance(kind, type) and issubclass(kind, enum.Enum)):
        return None
    if issubclass(kind, enum.IntFlag):
        return None
    return {name: member for member, name in _words(kind).items()}


def _inside(place: str, inner: Reader, data: Any) -> Any:
    try:
        return inner(data)
    except DamagedError as error:
        raise error.within(place) from None


def _text(data: Any) -> str:
    return data if type(data) is str else _refuse(data, "must be a text")


def _truth(data: Any) -> bool:
    return data if type(data) is bool else _refuse(data, "must be true or false")


def _whole(data: Any) -> int:
    if type(data) is not int:
        _refuse(data, "must be a whole number")
    number: int = data
    return number if abs(number) < 1 << 63 else _refuse(MISSING, "must be below 2^63")


def _number(data: Any) -> float:
    if type(data) is not float and type(data) is not int:
        _refuse(data, "must be a number")
    if not -LARGEST <= data <= LARGEST:
        _refuse(MISSING, "must be finite")  # such as 1e999, which JSON reads as infinity
    number: float = data
    return number


PLAIN_READERS: Mapping[Any, Reader] = {str: _text, bool: _truth, int: _whole, float: _number}


def _refuse(data: Any, rule: str) -> NoReturn:
    raise DamagedError(data, rule)


def _not_finite(constant: str) -> NoReturn:
    raise DamagedError(constant, "a number must be finite", "JSON")
