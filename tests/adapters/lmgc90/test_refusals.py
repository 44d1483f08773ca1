"""Claims about what LMGC90 is not asked, and which locks it is given, at the edge of each rule."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from adapters.lmgc90 import _held, refusals
from vv.scene import Vector, Wall, box_geometry, polyhedron_inertia

FLOOR = Wall(np.array([0.0, 0.0, 2.0]), np.array([0.0, 0.0, 1.0]))


def cube(name: str, half: float, centre: Vector | list[float], axes: Vector | None = None) -> Any:
    """A cube of a density of 3 kg/m3."""
    turned = np.eye(3) if axes is None else axes
    vertices, faces = box_geometry(np.array(centre), np.full(3, half), turned)
    mass, inertia = polyhedron_inertia(vertices, faces, 3.0)
    return SimpleNamespace(
        name=name, vertices=vertices, faces=faces, mass=mass, inertia=inertia, load=np.zeros(3),
        spin=np.zeros(3), free_spin=np.ones(3, bool),
    )  # fmt: skip


def scene(*blocks: Any, walls: tuple[Wall, ...] = (), **more: Any) -> Any:
    return SimpleNamespace(blocks=blocks, walls=walls, **more)


@pytest.mark.parametrize(
    ("gap", "touch"), [(0.0, True), (1.8e-9, True), (2.2e-9, False), (-0.1, True), (1.0, False)]
)
def test_blocks_may_touch_within_a_billionth_of_the_larger(gap: float, touch: bool) -> None:
    one = cube("one", 0.5, [0.0, 0.0, 0.0])
    for sign in (1, -1):
        other = cube("other", 1.0, [sign * (1.5 + gap), 0.25, 0.0])
        assert refusals.near(one, other) is touch
        assert refusals.near(other, one) is touch


@pytest.mark.parametrize(
    ("gap", "shared"), [(0.0, True), (1.8e-9, True), (2.2e-9, False), (1.0, False)]
)
def test_blocks_meet_face_to_face_or_not_at_all(gap: float, shared: bool) -> None:
    one, other = cube("one", 0.5, [5.0, 0.0, 0.0]), cube("other", 1.0, [6.5 + gap, 0.25, 0.0])
    assert refusals._share_a_plane(one, other) is shared
    turn = np.array([[0.8, 0.6, 0.0], [-0.6, 0.8, 0.0], [0.0, 0.0, 1.0]])
    leaning = cube("leaning", 0.5, [5.0 - 0.7, 0.0, 0.0], turn)
    reason = refusals._faces(scene(one, leaning))
    assert reason == "blocks 'one' and 'leaning' do not meet face to face at the start"
    assert refusals._faces(scene(one, cube("far", 0.5, [9.0, 0.0, 0.0], turn))) is None


@pytest.mark.parametrize(
    ("gap", "stands"),
    [(0.0, True), (0.8e-9, True), (1.2e-9, False), (0.4, False), (0.6, True), (-0.1, False)],
)
def test_a_block_stands_on_a_wall_or_is_half_its_size_above(gap: float, stands: bool) -> None:
    block = cube("b", 0.5, [0.0, 0.0, 2.5 + gap])
    reason = refusals._on_wall(block, FLOOR)
    assert (reason is None) is stands
    assert stands or reason == "block 'b' does not stand on its wall with a face at the start"
    assert refusals._faces(scene(block, walls=(FLOOR,))) == reason


def test_a_block_on_an_edge_does_not_stand_and_one_alone_meets_nothing() -> None:
    a = math.sqrt(0.5)
    turn = np.array([[a, 0.0, a], [0.0, 1.0, 0.0], [-a, 0.0, a]])
    edge = cube("b", 0.5, [0.0, 0.0, 2.0 + a], turn)
    assert "does not stand" in (refusals._on_wall(edge, FLOOR) or "")
    alone = cube("b", 0.5, [0.0, 0.0, 0.0])
    assert refusals._faces(scene(alone)) == "a single block without a wall has no contact"
    assert refusals._faces(scene(alone, cube("c", 0.5, [5.0, 0.0, 0.0]))) is None


def test_the_density_is_that_of_the_first_block() -> None:
    large, small = cube("large", 1.0, [0.0, 0.0, 0.0]), cube("small", 0.5, [9.0, 0.0, 0.0])
    small.mass *= 2.0
    assert refusals.density(scene(large, small)) == pytest.approx(3.0)
    assert refusals.density(scene(small, large)) == pytest.approx(6.0)


def test_masses_and_inertias_are_those_of_one_density_to_a_billionth() -> None:
    first, second = cube("first", 0.5, [0.0, 0.0, 0.0]), cube("second", 1.0, [5.0, 0.0, 0.0])
    assert refusals.density(scene(first, second)) == pytest.approx(3.0)
    for off, refused in ((0.8e-9, False), (1.2e-9, True), (-1.2e-9, True)):
        heavy = SimpleNamespace(**{**vars(second), "mass": second.mass * (1 + off)})
        reason = refusals._densities(scene(first, heavy)) or ""
        assert ("'second' has another density" in reason) is refused
        stiff = SimpleNamespace(**{**vars(second), "inertia": second.inertia * (1 + off)})
        reason = refusals._densities(scene(first, stiff)) or ""
        assert ("'second' has an inertia" in reason) is refused
        stiff.free_spin = np.zeros(3, bool)
        assert refusals._densities(scene(first, stiff)) is None


@pytest.mark.shows("Its adapter omits such locks where nothing pushes in their direction")
def test_locks_matter_where_weight_loads_or_drives_push_and_in_piles() -> None:
    block = cube("b", 0.5, [0.0, 0.0, 2.5])
    block.mass = 4.0
    drive = SimpleNamespace(sines=lambda: [(np.array([0.5, 0.0, 0.0]), 1.0, 0.0)])
    still = {"gravity": np.array([0.0, 0.0, -10.0]), "axes": np.eye(3), "wave": None}
    assert _held(scene(block, walls=(FLOOR,), **still)) == [False, False, True]
    assert _held(scene(block, walls=(FLOOR,), **still | {"wave": drive})) == [True, False, True]
    moving: Any = SimpleNamespace(motion=drive)
    assert _held(scene(block, walls=(moving,), **still)) == [True, False, True]
    for push, held in ((1.2e-11, True), (0.8e-11, False)):  # a part 1e-12 of the weight
        block.load = np.array([0.0, -4.0 * push, 0.0])
        assert _held(scene(block, walls=(FLOOR,), **still)) == [False, held, True]
    turned = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    assert _held(scene(block, walls=(FLOOR,), **still | {"axes": turned})) == [True, False, False]
    pile = scene(block, cube("c", 0.5, [0.0, 0.0, 3.5]), walls=(FLOOR,), **still)
    assert _held(pile) == [True] * 3
    apart = scene(block, cube("c", 0.5, [0.0, 9.0, 2.5]), walls=(FLOOR,), **still)
    assert _held(apart) == [False, False, True]
