"""Claims about how motions of bodies look in a sketch of their scene."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from vv.scene import Block, Contact, Scene, Spheres, Wall, box_geometry
from vv.scene.picture.moved import shifted, turned
from vv.scene.picture.sketch import MOST, sketch

X, Y, Z = np.eye(3)


def row(count: int) -> Scene:
    """A wall, and spheres of radius 1 m side by side along x."""
    place = np.outer(2.0 * np.arange(count), X)
    still = np.zeros((count, 3))
    spheres = Spheres(place, still, np.ones(count), np.ones(count), np.ones((count, 3), bool))
    return Scene((Wall(-Z, Z), spheres), Contact(1e6), gravity=-9.81 * Z)


def cube(x: float) -> Block:
    """A cube of 1 m about a place on the x axis."""
    corners, faces = box_geometry(x * X, 0.5 * np.ones(3), np.eye(3))
    return Block("cube", corners, faces, 1.0, np.eye(3), np.zeros(3), *np.ones((2, 3), bool))


@given(body=st.integers(1, 3), way=st.sampled_from([X, Z, -X, (X + Z) / math.sqrt(2.0)]))
def test_the_circle_of_a_sphere_goes_as_if_the_scene_were_drawn_with_it_there(
    body: int, way: np.ndarray
) -> None:
    scene = row(3)
    moved = shifted(scene, body, way)
    assert moved is not None
    assert moved.circles == (body - 1, 1)
    assert moved.faces == (0, 0)
    assert moved.along == pytest.approx((way @ X, way @ Z), abs=1e-4)


def test_a_motion_along_an_axis_has_no_negative_zero() -> None:
    for way in (X, -X, Z, -Z, X - 1e-9 * Z, Z - 1e-9 * X):
        assert "-0.0" not in str(shifted(row(3), 1, way))


def test_what_goes_towards_the_reader_or_is_not_drawn_does_not_move() -> None:
    assert shifted(row(3), 1, Y) is None
    assert shifted(row(MOST + 1), MOST, X) is not None
    assert shifted(row(MOST + 1), MOST + 1, X) is None


def test_the_faces_of_a_block_are_those_of_the_sketch_after_the_blocks_before() -> None:
    blocks = (cube(0.0), cube(3.0))
    scene = Scene((Wall(-0.5 * Z, Z), *blocks), Contact(1e6), gravity=-9.81 * Z)
    moved = shifted(scene, 2, X)
    assert moved is not None
    start, count = moved.faces
    assert count > 0
    corners = sketch(scene).polygons[start : start + count]
    middle = [x for face in sketch(scene).polygons for x, _ in face]
    assert start + count == len(sketch(scene).polygons)
    assert min(x for face in corners for x, _ in face) > float(np.mean(middle))


@pytest.mark.parametrize(("axis", "sign"), [(Y, -1.0), (-Y, 1.0)])
def test_a_turn_about_the_line_of_sight_is_anticlockwise_where_it_points_at_the_reader(
    axis: np.ndarray, sign: float
) -> None:
    scene = row(3)  # seen from -y: x to the right and z up
    moved = turned(scene, 1, axis, 0.5)
    assert moved is not None
    assert moved.turn == sign * 0.5
    assert turned(scene, 1, X, 0.5) is None
