"""Claims about blocks on one wall that cannot meet: the bound on their travel, and refusals."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.scenes.blocks.block_scenes import HELD, box, incline, responding
from vv.ask import Ask, Displacement, History, Knobs
from vv.scene import Contact, Harmonic, Scene, Wall
from vv.standins.separation import _travel_bounds, why_not_apart

DURATION = 0.5  # s


def asked(scene: Scene) -> Ask:
    return Ask(scene, History(DURATION, 0.1), (Displacement(1),), Knobs(1e-4, 1e9))


def two(along: int, gap: float, **given_block: Any) -> Scene:
    """Two cubes of 1 m on a slope of 30 degrees without friction, with a gap [m] along an axis."""
    scene = incline(30.0, 1e-6, half=(0.5, 0.5, 0.5), **given_block)
    first = scene.blocks[0]
    shift = (1.0 + gap) * scene.axes[along]
    second = dataclasses.replace(first, name="second", vertices=first.vertices + shift)
    return dataclasses.replace(scene, bodies=(*scene.bodies, second))


@given(st.floats(0.01, 3.0))
def test_blocks_that_slide_side_by_side_never_meet(gap: float) -> None:
    assert why_not_apart(asked(two(1, gap, free_spin=HELD))) is None


@given(st.floats(0.01, 3.0))
def test_blocks_that_slide_in_line_meet_if_one_may_overtake_the_gap(gap: float) -> None:
    """One alone could close the gap; since each may move, twice that gap is required."""
    way = 0.5 * 9.81 * 0.5 * DURATION**2
    reason = why_not_apart(asked(two(0, gap, free_spin=HELD)))
    assert (reason is None) is (gap > 2 * way)
    assert reason is None or "may touch each other" in reason


def test_blocks_that_may_turn_need_room_all_around() -> None:
    assert "may touch" in (why_not_apart(asked(two(1, 1.0))) or "")
    assert why_not_apart(asked(two(1, 20.0))) is None


def test_a_wall_that_shakes_drives_blocks_together() -> None:
    scene = responding((0.05, 0, 0), (2.0, 0.0, 0.0), 0.6, free_spin=HELD)
    for shift, apart in (([1.2, 0, 0], False), ([0, 1.2, 0], True)):
        beside = box("beside", np.array([0.0, 0.0, 0.5]) + shift, [0.5] * 3, free_spin=HELD)
        both = dataclasses.replace(scene, bodies=(*scene.bodies, beside))
        assert (why_not_apart(asked(both)) is None) is apart


def test_towers_nearer_than_they_are_high_are_refused_with_that_reason() -> None:
    scene = incline(0.0, 30.0, half=(0.2, 0.2, 1.0), free_spin=HELD)
    beside = box("beside", [0.0, 0.6, 1.0], [0.2, 0.2, 1.0], free_spin=HELD)
    reason = why_not_apart(asked(dataclasses.replace(scene, bodies=(*scene.bodies, beside))))
    assert reason == (
        "blocks 'block' and 'beside' are too close for spheres with the heights of the "
        "centres as radii"
    )


X, Y, Z = np.eye(3)
DRIVEN = Wall(np.zeros(3), Z, Harmonic(0.05 * X, 2.0 * X))
SHAKEN = Harmonic(2.0 * Y, Y)
PULLS = np.array([3.0 + 0.05 * (4 * np.pi) ** 2, 2.0, 10.0])  # load, wall, shaking, weight
SPEEDS = np.array([0.05 * 4 * np.pi - 0.1, 0.2, 0.0])  # seen from the wall


def bound(**given_block: Any) -> Any:
    """The bound on the travel in half a second of a cube of 1 m and 1000 kg on a moving wall."""
    one = box("one", 0.5 * Z, [0.5] * 3, load=3000.0 * X, velocity=0.1 * X + 0.2 * Y,
              **given_block)  # fmt: skip
    law = Contact(np.inf)
    return _travel_bounds(
        one, DRIVEN, asked(Scene((DRIVEN, one), law, 0.0, -10.0 * Z, shaking=SHAKEN))
    )


def test_a_block_that_cannot_turn_comes_as_far_as_its_speed_and_pulls_take_it() -> None:
    way = SPEEDS * 0.5 + 0.5 * PULLS * 0.25
    free = np.array([True, True, False])
    assert bound(free_spin=HELD) == pytest.approx(way)
    assert bound(free=free, free_spin=HELD) == pytest.approx(way * free)


def test_a_block_that_turns_comes_as_far_anywhere_and_its_corners_farther() -> None:
    """Its inertia is m/6 and its spin has energy too; corners are sqrt(3/4) m from the centroid."""
    start = np.sqrt(SPEEDS @ SPEEDS + 2.0**2 / 6)
    way = start * 0.5 + 0.5 * np.linalg.norm(PULLS) * 0.25
    farthest = way * (1.0 + np.sqrt(0.75) * np.sqrt(6.0))
    assert bound(spin=2.0 * Z) == pytest.approx([farthest] * 3)
