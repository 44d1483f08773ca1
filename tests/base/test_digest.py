"""Claims about digests: what differs has another, what is equal the same, in whatever order."""

from __future__ import annotations

import enum
import itertools
from dataclasses import dataclass, make_dataclass
from typing import Any

import numpy as np
import pytest

from vv.base.digest import digest


class Colour(enum.Enum):
    RED = 1
    BLUE = 2


@dataclass(frozen=True)
class Point:
    x: float
    y: float


class Light(enum.Enum):
    RED = 1


@dataclass(frozen=True)
class Place:
    x: float
    y: float


UNLIKE: tuple[Any, ...] = (
    None, True, 1, 1.0, "1", "", (), (1,), (1, 2), (2, 1), ((1,), 2), (1, (2,)), {}, {"a": 1},
    {"a": 2}, {"b": 1}, {1: "a"}, frozenset(), frozenset({1}), frozenset({1, 2}), Colour.RED,
    Colour.BLUE, Point(1.0, 2.0), Point(2.0, 1.0), Place(1.0, 2.0), np.zeros(2), np.zeros((2, 1)),
    np.zeros(2, int), np.ones(2), -0.0, 0.0, float("inf"), "None", np.array([0.0, -0.0]),
)  # fmt: skip


def test_no_two_values_that_differ_have_one_digest() -> None:
    found = [digest(value) for value in UNLIKE]
    found += [digest(*pair) for pair in itertools.product(UNLIKE[1:9], repeat=2)]
    assert len(set(found)) == len(found)


def test_equal_values_have_one_digest_in_whatever_order_they_were_put_in() -> None:
    assert digest({"a": 1, "b": 2}) == digest({"b": 2, "a": 1})
    assert digest(frozenset(range(50))) == digest(frozenset(reversed(range(50))))
    assert digest(Point(1.0, 2.0), np.arange(3)) == digest(Point(1.0, 2.0), np.arange(3))
    assert digest((1, 2)) == digest([1, 2])
    assert digest(np.float64(0.5)) != digest("0.5")


def test_a_set_has_one_digest_whatever_order_its_members_are_visited_in() -> None:
    """Small numbers are visited by their remainder of the size of the table: 8 before 1."""
    one, other = frozenset([0, 8]), frozenset([8, 0])
    assert [*one] != [*other], "they are visited in another order"
    assert digest(one) == digest(other)


def named(kind: str, field: str) -> object:
    """An instance of a class of that name, whose field of that name is 1."""
    return make_dataclass(kind, [(field, float)], frozen=True)(1.0)


def test_the_names_of_fields_and_of_enumerations_count() -> None:
    assert digest(named("Thing", "mass")) != digest(named("Thing", "radius"))
    assert digest(Colour.RED) != digest(Light.RED)


def test_neighbours_do_not_run_into_each_other() -> None:
    """Each part is preceded by its length: the names Wall and way are not the name Wallway."""
    assert digest(named("Wall", "way")) != digest(named("Wallw", "ay"))


@pytest.mark.parametrize("value", [Point, object(), {1, 2}, print, b"bytes"])
def test_what_is_no_frozen_data_is_refused(value: object) -> None:
    with pytest.raises(TypeError, match="has no digest; use frozen data"):
        digest(value)
