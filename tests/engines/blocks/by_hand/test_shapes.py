"""Claims about the arrays of shapes, the plane of a scene, and where shapes are placed."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from tests.engines.blocks.test_any_blocks import turned
from tests.engines.blocks.test_contacts import tetrahedron
from tests.scenes.blocks.block_scenes import ACROSS, FREE, IN_PLANE, box
from vv.engines.blocks.geometry import IN_PLANE as SINE
from vv.engines.blocks.geometry import Shapes, depth_axis, planes, shapes
from vv.engines.blocks.placement import find_normals, place_rigid
from vv.scene import Block, Contact, Scene, Wall, polyhedron_inertia

pytestmark = pytest.mark.usefixtures("in_python")
TIP = np.array([3.0, 5.0, 7.0])


def house(ridge: float) -> Block:
    """A cube of 2 m with a roof, whose ridge along y is higher than the eaves."""
    corners = [[x, y, z] for z in (-1.0, 1.0) for y in (-1.0, 1.0) for x in (-1.0, 1.0)]
    vertices = np.array([*corners, [0.0, -1.0, 1.0 + ridge], [0.0, 1.0, 1.0 + ridge]])
    faces = (
        (0, 2, 3, 1), (4, 8, 9, 6), (8, 5, 7, 9), (0, 1, 5, 8, 4), (3, 2, 6, 9, 7),
        (0, 4, 6, 2), (1, 3, 7, 5),
    )  # fmt: skip
    mass, inertia = polyhedron_inertia(vertices, faces, 1000.0)
    return Block("house", vertices, faces, mass, inertia, np.zeros(3), FREE, FREE)


def edges_of(form: Shapes, block: int) -> set[tuple[int, ...]]:
    """The edges of a block."""
    return {tuple(row) for row in form.edge[slice(*form.edge_start[block : block + 2])].tolist()}


def test_shapes_lie_one_after_the_other_in_the_order_of_blocks() -> None:
    blocks = (tetrahedron(TIP), box("box", [9.0, 8.0, 7.0], [0.1, 0.3, 0.2]), house(0.5))
    form = shapes(blocks)
    assert form.vertex_start.tolist() == [0, 4, 12, 22]
    assert form.face_start.tolist() == [0, 4, 10, 17]
    assert form.edge_start.tolist() == [0, 6, 18, 33]
    assert form.size == pytest.approx([1.6, 0.6, 2.5])
    start, face = form.vertex_start, 0
    for i, block in enumerate(blocks):
        due = block.vertices - block.centroid()
        assert form.vertex[start[i] : start[i + 1]] == pytest.approx(due)
        joined: dict[frozenset[int], list[int]] = {}
        for corners, normal in zip(block.faces, block.normals, strict=True):
            there = [start[i] + c for c in corners]
            begin, end = form.corner_start[face : face + 2]
            assert form.corner[begin:end].tolist() == there
            assert form.normal[face] == pytest.approx(normal)
            for a, b in zip(there, [*there[1:], there[0]], strict=True):
                joined.setdefault(frozenset({int(a), int(b)}), []).append(face)
            face += 1
        told = edges_of(form, i)
        assert {frozenset(row[:2]): sorted(row[2:]) for row in told} == joined
        assert all(a < b for a, b, *_ in told)


@pytest.mark.parametrize(("lead", "edges"), [(0.0, 14), (0.95e-12, 14), (1.05e-12, 15)])
def test_faces_in_one_plane_have_no_edge_between_them(lead: float, edges: int) -> None:
    """The halves of a roof, whose normals have the cosine 1 - lead."""
    assert len(shapes((house(np.sqrt(lead / 2)),)).edge) == edges


def test_planes_are_those_of_the_walls_in_order() -> None:
    walls = [Wall(10.0 * axis, axis) for axis in np.eye(3)]
    made = planes(Scene((walls[2], box("b", [50, 50, 50], [1, 1, 1]), walls[0]), Contact(np.inf)))
    assert made.point.tolist() == [[0, 0, 10], [10, 0, 0]]
    assert made.normal.tolist() == [[0, 0, 1], [1, 0, 0]]
    assert planes(Scene((box("b", [0, 0, 0], [1, 1, 1]),), Contact(np.inf))).point.shape == (0, 3)


def plane_of(*blocks: Block, axes: Any = None) -> list[float]:
    """The depth of a scene of blocks."""
    scene = Scene(blocks, Contact(np.inf), axes=np.eye(3) if axes is None else axes)
    return [float(x) for x in depth_axis(scene)]


@pytest.mark.parametrize("axis", range(3))
def test_a_scene_is_plane_if_no_block_can_leave_it_and_all_are_prisms(axis: int) -> None:
    across = np.arange(3) == axis
    masks: dict[str, Any] = {"free": ~across, "free_spin": across}
    one = box("one", [0, 0, 0], [1, 2, 3], **masks)
    due, space = across.astype(float).tolist(), [0.0, 0.0, 0.0]
    assert plane_of(one) == due
    for name in ("free", "free_spin"):
        for k in range(3):
            mask = masks[name] | (np.arange(3) == k)
            other = box("other", [9, 9, 9], [1, 1, 1], **{**masks, name: mask})
            assert plane_of(one, other) == (due if (mask == masks[name]).all() else space)
            assert plane_of(other, one) == (due if (mask == masks[name]).all() else space)
    turned_in_plane = np.roll(np.array([[1, 0, 0], [0, 0.8, 0.6], [0, -0.6, 0.8]]), axis, (0, 1))
    assert plane_of(one, box("turned", [9, 9, 9], [1, 1, 1], turned_in_plane, **masks)) == due
    turned_across = np.roll(turned_in_plane, 1, (0, 1))
    assert plane_of(one, box("turned", [9, 9, 9], [1, 1, 1], turned_across, **masks)) == space


@pytest.mark.parametrize(("part", "plane"), [(0.9, True), (1.1, False)])
def test_a_prism_may_be_askew_by_rounding(part: float, plane: bool) -> None:
    tilt = part * SINE
    askew = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, tilt], [0.0, -tilt, 1.0]])
    block = box("askew", [0, 0, 0], [1, 1, 1], askew, free=IN_PLANE, free_spin=ACROSS)
    assert plane_of(block) == ([0.0, 1.0, 0.0] if plane else [0.0, 0.0, 0.0])


def test_the_plane_of_a_turned_scene_is_turned() -> None:
    axes = turned(np.random.default_rng(2))
    block = box("b", [0, 0, 0], [1, 2, 3], axes, free=IN_PLANE, free_spin=ACROSS)
    assert plane_of(block, axes=axes) == axes[1].tolist()


def test_a_shape_is_turned_about_its_centroid_and_carried_there() -> None:
    random = np.random.default_rng(3)
    form = shapes((tetrahedron(TIP), box("box", [9, 8, 7], [0.1, 0.3, 0.2])))
    centre, rotation = random.normal(size=(2, 3)), np.array([turned(random) for _ in range(2)])
    vertex, normal = np.full((12, 3), np.nan), np.full((10, 3), np.nan)
    place_rigid(vertex, normal, form, centre, rotation)
    for i, (begin, end, first, last) in enumerate(((0, 4, 0, 4), (4, 12, 4, 10))):
        due = form.vertex[begin:end] @ rotation[i].T + centre[i]
        assert vertex[begin:end] == pytest.approx(due)
        assert normal[first:last] == pytest.approx(form.normal[first:last] @ rotation[i].T)


@pytest.mark.parametrize("seed", range(3))
def test_normals_of_strained_shapes_are_those_of_their_faces(seed: int) -> None:
    """A uniform strain takes normals by the inverse of its transpose; faces have 3 to 5 sides."""
    random = np.random.default_rng(seed)
    form = shapes((tetrahedron(TIP), house(0.5)))
    strain, shift = np.eye(3) + random.uniform(-0.3, 0.3, (3, 3)), random.uniform(-9, 9, 3)
    normal = np.full((11, 3), np.nan)
    find_normals(normal, form, form.vertex @ strain.T + shift)
    due = form.normal @ np.linalg.inv(strain)
    assert normal == pytest.approx(due / np.linalg.norm(due, axis=1, keepdims=True))


def test_the_normal_of_a_twisted_face_is_that_of_its_diagonals() -> None:
    form = shapes((box("box", [0, 0, 0], [1, 1, 1]),))
    vertex, normal = form.vertex.copy(), np.empty((6, 3))
    vertex[7] += [0.3, 0.2, 0.5]
    find_normals(normal, form, vertex)
    for face, found in enumerate(normal):
        a, b, c, d = vertex[form.corner[4 * face : 4 * face + 4]]
        due = np.cross(c - a, d - b)
        assert found == pytest.approx(due / np.linalg.norm(due))
