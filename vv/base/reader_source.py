"""Writes functions that make objects of plain data, as `dataclasses` writes those of classes.

Nearly all values of records are plain, and there are a million of them in a report: a function
written for a class tests them where they stand, and calls the reader of a field for others only.
"""

from __future__ import annotations

import dataclasses
import sys
from collections.abc import Callable, Mapping
from typing import Any

Reader = Callable[[Any], Any]
FINITE = f"-{sys.float_info.max!r} <= one <= {sys.float_info.max!r}"
PLAIN: Mapping[Any, str] = {  # type -> the test that a value of it stands; `one` is the value
    str: "type(one := {0}) is str",
    bool: "type(one := {0}) is bool",
    float: f"type(one := {{0}}) is float and {FINITE}",
    float | None: f"(one := {{0}}) is None or type(one) is float and {FINITE}",
}


def class_reader(kind: Any, hints: Mapping[str, Any], readers: Mapping[str, Reader]) -> Reader:
    """What makes an object of a class of its fields by name; raises KeyError for other fields."""
    known: dict[str, Any] = {"kind": kind}
    parts = []
    for number, field in enumerate(dataclasses.fields(kind)):
        name = field.name
        part = _read(hints[name], f"data[{name!r}]", f"read{number}")
        known[f"read{number}"] = readers[name]
        if field.default is not dataclasses.MISSING:
            known[f"default{number}"] = field.default
            part = f"({part}) if {name!r} in data else default{number}"
        elif field.default_factory is not dataclasses.MISSING:
            known[f"default{number}"] = field.default_factory
            part = f"({part}) if {name!r} in data else default{number}()"
        parts.append(part)
    held = " + ".join(f"({name!r} in data)" for name in hints)
    return _made(f"if len(data) != {held}: raise KeyError", f"kind({', '.join(parts)})", known)


def mapping_reader(key_hint: Any, hint: Any, read_key: Reader, read: Reader) -> Reader:
    """What makes a dictionary of the entries of an object."""
    pair = f"({_read(key_hint, 'key', 'read_key')}): {_read(hint, 'part', 'read')}"
    text = f"{{{pair} for key, part in data.items()}}"
    return _made("", text, {"read_key": read_key, "read": read})


def _read(hint: Any, value: str, reader: str) -> str:
    """The expression that reads a value."""
    test = PLAIN.get(hint)
    return f"one if {test.format(value)} else {reader}(one)" if test else f"{reader}({value})"


def _made(first: str, result: str, known: dict[str, Any]) -> Reader:
    exec(f"def read_whole(data):\n    {first}\n    return {result}\n", known)
    made: Reader = known["read_whole"]
    return made
