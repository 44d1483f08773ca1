"""Claims about scenes of blocks that are refused, and those just beside them that are not."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from tests.scenes.blocks.block_scenes import ACROSS, FREE, HELD, box
from vv.engines.blocks.checks import ACROSS as ROUNDED
from vv.engines.blocks.checks import (
    LOCKED,
    OVERLAP,
    block_index,
    moves_where_locked,
    strained,
    undetermined,
    unsupported,
)
from vv.scene import Contact, Elastic, Scene, Spheres, Vector, Wall

HALF = [0.1, 0.2, 0.3]  # m, of most boxes here, whose size is 0.6 m
FRICTION, SMOOTH = Contact(np.inf, mu=0.3), Contact(np.inf)
UP = np.array([0.0, 0.0, 1.0])
AXES = np.array([[0.8, 0.6, 0.0], [-0.6, 0.8, 0.0], [0.0, 0.0, 1.0]])


def spheres(n: int) -> Spheres:
    """So many spheres, far from the blocks."""
    position = np.arange(50.0, 50.0 + 3 * n).reshape(n, 3)
    still, free = np.zeros((n, 3)), np.ones((n, 3), bool)
    return Spheres(position, still, np.full(n, 0.1), np.ones(n), free)


def wall_at(point: Any, normal: Vector) -> Wall:
    """A wall through a point."""
    return Wall(np.array(point, float), normal)


def scene(*bodies: Any, contact: Contact = SMOOTH, **given: Any) -> Scene:
    """A scene in rigid contact."""
    return Scene(bodies, contact, **given)


def test_a_body_is_found_among_blocks_by_its_number_in_the_scene() -> None:
    wall = Wall(np.zeros(3), UP)
    bodies = (wall, box("a", [0, 0, 9], HALF), spheres(3), box("b", [5, 0, 9], HALF), wall)
    made = scene(*bodies)
    assert [block_index(made, body) for body in (1, 5)] == [0, 1]
    for body in (-1, 0, 2, 3, 4, 6, 7, 8):
        with pytest.raises(ValueError, match=f"^body {body} is no block .*, which has 7 bodies$"):
            block_index(made, body)


def test_the_first_block_that_strains_is_refused_by_name() -> None:
    blocks = [box(n, [k, 0, 0], HALF, elastic=e)
              for k, (n, e) in enumerate((("a", None), ("b", Elastic(1e9, 0.2))))]  # fmt: skip
    assert strained(scene(*blocks)) == "block 'b' is elastic; only rigid blocks are solved"
    assert strained(scene(blocks[0])) is None


@pytest.mark.parametrize("what", ["velocity", "spin"])
def test_a_motion_along_a_locked_axis_is_refused_unless_it_is_rounding(what: str) -> None:
    """The axes are turned by 36.9 degrees; the second is locked, and rounding is part of 250."""
    masks = {"velocity": "free", "spin": "free_spin"}
    locked = np.array([True, False, True])

    def told(second: float, free: Any = locked) -> str | None:
        motion = np.array([250.0, second, -3.0]) @ AXES
        return moves_where_locked(
            scene(
                box("still", [0, 0, 0], HALF, free=HELD, free_spin=HELD),
                box("b", [5, 0, 0], HALF, **{what: motion, masks[what]: free}), axes=AXES,
            )
        )  # fmt: skip

    for sign in (1.0, -1.0):
        assert told(sign * 0.9 * LOCKED * 250.0) is None
        assert told(sign * 1.1 * LOCKED * 250.0) is not None
        assert told(sign * 2.0) == (
            f"block 'b': its {what} has {sign * 2:.6g} along a locked axis; "
            "it must be at rest there"
        )
    assert told(2.0, FREE) is None
    assert told(0.0) is None


def beside_wall(
    tilt: float = 0.0, gap: float = 0.0, contact: Contact = FRICTION, **masks: Any
) -> str | None:
    """A box beside a wall at x = 7 m, whose normal is in the plane of x and y, tilted to y."""
    normal = np.array([1.0, tilt, 0.0])
    normal /= np.linalg.norm(normal)
    other = wall_at([0.0, 0.0, -99.0], UP)
    far = 0.1 * normal[0] + 0.2 * abs(normal[1])
    block = box("b", np.array([7.0, 3.0, 2.0]) + (gap + far) * normal, HALF,
                **{"free": [False, True, True], "free_spin": HELD, **masks})  # fmt: skip
    return undetermined(scene(other, wall_at([7.0, 3.0, 2.0], normal), block, contact=contact))


def test_friction_on_a_wall_along_whose_normal_a_block_is_locked_is_refused() -> None:
    assert beside_wall() == (
        "block 'b' is locked along the normal of wall 1, which it touches with friction: "
        "the normal force of rigid contact is not determined"
    )
    assert beside_wall(contact=SMOOTH) is None
    assert beside_wall(free=FREE) is None
    assert beside_wall(free=HELD) is None
    assert beside_wall(free_spin=ACROSS) is None


@pytest.mark.parametrize(("part", "refused"), [(-1.0, True), (0.9, True), (1.1, False)])
def test_it_is_refused_if_the_block_touches_and_its_free_axes_have_no_part_of_the_normal(
    part: float, refused: bool
) -> None:
    assert (beside_wall(gap=part * OVERLAP * 0.6) is not None) == refused
    assert (beside_wall(tilt=part * ROUNDED) is not None) == refused


def hanging(bodies: tuple[Any, ...], gravity: Any = (0.0, 0.0, 0.0)) -> bool:
    """Whether such a scene is refused for want of a support."""
    why = unsupported(scene(*bodies, gravity=gravity))
    assert why is None or why.startswith("block 'b' has no support: gravity or a load")
    return why is not None


def test_what_falls_or_is_pushed_needs_a_wall_or_a_block_that_is_held() -> None:
    still = box("b", [0, 0, 0], HALF, free=[True, False, False])
    pushed = box("b", [0, 0, 0], HALF, load=[0, 1.0, 0])
    fixed = box("fixed", [5, 0, 0], HALF, free=HELD)
    wall = wall_at([0.0, 0.0, -9.0], UP)
    assert not hanging((still,))
    assert hanging((still,), (0, 0, -1.0))
    assert hanging((pushed,))
    for support in (wall, fixed):
        assert not hanging((support, pushed))
        assert not hanging((support, still), (0, 0, -1.0))
