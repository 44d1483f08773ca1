"""Generates functions that make objects from plain data, as `dataclasses` generates methods.

Nearly all values of records are plain, and a report has a million of them. A function generated for
a class tests plain values inline, and calls the reader of a field only for other values.
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


def class_reader(
    kind: Any,
    hints: Mapping[str, Any],
    readers: Mapping[str, Reader],
    words: Callable[[Any], Mapping[str, Any] | None],
) -> Reader:
    """A function that makes an object of a class from its fields by name; KeyError for others.

    words: for fields with a fixed list of words, the members by word; None for any other type; see
    `_read`.
    """
    known: dict[str, Any] = {"kind": kind}
    parts = []
    for number, field in enumerate(dataclasses.fields(kind)):
        name = field.name
        known[f"read{number}"] = readers[name]
        known[f"words{number}"] = listed = words(hints[name])
        inside = f"words{number}" if listed else None
        part = _read(hints[name], f"data[{name!r}]", f"read{number}", inside)
        if field.default is not dataclasses.MISSING:
            known[f"default{number}"] = field.default
            part = f"({part}) if {name!r} in data else default{number}"
        elif field.default_factory is not dataclasses.MISSING:
            known[f"default{number}"] = field.default_factory
            part = f"({part}) if {name!r} in data else default{number}()"
        parts.append(part)
    held = " + ".join(f"({name!r} in data)" for name in hints)
    return _made(f"if len(data) != {held}: raise KeyError", f"kind({', '.join(parts)})", known)


def mapping_reader(
    key_hint: Any, hint: Any, read_key: Reader, read: Reader, words: Mapping[str, Any] | None
) -> Reader:
    """What makes a dictionary of the entries of an object. words: of the keys; as above."""
    key = _read(key_hint, "key", "read_key", "words" if words else None)
    text = f"{{({key}): {_read(hint, 'part', 'read', None)} for key, part in data.items()}}"
    return _made("", text, {"read_key": read_key, "read": read, "words": words})


def _read(hint: Any, value: str, reader: str, words: str | None) -> str:
    """The expression that reads a value. words: the name of its closed list, if it is of one."""
    if words:  # TypeError for what cannot be a word, for which the reader has an error of its own
        return f"one if (one := {words}.get({value})) is not None else {reader}({value})"
    test = PLAIN.get(hint)
    return f"one if {test.format(value)} else {reader}(one)" if test else f"{reader}({value})"


def _made(first: str, result: str, known: dict[str, Any]) -> Reader:
    exec(f"def read_whole(data):\n    {first}\n    return {result}\n", known)
    made: Reader = known["read_whole"]
    return made
