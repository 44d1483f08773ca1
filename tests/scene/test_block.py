"""Claims about blocks that check themselves: errors name block, face and rule."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from tests.scenes.other_worlds import rescaled, shifted
from vv.scene import (
    Block,
    Contact,
    Elastic,
    Scene,
    Term,
    Vector,
    box_geometry,
    polyhedron_inertia,
    rotated,
    rotation_about_z,
    with_bodies_reversed,
)
from vv.scene.block import face_normal, volume_and_centroid

Faces = tuple[tuple[int, ...], ...]
FAR = np.array([5.0, -7.0, 9.0])
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


@pytest.mark.parametrize("size", [1e-5, 1.0, 1e5])
def test_a_block_of_any_size_lies_anywhere_and_no_face_of_it_is_warped(size: float) -> None:
    assert made(size * (CUBE + FAR)).centroid() == pytest.approx(size * FAR)
    for off, refused in ((1e-11, False), (1e-7, True)):
        warped = size * CUBE
        warped[7, 2] += off * size
        if refused:
            with pytest.raises(ValueError, match="face 1: its vertices do not lie in one plane"):
                made(warped)
        else:
            assert made(warped).faces


def test_the_normal_of_a_face_is_that_wherever_it_lies() -> None:
    for face, normal in zip(FACES, np.repeat(np.eye(3)[::-1], 2, axis=0), strict=True):
        found = face_normal(CUBE + FAR, face)
        assert np.abs(found) == pytest.approx(normal)


def test_a_block_finds_the_normals_of_its_faces_once() -> None:
    block = made(CUBE)
    assert np.abs(block.normals) == pytest.approx(np.repeat(np.eye(3)[::-1], 2, axis=0))
    assert block.normals is block.normals


def test_a_pyramid_has_its_centroid_at_a_quarter_of_its_height() -> None:
    base = [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]]
    vertices = np.array([*base, [0.0, 0.0, 4.0]])
    faces = ((3, 2, 1, 0), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4))
    volume, centre = volume_and_centroid(vertices, faces)
    assert volume == pytest.approx(16.0 / 3.0)
    assert centre == pytest.approx([0.0, 0.0, 1.0], abs=1e-15)


def test_a_long_box_far_off_weighs_and_turns_as_one() -> None:
    vertices, faces = box_geometry(FAR, np.array([1.0, 0.5, 1.5]), np.eye(3))
    mass, inertia = polyhedron_inertia(vertices, faces, 100.0)
    assert mass == pytest.approx(600.0)
    sides = np.array([2.0, 1.0, 3.0]) ** 2
    assert inertia == pytest.approx(np.diag(mass / 12 * (sides.sum() - sides)), abs=1e-9)


@pytest.mark.parametrize("off", [0.8e-12, 1.2e-12])
def test_an_inertia_is_symmetric_but_for_rounding(off: float) -> None:
    inertia = np.eye(3) + 0.1
    inertia[0, 1] *= 1 + off
    if off < 1e-12:
        assert made(inertia=inertia).mass
    else:
        with pytest.raises(ValueError, match="must be symmetric"):
            made(inertia=inertia)


def test_an_inertia_must_be_positive() -> None:
    with pytest.raises(ValueError, match="block 'odd': inertia must be symmetric and positive"):
        made(inertia=np.diag([1.0, 1.0, -1.0]))


@pytest.mark.parametrize("number", range(6))
def test_one_face_turned_inwards_is_named(number: int) -> None:
    faces = tuple(f[::-1] if i == number else f for i, f in enumerate(FACES))
    with pytest.raises(ValueError, match=f"block 'odd', face {number}: .* clockwise"):
        made(faces=faces)


def test_all_faces_turned_inwards_are_an_error_too() -> None:
    with pytest.raises(ValueError, match="block 'odd', face 0: it points inwards"):
        made(faces=tuple(face[::-1] for face in FACES))


def test_a_face_that_is_missing_is_an_error() -> None:
    with pytest.raises(ValueError, match=r"block 'odd', face \d: the faces do not enclose"):
        made(faces=FACES[1:])


def test_a_dented_block_is_not_convex() -> None:
    vertices, faces = prism([(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)])
    with pytest.raises(
        ValueError, match=r"block 'odd', face \d: vertex \d+ lies outside; not conv"
    ):
        made(vertices, faces)


def test_a_warped_face_is_named() -> None:
    vertices = CUBE.copy()
    vertices[7] += [0.0, 0.0, 0.1]
    with pytest.raises(
        ValueError, match="block 'odd', face 1: its vertices do not lie in one plane"
    ):
        made(vertices)


@pytest.mark.parametrize("young", [0.0, -1.0, np.nan, np.inf])
def test_a_modulus_must_be_positive_and_finite(young: float) -> None:
    with pytest.raises(
        ValueError, match=r"block 'odd': young = .* Pa; it must be positive and fin"
    ):
        made(elastic=Elastic(young, 0.2))


@pytest.mark.parametrize("poisson", [-1.0, 0.5, np.nan])
def test_poissons_ratio_has_its_bounds(poisson: float) -> None:
    with pytest.raises(
        ValueError, match=r"block 'odd': poisson = .*; -1 < poisson < 0.5 must hold"
    ):
        made(elastic=Elastic(1e9, poisson))


def alone(**changed: Any) -> Scene:
    return Scene((made(**changed),), Contact(np.inf))


def test_a_block_strains_where_the_scene_says_so_along_what_it_is_free_in() -> None:
    law = Elastic(1e9, 0.2)
    flat = np.array([True, False, True])
    assert made().strains == made(elastic=law, free=np.zeros(3, bool)).strains == ()
    assert made(elastic=law, free=flat).strains == ((0, 0), (0, 2), (2, 2))
    assert Term.STRAIN not in alone().terms()
    assert Term.STRAIN in alone(elastic=law).terms()
    assert alone(elastic=law).unknowns() == alone().unknowns() + 6
    digests = {alone(elastic=e).digest() for e in (None, law, Elastic(2e9, 0.2), Elastic(1e9, 0.1))}
    assert len(digests) == 4


def test_elasticity_goes_with_a_block_that_is_moved_turned_renumbered_or_in_other_units() -> None:
    law = Elastic(3e9, 0.2)
    scene = alone(elastic=law)
    for other in (
        shifted(scene, np.ones(3)),
        rotated(scene, rotation_about_z(0.3)),
        with_bodies_reversed(scene),
    ):
        assert other.blocks[0].elastic == law
    small = rescaled(scene, length=1e-3, time=10.0, mass=1e2).blocks[0].elastic
    assert small is not None
    assert small.young == pytest.approx(3e9 * 1e2 / (1e-3 * 10.0**2))
    assert small.poisson == law.poisson
    assert rescaled(alone(), 1e-3, 10.0, 1e2).blocks[0].elastic is None
