"""Claims about blocks that overlap walls or one another at the start, and are refused."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from tests.engines.blocks.by_hand.test_checks import HALF, UP, scene, wall_at
from tests.engines.blocks.test_any_blocks import turned
from tests.engines.blocks.test_contacts import QUARTER, ROLLED, tetrahedron
from tests.scenes.blocks.block_scenes import ACROSS, HELD, IN_PLANE, box
from vv.engines.blocks.checks import OVERLAP, overlaps, size
from vv.scene import Block, Vector, Wall


@pytest.mark.parametrize("metre", [1.0, 1e-3])
@pytest.mark.parametrize(("part", "refused"), [(-5.0, False), (0.9, False), (1.1, True)])
def test_a_block_that_overlaps_a_wall_by_more_than_rounding_is_refused(
    part: float, refused: bool, metre: float
) -> None:
    depth = part * OVERLAP * 0.6 * metre
    point = metre * np.array([3.0, -2.0, 5.0])
    block = box("b", point + (0.3 * metre - depth) * UP, metre * np.array(HALF))
    why = overlaps(scene(wall_at([0, 0, -99.0], UP), Wall(point, UP), block))
    assert (why is not None) == refused
    if why:
        assert why == f"block 'b' overlaps wall 1 by {depth:.4g} m at t = 0"


@pytest.mark.parametrize(("cosine", "refused"), [(0.48, True), (0.52, False), (-0.52, False)])
def test_a_wall_across_the_plane_of_a_plane_scene_may_overlap_blocks(
    cosine: float, refused: bool
) -> None:
    normal = np.array([np.sqrt(1.0 - cosine**2), cosine, 0.0])
    block = box("b", [0, 0, 0], HALF, free=IN_PLANE, free_spin=ACROSS)
    assert (overlaps(scene(Wall(np.zeros(3), normal), block)) is not None) == refused
    assert overlaps(scene(Wall(np.zeros(3), normal), box("b", [0, 0, 0], HALF))) is not None


def test_the_size_of_a_block_is_its_largest_extent() -> None:
    for half in ([0.1, 0.2, 0.3], [0.3, 0.1, 0.2], [0.2, 0.3, 0.1]):
        assert size(box("b", [7.0, -8.0, 9.0], half)) == pytest.approx(0.6)


DIRECTIONS = [sign * axis for axis in np.eye(3) for sign in (1.0, -1.0)]


def beside(direction: Vector, depth: float, **masks: Any) -> str | None:
    """A larger block, then `one`, beside which a smaller lies in a direction, overlapping it."""
    one = box("one", [0, 0, 0], HALF, **masks)
    far = abs(direction) @ (np.array(HALF) + 0.05) - depth
    two = box("two", far * direction, [0.05, 0.05, 0.05], **masks)
    return overlaps(scene(box("large", [-20, 0, 0], [3, 3, 3]), one, two))


@pytest.mark.parametrize("direction", DIRECTIONS)
def test_blocks_that_overlap_by_more_than_rounding_are_refused(direction: Vector) -> None:
    """By 1e-6 of the smaller one's 0.1 m, along a face of the first or of the second."""
    assert beside(direction, -1e-3) is None
    assert beside(direction, 0.9 * OVERLAP * 0.1) is None
    why = beside(direction, 1.1 * OVERLAP * 0.1)
    assert why is not None
    assert why.startswith("blocks 'one' and 'two' overlap by 1.1e-07 m at t = 0, along the normal")
    assert beside(direction, 0.01) is not None
    assert beside(direction, 0.01, free=HELD, free_spin=HELD) is None
    assert beside(direction, 0.01, free=HELD) is not None
    assert beside(direction, 0.01, free_spin=HELD) is not None


def test_one_block_that_can_move_is_enough_for_an_overlap() -> None:
    held = box("held", [0, 0, 0], HALF, free=HELD, free_spin=HELD)
    moves = box("moves", [0, 0, 0.59], HALF)
    for pair in ((held, moves), (moves, held)):
        why = overlaps(scene(*pair))
        assert why is not None
        assert why.startswith(f"blocks '{pair[0].name}' and '{pair[1].name}' overlap by 0.01 m")


@pytest.mark.parametrize("metre", [1.0, 1e-3])
@pytest.mark.parametrize("gap", [0.01, -0.01])
@pytest.mark.parametrize("seed", range(3))
def test_ridges_that_cross_overlap_along_the_normal_of_both(
    seed: int, gap: float, metre: float
) -> None:
    """In any frame, with the first below the second or above it."""
    frame = turned(np.random.default_rng(seed))
    ridges = np.sqrt(0.5) * 0.2 * np.array([-1.0, 1.0]) + [0.0, gap]
    lower, upper = (
        box(name, metre * (z * frame[2] + [3.0, 0.0, 0.0]), metre * np.array([0.1, y, 0.1]), axes)
        for name, z, y, axes in zip(
            ("lower", "upper"), ridges, (0.3, 0.4), (ROLLED @ frame, ROLLED @ QUARTER @ frame),
            strict=True,
        )
    )  # fmt: skip
    for pair in ((lower, upper), (upper, lower)):
        why = overlaps(scene(*pair))
        assert why == (None if gap > 0 else (
            f"blocks '{pair[0].name}' and '{pair[1].name}' overlap by {0.01 * metre:.4g} m at "
            "t = 0, along a pair of edges"
        ))  # fmt: skip


def test_a_tip_in_a_face_overlaps_along_the_normal_of_that_face() -> None:
    """Its depth is the least of 15 directions and more; the tetrahedron is first or second."""
    tip = tetrahedron(np.array([0.1, 0.2, 0.98]))
    lower = box("lower", [0, 0, 0.5], [1, 1, 0.5])
    for pair in ((tip, lower), (lower, tip)):
        why = overlaps(scene(*pair))
        assert why is not None
        assert "overlap by 0.02 m at t = 0, along the normal of face 1 of 'lower'" in why


def test_of_many_blocks_only_those_that_overlap_are_named() -> None:
    """Nine boxes in a row, of which the sixth and the seventh overlap."""
    at = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 5.9, 7.0, 8.0]
    row: list[Block] = [box(str(k), [x, 0, 0], [0.5, 0.5, 0.5]) for k, x in enumerate(at)]
    why = overlaps(scene(*row))
    assert why is not None
    assert why.startswith("blocks '5' and '6' overlap by 0.1 m")
    assert overlaps(scene(*row[:6], *row[7:])) is None
