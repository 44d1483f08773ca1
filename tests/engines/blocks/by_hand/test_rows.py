"""Claims about rows of contacts: what is written into them, merged and found again."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from vv.engines.blocks.contacts import Contacts, add, empty_contacts, matched, merge_depth
from vv.scene import Vector

pytestmark = pytest.mark.usefixtures("in_python")
SPACE = (0.0, 0.0, 0.0)


def rows_of(points: Any, room: int = 9) -> tuple[Contacts, int]:
    """Rows with these points, of areas 1, 2, 4, ... and keys that descend."""
    rows, count = empty_contacts(room), 0
    for k, point in enumerate(points):
        count = add(
            rows, count, 3 + k, 7 + k, tuple(point), (0.0, 0.6, 0.8), 0.1 * k, 2.0**k, 90 - k
        )
    return rows, count


def test_a_contact_is_written_if_there_is_room_and_counted_even_if_not() -> None:
    rows, count = rows_of(np.arange(12.0).reshape(4, 3), room=3)
    assert count == 4
    assert rows.first.tolist() == [3, 4, 5]
    assert rows.second.tolist() == [7, 8, 9]
    assert rows.point.tolist() == np.arange(9.0).reshape(3, 3).tolist()
    assert rows.normal == pytest.approx(np.tile([0.0, 0.6, 0.8], (3, 1)))
    assert rows.gap == pytest.approx([0.0, 0.1, 0.2])
    assert rows.area.tolist() == [1.0, 2.0, 4.0]
    assert rows.key.tolist() == [90, 89, 88]


DEPTH = np.array([0.6, 0.0, 0.8])
ACROSS = np.array([0.8, 0.0, -0.6])
PLACES = [5.0 * DEPTH, SPACE, ACROSS, 2.0 * DEPTH, ACROSS - 3.0 * DEPTH, 4.0 * ACROSS]


def test_contacts_that_differ_along_the_depth_are_one() -> None:
    """The first row is of another pair; of the others two pairs share a place in the plane."""
    rows, count = rows_of(PLACES)
    assert merge_depth(rows, 1, count, DEPTH, 1e-6) == 4
    assert rows.point[:4] == pytest.approx(np.array([PLACES[k] for k in (0, 1, 2, 5)]))
    assert rows.area[:4].tolist() == [1.0, 2.0 + 8.0, 4.0 + 16.0, 32.0]
    assert rows.key[:4].tolist() == [90, 87, 86, 85]
    assert rows.first[:4].tolist() == [3, 4, 5, 8]
    assert rows.gap[:4] == pytest.approx([0.0, 0.1, 0.2, 0.5])


@pytest.mark.parametrize("depth", [SPACE, DEPTH])
def test_nothing_is_merged_in_space_or_where_rows_are_missing(depth: Vector) -> None:
    rows, count = rows_of(PLACES, room=5 if depth is DEPTH else 9)
    assert merge_depth(rows, 1, count, np.array(depth), 1e-6) == 6
    assert rows.area[:5].tolist() == [1.0, 2.0, 4.0, 8.0, 16.0]


@pytest.mark.parametrize(("part", "left"), [(0.9, 1), (1.1, 2)])
@pytest.mark.parametrize("near", [0.02, 3.0])
def test_contacts_are_merged_up_to_a_distance_in_the_plane(
    part: float, left: int, near: float
) -> None:
    rows, count = rows_of([SPACE, part * near * ACROSS + DEPTH])
    assert merge_depth(rows, 0, count, DEPTH, near) == left


def test_a_row_is_found_by_its_key_among_old_ones() -> None:
    key, old = np.array([7, 3, 9, 5, 1, 8]), np.array([8, 7, 2, 5, 6])
    assert matched(key, 5, old).tolist() == [1, -1, -1, 3, -1]
    assert matched(key, 6, old).tolist() == [1, -1, -1, 3, -1, 0]
    assert matched(key, 6, old[:0]).tolist() == [-1] * 6
