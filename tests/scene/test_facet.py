"""Claims about the triangle that stands for a wall where a code needs a facet."""

from __future__ import annotations

import numpy as np
from hypothesis import given

from tests.scenes.random_scenes import directions
from vv.scene import Vector, Wall


@given(directions())
def test_a_facet_lies_in_its_wall_is_equilateral_and_looks_where_the_wall_does(
    normal: Vector,
) -> None:
    corners = Wall(np.zeros(3), normal).facet_corners
    assert np.abs(corners @ normal).max() <= 1e-15
    assert np.abs(np.linalg.norm(corners, axis=1) - 1.0).max() <= 1e-15
    sides = np.diff(corners, axis=0, append=corners[:1])
    assert np.abs(np.linalg.norm(sides, axis=1) - np.sqrt(3.0)).max() <= 1e-14
    assert np.cross(sides[0], sides[1]) @ normal > 0
