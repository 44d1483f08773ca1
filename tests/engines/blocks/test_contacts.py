"""Claims about contact detection between convex blocks and walls."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from tests.scenes.blocks.block_scenes import ACROSS, FLOOR, IN_PLANE, box
from vv.engines.blocks.geometry import depth_axis, planes, shapes
from vv.scene import Block, Contact, Scene, Vector, Wall, polyhedron_inertia

S = np.sqrt(0.5)
ROLLED = np.array([[S, 0.0, S], [0.0, 1.0, 0.0], [-S, 0.0, S]])  # 45 degrees about y
QUARTER = np.array([[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])  # 90 degrees about z


def touching(*bodies: Block | Wall, margin: float = 0.01) -> Any:
    """The contacts of bodies in their initial positions, as arrays of the right length."""
    from vv.engines.blocks.contacts import Contacts, detect_contacts

    scene = Scene(bodies, Contact(np.inf))
    vertex = np.concatenate([block.vertices for block in scene.blocks])
    form, walls = shapes(scene.blocks), planes(scene)
    moves = np.array([bool(b.free.any()) for b in scene.blocks])
    whole, points = np.empty((3, 9), np.int64), np.empty((2, 9, 3))
    contacts = Contacts(
        whole[0], whole[1], points[0], points[1], np.empty(9), np.empty(9), whole[2]
    )
    count = detect_contacts(
        contacts, form, vertex, form.normal.copy(), moves, walls,
        np.zeros_like(walls.point), depth_axis(scene), margin,
    )  # fmt: skip
    assert count <= 9
    cut: Any = [array[:count] for array in contacts]
    return Contacts(*cut)


def tetrahedron(tip: Vector) -> Block:
    """A tetrahedron that stands on its tip, with a horizontal base above."""
    base = np.array([[1.0, 0.0, 1.0], [-0.5, 0.8, 1.0], [-0.5, -0.8, 1.0]])
    vertices = np.vstack([tip, tip + base])
    faces = ((1, 2, 3), (0, 2, 1), (0, 3, 2), (0, 1, 3))
    mass, inertia = polyhedron_inertia(vertices, faces, 1000.0)
    free = np.ones(3, bool)
    return Block("tip", vertices, faces, mass, inertia, np.zeros(3), free, free)


def test_a_face_on_a_face_touches_in_the_corners_of_their_overlap() -> None:
    upper = box("upper", [0.2, 0.3, 1.499], [0.5, 0.5, 0.5])
    found = touching(box("lower", [0.0, 0.0, 0.5], [0.5, 0.5, 0.5]), upper)
    corners = {(-0.3, -0.2), (-0.3, 0.5), (0.5, -0.2), (0.5, 0.5)}
    assert {tuple(np.round(p[:2], 9)) for p in found.point} == corners
    assert found.gap == pytest.approx(np.full(4, -0.001))
    assert found.point[:, 2] == pytest.approx(np.full(4, 0.9995))
    assert found.area.sum() == pytest.approx(0.8 * 0.7)
    assert (found.normal == [0.0, 0.0, 1.0]).all()
    assert len(set(found.key)) == 4


def test_normals_point_from_the_first_block_to_the_second() -> None:
    low, high = (box(n, [0.0, 0.0, z], [0.5, 0.5, 0.5]) for n, z in (("low", 0.5), ("high", 1.5)))
    for blocks, up in (((low, high), 1.0), ((high, low), -1.0)):
        found = touching(*blocks)
        assert (found.first < found.second).all()
        assert found.normal[:, 2] == pytest.approx(np.full(4, up))


def test_an_edge_on_a_face_touches_at_its_ends() -> None:
    half = np.array([0.5, 0.5, 0.5])
    rolled = box("rolled", [0.0, 0.0, 1.0 + np.sqrt(0.5)], half, ROLLED)
    found = touching(box("lower", [0.0, 0.0, 0.5], half), rolled)
    assert sorted(np.round(found.point[:, 1], 9)) == [-0.5, 0.5]
    assert np.abs(found.gap).max() <= 1e-12


def test_a_tip_on_a_face_touches_in_one_point() -> None:
    found = touching(box("lower", [0, 0, 0.5], [1, 1, 0.5]), tetrahedron(np.array([0.1, 0.2, 1.0])))
    assert found.point == pytest.approx(np.array([[0.1, 0.2, 1.0]]))


def test_crossing_edges_touch_in_one_point_between_them() -> None:
    half = np.array([0.5, 0.5, 0.5])
    lower = box("lower", [0.0, 0.0, -S], half, ROLLED)
    turned = box("upper", [0.0, 0.0, S + 0.004], half, ROLLED @ QUARTER)
    found = touching(lower, turned)
    assert len(found.gap) == 1
    assert found.gap[0] == pytest.approx(0.004)
    assert found.point[0] == pytest.approx([0.0, 0.0, 0.002], abs=1e-12)
    assert found.normal[0] == pytest.approx([0.0, 0.0, 1.0], abs=1e-12)
    assert found.area[0] == 0.0


def test_prisms_of_a_plane_scene_touch_in_the_plane() -> None:
    masks: dict[str, Any] = {"free": IN_PLANE, "free_spin": ACROSS}
    lower = box("lower", [0.0, 0.0, 0.5], [0.5, 0.5, 0.5], **masks)
    upper = box("upper", [0.2, 0.0, 1.5], [0.5, 0.5, 0.5], **masks)
    found = touching(FLOOR, lower, upper)
    assert len(found.gap) == 4
    assert sorted(np.round(found.point[:, 0], 9)) == [-0.5, -0.3, 0.5, 0.5]
    assert found.area.sum() == pytest.approx(1.0 + 0.8)


def test_corners_that_only_graze_a_row_of_blocks_make_no_contact() -> None:
    half = [0.5, 0.5, 0.5]
    below = [box(str(x), [x, 0.0, 0.5], half) for x in (0.0, 1.0)]
    found = touching(*below, box("above", [0.0, 0.0, 1.5], half))
    pairs = set(zip(found.first.tolist(), found.second.tolist(), strict=True))
    assert (0, 2) in pairs
    assert (1, 2) not in pairs


def test_held_blocks_touch_only_what_moves() -> None:
    held = {"free": np.zeros(3, bool), "free_spin": np.zeros(3, bool)}
    lower = box("lower", [0.0, 0.0, 0.5], [0.5, 0.5, 0.5], **held)
    beside = box("beside", [1.0, 0.0, 0.5], [0.5, 0.5, 0.5], **held)
    upper = box("upper", [0.0, 0.0, 1.5], [0.4, 0.4, 0.5])
    found = touching(FLOOR, lower, beside, upper)
    assert set(zip(found.first.tolist(), found.second.tolist(), strict=True)) == {(0, 2)}


def test_contacts_that_stay_keep_their_keys() -> None:
    lower = box("lower", [0.0, 0.0, 0.5], [0.5, 0.5, 0.5])
    keys = [
        set(touching(lower, box("upper", [0.2 + x, 0.3, 1.5], [0.5, 0.5, 0.5])).key)
        for x in (0.0, 0.01)
    ]
    assert keys[0] == keys[1]
