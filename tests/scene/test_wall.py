"""Claims about walls: the triangle that stands for one as a facet, and normals that are turned."""

from __future__ import annotations

import numpy as np
from hypothesis import given

from tests.scenes.random_scenes import directions
from vv.scene import Contact, Scene, Spheres, Vector, Wall, rotated, rotation_about_z


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


@given(directions())
def test_a_wall_that_is_turned_again_and_again_keeps_a_normal_of_unit_length(
    normal: Vector,
) -> None:
    """Each turn starts from unit length, so that roundings of the turns before do not add up."""
    one, still = np.ones(1), np.zeros((1, 3))
    ball = Spheres(2.0 * normal[None], still, one, one, np.ones((1, 3), bool))
    scene = Scene((ball, Wall(np.zeros(3), normal)), Contact(1.0))
    for angle in np.linspace(0.1, 6.0, 60):
        scene = rotated(scene, rotation_about_z(angle))
    assert abs(np.linalg.norm(scene.walls[0].normal) - 1.0) <= 4 * np.finfo(float).eps
