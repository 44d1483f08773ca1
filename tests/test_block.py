"""Claims about blocks that check themselves: errors name block, face and rule."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from vv.block import Block, box_geometry, polyhedron_inertia
from vv.scene import Vector

Faces = tuple[tuple[int, ...], ...]
CUBE, FACES = box_geometry(np.zeros(3), np.full(3, 0.5), np.eye(3))


def made(vertices: Vector = CUBE, faces: Faces = FACES, **changed: Any) -> Block:
    """A block of the given shape; mass and inertia are those of a cube unless changed."""
    mass, inertia = polyhedron_inertia(CUBE, FACES, 1000.0)
    free = np.ones(3, bool)
    data = {"mass": mass, "inertia": inertia, "velocity": np.zeros(3), "free": free, **changed}
    return Block("odd", vertices, faces, free_spin=free, **data)


def prism(outline: Any) -> tuple[Vector, Faces]:
    """A prism of height 1 over an outline (k, 2), counter-clockwise."""
    flat, k = np.asarray(outline, float), len(outline)
    vertices = np.vstack([np.column_stack([flat, np.full(k, z)]) for z in (0.0, 1.0)])
    sides = tuple((i, (i + 1) % k, k + (i + 1) % k, k + i) for i in range(k))
    return vertices, (tuple(reversed(range(k))), tuple(range(k, 2 * k)), *sides)


def test_a_cube_weighs_and_turns_as_a_cube() -> None:
    block = made()
    assert block.mass == pytest.approx(1000.0)
    assert block.inertia == pytest.approx(1000.0 / 6 * np.eye(3))
    assert block.centroid() == pytest.approx(np.zeros(3), abs=1e-15)


@pytest.mark.parametrize("mass", [0.0, -1.0, np.nan, np.inf])
def test_a_mass_must_be_positive_and_finite(mass: float) -> None:
    with pytest.raises(ValueError, match=r"block 'odd': mass = .* kg; it must be positive"):
        made(mass=mass)


def test_an_inertia_must_be_positive() -> None:
    with pytest.raises(ValueError, match="block 'odd': inertia must be symmetric and positive"):
        made(inertia=np.diag([1.0, 1.0, -1.0]))


@pytest.mark.parametrize("number", range(6))
def test_one_face_turned_inwards_is_named(number: int) -> None:
    faces = tuple(f[::-1] if i == number else f for i, f in enumerate(FACES))
    with pytest.raises(ValueError, match=f"block 'odd', face {number}: .* turned inwards"):
        made(faces=faces)


def test_all_faces_turned_inwards_are_an_error_too() -> None:
    with pytest.raises(ValueError, match="block 'odd', face 0: it is turned inwards"):
        made(faces=tuple(face[::-1] for face in FACES))


def test_a_face_that_is_missing_is_an_error() -> None:
    with pytest.raises(ValueError, match=r"block 'odd', face \d: the faces do not close round it"):
        made(faces=FACES[1:])


def test_a_dented_block_is_not_convex() -> None:
    vertices, faces = prism([(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)])
    with pytest.raises(ValueError, match=r"block 'odd', face \d: vertex \d+ lies beyond; not conv"):
        made(vertices, faces)


def test_a_warped_face_is_named() -> None:
    vertices = CUBE.copy()
    vertices[7] += [0.0, 0.0, 0.1]
    with pytest.raises(ValueError, match="block 'odd', face 1: its vertices lie in no plane"):
        made(vertices)
