"""Claims about the scenes whose only block moves like a point mass, and those beside them."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from tests.scenes.blocks.block_scenes import ACROSS, FREE, HELD, box
from vv.engines.blocks.single_block import ALONG, lone
from vv.scene import Contact, Harmonic, Scene, Wall

AXES = np.array([[0.8, 0.6, 0.0], [-0.6, 0.8, 0.0], [0.0, 0.0, 1.0]])
POINT = np.array([3.0, -2.0, 5.0])
IN_XY = np.array([True, True, False])


def wall_along(normal: Any, motion: Harmonic | None = None) -> Wall:
    """A wall through POINT."""
    return Wall(POINT, np.asarray(normal) / np.linalg.norm(normal), motion)


def slider(**given: Any) -> Any:
    """A box of 0.2 x 0.4 x 0.6 m along AXES, with its middle 2 m from POINT, that cannot turn."""
    data = {"free": FREE, "free_spin": HELD, **given}
    return box("b", POINT + 2.0 * AXES[0], [0.1, 0.2, 0.3], AXES, **data)


def told(*bodies: Any) -> Any:
    """What `lone` finds in a scene along AXES."""
    return lone(Scene(bodies, Contact(np.inf), axes=AXES))


def test_a_block_that_cannot_turn_is_alone_with_its_wall_and_gap() -> None:
    wall, block = wall_along(AXES[0]), slider()
    found = told(wall, block)
    assert (found.block, found.wall) == (block, wall)
    assert found.gap == pytest.approx(1.9)
    assert found.hold == pytest.approx(np.eye(3))
    assert told(block).gap > 1e29


def test_the_projector_is_that_on_the_free_directions() -> None:
    found = told(slider(free=[True, False, True]))
    assert found.hold == pytest.approx(np.eye(3) - np.outer(AXES[1], AXES[1]))


def test_a_block_that_turns_or_has_company_is_not_alone() -> None:
    wall, block = wall_along(AXES[0]), slider()
    assert told(wall, slider(free_spin=ACROSS)) is None
    assert told(wall, slider(spin=[0.0, 0.0, 1e-3])) is None
    assert told(wall, wall_along([0, 0, 1.0]), block) is None
    assert told(block, box("other", [50, 0, 0], [1, 1, 1], free_spin=HELD)) is None
    assert told(wall, block, box("other", [50, 0, 0], [1, 1, 1], free_spin=HELD)) is None


@pytest.mark.parametrize(("part", "alone"), [(0.9, True), (1.1, False), (1e9, False)])
def test_the_normal_and_the_motion_of_the_wall_must_be_in_free_directions(
    part: float, alone: bool
) -> None:
    """Up to rounding; sines of no amplitude do not count, and neither does their length."""
    askew = AXES[0] + part * ALONG * AXES[2]
    block = slider(free=IN_XY)
    assert (told(wall_along(askew), block) is not None) == alone
    for length in (1e-3, 1e3):
        axes = np.array([AXES[2], length * askew, length * AXES[1]])
        moved = Harmonic(np.array([0.0, 0.1, 0.2]), np.ones(3), axes=axes)
        assert (told(wall_along(AXES[1], moved), block) is not None) == alone
        assert told(wall_along(AXES[1], moved), slider()) is not None
    still = Harmonic(np.array([0.0, 0.0, 0.2]), np.ones(3), axes=axes)
    assert told(wall_along(AXES[1], still), block) is not None
