"""Claims about pairs of blocks that are near, and about sorting."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.scenes.blocks.block_scenes import box
from vv.engines.blocks.broad import close_pairs
from vv.engines.blocks.geometry import shapes
from vv.engines.blocks.sorting import ordered
from vv.scene import Block, Vector

pytestmark = pytest.mark.usefixtures("in_python")
MARGIN = 0.02  # m
DIRECTIONS = [sign * axis for axis in np.eye(3) for sign in (1.0, -1.0)]


def near(*blocks: Block, moves: Any = None, margin: float = MARGIN) -> list[tuple[int, int]]:
    """The pairs that are near, all of which move unless told otherwise."""
    n = len(blocks)
    vertex = np.concatenate([block.vertices for block in blocks])
    masks = np.ones(n, bool) if moves is None else np.array(moves, bool)
    return [divmod(int(c), n) for c in close_pairs(shapes(blocks), vertex, masks, margin)]


@pytest.mark.parametrize(("part", "due"), [(-5.0, True), (0.9, True), (1.1, False)])
@pytest.mark.parametrize("direction", DIRECTIONS)
def test_blocks_are_near_if_their_boxes_are_within_the_margin(
    direction: Vector, part: float, due: bool
) -> None:
    """Unlike boxes that overlap along the other two axes, beyond the ends of the larger."""
    halves = np.array([[0.3, 0.4, 0.5], [0.2, 0.1, 0.6]])
    aside = 0.35 * (1.0 - abs(direction))
    at = direction * (halves.sum(0) + part * MARGIN) + aside
    place = np.array([5.0, 6.0, 7.0])
    one, other = box("one", place, halves[0]), box("other", at + place, halves[1])
    third = box("third", [-50.0, 6.0, 7.0], halves[0])
    assert near(one, other, third) == ([(0, 1)] if due else [])
    assert near(third, other, one) == ([(1, 2)] if due else [])


@pytest.mark.parametrize(
    ("moves", "due"), [((1, 1), True), ((1, 0), True), ((0, 1), True), ((0, 0), False)]
)
def test_one_of_a_pair_must_move(moves: tuple[int, int], due: bool) -> None:
    one, other = box("one", [0, 0, 0], [1, 1, 1]), box("other", [1, 1, 1], [1, 1, 1])
    assert bool(near(one, other, moves=moves)) == due


def test_a_block_alone_is_near_none() -> None:
    assert near(box("one", [0, 0, 0], [1, 1, 1])) == []


def test_of_blocks_that_are_all_near_each_pair_is_told_once_in_order() -> None:
    """Of 12 blocks 66 pairs, more than the 48 for which there is room at first."""
    random = np.random.default_rng(4)
    blocks = [box(str(k), random.uniform(-0.1, 0.1, 3), [1, 1, 1]) for k in range(12)]
    assert near(*blocks) == [(a, b) for a in range(12) for b in range(a + 1, 12)]


@settings(max_examples=40)
@given(st.lists(st.integers(0, 9), max_size=20), st.integers(0, 3))
def test_keys_are_sorted_and_equal_ones_stay_in_order(keys: list[int], beyond: int) -> None:
    n = max(len(keys) - beyond, 0)
    due = np.argsort(np.array(keys[:n], float), kind="stable").tolist()
    assert ordered(np.array(keys, float), n).tolist() == due
