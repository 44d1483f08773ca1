"""Claims about functions that are written to read classes: what they take, and what they refuse."""

from __future__ import annotations

import math
import typing
from dataclasses import dataclass, field
from typing import Any

import pytest

from vv.records.codec.reader_source import class_reader, mapping_reader


@dataclass(frozen=True)
class Thing:
    name: str
    size: float | None
    sure: bool = True
    parts: list[int] = field(default_factory=list)


def refused(value: Any) -> Any:
    raise ValueError(value)


def read(data: dict[str, Any]) -> Any:
    hints = typing.get_type_hints(Thing)
    readers = {name: list if name == "parts" else refused for name in hints}
    return class_reader(Thing, hints, readers, lambda _: None)(data)


def test_what_is_left_out_has_its_default() -> None:
    first, second = read({"name": "a", "size": None}), read({"name": "a", "size": None})
    assert first == Thing("a", None, True, [])
    assert first.parts is not second.parts
    assert read({"parts": (1,), "sure": False, "size": -0.5, "name": ""}) == Thing(
        "", -0.5, False, [1]
    )


@pytest.mark.parametrize("data", [{"name": "a"}, {"name": "a", "size": 1.0, "weight": 2.0}])
def test_a_field_too_few_or_too_many_is_refused(data: dict[str, Any]) -> None:
    with pytest.raises(KeyError):
        read(data)


@pytest.mark.parametrize(
    "wrong", [{"name": 1}, {"size": math.inf}, {"size": math.nan}, {"size": True}, {"sure": 1}]
)
def test_a_value_of_another_kind_goes_to_the_reader_of_the_field(wrong: dict[str, Any]) -> None:
    with pytest.raises(ValueError, match=r"1|inf|nan|True"):
        read({"name": "a", "size": 1.0, **wrong})


def test_entries_are_read_key_by_key() -> None:
    lengths = mapping_reader(str, int, refused, len, None)
    assert lengths({"a": "12", "b": ""}) == {"a": 2, "b": 0}


def test_a_word_of_a_closed_list_is_looked_up_and_any_other_goes_to_its_reader() -> None:
    lengths = mapping_reader(str, int, refused, len, {"a": 1})
    assert lengths({"a": "12"}) == {1: 2}
    with pytest.raises(ValueError, match="b"):
        lengths({"b": "12"})
