"""Claims about the shapes of blocks in PyBullet: a box is known as one, however it lies."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from adapters.pybullet.shapes import LOCKED, own_axes
from vv.scene import Vector, box_geometry, polyhedron_inertia

ANGLES = st.floats(-math.pi, math.pi)
HALF = np.array([0.5, 0.3, 0.2])


def turned(yaw: float, pitch: float) -> Vector:
    (a, b), (c, d) = [(math.cos(x), math.sin(x)) for x in (yaw, pitch)]
    about_z = np.array([[a, -b, 0.0], [b, a, 0.0], [0.0, 0.0, 1.0]])
    about_y = np.array([[c, 0.0, d], [0.0, 1.0, 0.0], [-d, 0.0, c]])
    return np.asarray(about_z @ about_y)


def made(vertices: Vector, inertia: Vector, free_spin: list[bool]) -> dict[str, Vector]:
    block = {"vertices": vertices, "inertia": inertia, "free_spin": free_spin}
    return {name: np.array(value) for name, value in own_axes(block).items()}


@given(ANGLES, ANGLES)
def test_a_box_is_known_however_it_lies(yaw: float, pitch: float) -> None:
    vertices, faces = box_geometry(np.zeros(3), HALF, turned(yaw, pitch))
    shape = made(vertices, polyhedron_inertia(vertices, faces, 1.0)[1], [True] * 3)
    axes = shape["axes"]
    assert sorted(shape["half"]) == pytest.approx(sorted(HALF), rel=1e-9)
    assert np.linalg.det(axes) == pytest.approx(1.0)
    assert np.abs(vertices @ axes.T) == pytest.approx(np.tile(shape["half"], (8, 1)), rel=1e-9)
    moments = (np.square(shape["half"]).sum() - np.square(shape["half"])) / 3
    assert shape["moments"] == pytest.approx(8 * HALF.prod() * moments, rel=1e-9)


def test_a_block_that_is_no_box_is_a_hull_about_its_principal_axes() -> None:
    vertices, faces = box_geometry(np.zeros(3), HALF, turned(0.3, 0.0))
    vertices[0] *= 0.9
    inertia = polyhedron_inertia(vertices, faces, 1.0)[1]
    shape = made(vertices, inertia, [True] * 3)
    assert not len(shape["half"])
    principal = shape["axes"] @ inertia @ shape["axes"].T
    assert principal == pytest.approx(np.diag(shape["moments"]), abs=1e-12)


def test_what_is_locked_cannot_be_turned() -> None:
    vertices, faces = box_geometry(np.zeros(3), HALF, np.eye(3))
    inertia = polyhedron_inertia(vertices, faces, 1.0)[1]
    assert not made(vertices, inertia, [False] * 3)["moments"].any()
    about_y = made(vertices, inertia, [False, True, False])["moments"]
    assert about_y[1] == inertia[1, 1]
    assert about_y[[0, 2]].min() > 0.99 * LOCKED * np.diag(inertia).max()
