"""Claims about walls that rise: into a block that cannot give way they must not."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.scenes.blocks.block_scenes import FREE, box
from tests.scenes.random_scenes import directions, frames, part
from vv.scene import Block, Contact, Harmonic, Mask, Scene, Vector, Wall, rotated
from vv.scene.rising import highest_rise

UP = np.array([0.0, 0.0, 1.0])
HELD, FLAT = np.zeros(3, bool), np.array([True, True, False])
MASKS = st.tuples(*3 * [st.booleans()]).map(np.array)
ROUND = st.lists(part(-3.0, 3.0), min_size=3, max_size=3).map(np.array)


def lifted(motion: Harmonic | None, free: Mask, spins: Mask, gap: float = 0.0,
           kn: float = np.inf) -> Scene:  # fmt: skip
    """A box over a floor that moves."""
    one = box("one", [0.0, 0.0, 0.5 + gap], [0.5] * 3, free=free, free_spin=spins)
    return Scene((Wall(np.zeros(3), UP, motion), one), Contact(kn))


def highest_seen(motion: Harmonic, along: Vector) -> float:
    """The highest rise along a direction over a period that all frequencies share, here 8 s."""
    t = np.linspace(0.0, 8.0, 16001)[:, None]
    parts = motion.amplitude * np.sin(2 * np.pi * motion.frequency * t + motion.phase)
    height = parts @ (motion.axes @ along)
    return float((height - height[0]).max())


def test_the_message_names_wall_block_rise_and_rule() -> None:
    motion = Harmonic(np.array([0.0, 0.0, 0.02]), np.ones(3), np.zeros(3))
    with pytest.raises(ValueError, match=(
        r"wall 0 rises by up to 0\.02 m along its normal, and block 'one', 0\.01 m above it at "
        r"t = 0, is locked along that; rigid contact has no answer"
    )):  # fmt: skip
        lifted(motion, FLAT, HELD, gap=0.01)


def test_a_floor_that_lies_high_rises_from_there() -> None:
    motion = Harmonic(np.array([0.0, 0.0, 0.02]), np.ones(3), np.zeros(3))
    for gap, refused in ((0.01, True), (0.03, False)):
        one = box("one", [0.0, 0.0, 7.5 + gap], [0.5] * 3, free=FLAT, free_spin=HELD)
        bodies = (Wall(7.0 * UP, UP, motion), one)
        if refused:
            with pytest.raises(ValueError, match="cannot give way"):
                Scene(bodies, Contact(np.inf))
        else:
            assert Scene(bodies, Contact(np.inf)).blocks


def test_a_floor_may_rise_as_far_as_the_gap_is_and_into_springs() -> None:
    motion = Harmonic(np.array([0.0, 0.0, 0.02]), np.ones(3), np.zeros(3))
    assert lifted(motion, FLAT, HELD, gap=0.0201).blocks
    assert lifted(motion, FLAT, HELD, gap=0.02).blocks  # but for rounding
    assert lifted(motion, FLAT, HELD, kn=1e6).blocks


@given(st.sampled_from([1.0, 0.5]), ROUND, ROUND, directions(), frames())
def test_a_floor_rises_as_high_as_it_is_seen_to(
    frequency: float, size: Vector, phase: Vector, normal: Vector, axes: Vector
) -> None:
    motion = Harmonic(size, np.full(3, frequency), phase, axes)
    rise = highest_rise(Wall(np.zeros(3), normal, motion))
    assert rise == pytest.approx(highest_seen(motion, normal), abs=1e-5 * (1 + rise))


UNLIKE = [(0.5, 1.0, 2.125), (1.0, 2.0, 1.0), (0.375, 0.625, 1.5)]


@given(st.sampled_from(UNLIKE), ROUND, ROUND, directions())
def test_a_floor_whose_frequencies_are_multiples_of_one_rises_no_higher_than_it_is_seen_to(
    frequencies: tuple[float, ...], size: Vector, phase: Vector, normal: Vector
) -> None:
    motion = Harmonic(size, np.array(frequencies), phase)
    rise = highest_rise(Wall(np.zeros(3), normal, motion))
    assert rise == pytest.approx(highest_seen(motion, normal), abs=1e-5 * (1 + np.abs(size).sum()))


def test_a_floor_whose_tops_never_meet_may_lie_below_what_is_locked() -> None:
    """Sines of 1 and 2 Hz that start together: 0.0176 m at most, and not 0.02."""
    motion = Harmonic(np.full(3, 0.01), np.array([1.0, 2.0, 2.0]), np.zeros(3), np.array([UP, UP,
                      [1.0, 0.0, 0.0]]))  # fmt: skip
    assert lifted(motion, FLAT, HELD, gap=0.0177).blocks
    with pytest.raises(ValueError, match=r"rises by up to 0\.0176"):
        lifted(motion, FLAT, HELD, gap=0.0175)


def test_tops_of_frequencies_that_share_no_multiple_are_taken_to_meet() -> None:
    """As they nearly do in the long run."""
    motion = Harmonic(np.array([0.0, 0.0, 0.01]), np.array([1.0, 1.0, np.sqrt(2.0)]), np.zeros(3))
    both = dataclasses.replace(motion, amplitude=np.array([0.01, 0.0, 0.01]))
    along = np.array([1.0, 0.0, 1.0]) / np.sqrt(2.0)
    assert highest_rise(Wall(np.zeros(3), along, both)) == pytest.approx(0.02 / np.sqrt(2.0))


@given(MASKS, MASKS, directions())
def test_only_what_cannot_give_way_refuses_a_floor_that_rises_in_any_frame(
    free: Mask, spins: Mask, normal: Vector
) -> None:
    motion = Harmonic(np.array([0.3, 0.1, 0.02]), np.full(3, 2.0), np.full(3, -np.pi / 2))
    gives_way = free[2] or spins[0] or spins[1]
    turn = 2 * np.outer(normal, normal) - np.eye(3)  # by half a turn
    still = rotated(lifted(None, free, spins), turn)
    wall = rotated(lifted(motion, FREE, FREE), turn).walls[0]
    bodies: tuple[Wall | Block, ...] = (wall, *still.blocks)
    if gives_way:
        assert dataclasses.replace(still, bodies=bodies).walls[0].motion is not None
    else:
        with pytest.raises(ValueError, match="cannot give way"):
            dataclasses.replace(still, bodies=bodies)


@given(MASKS)
def test_a_floor_that_moves_in_its_plane_may_carry_what_is_locked(spins: Mask) -> None:
    motion = Harmonic(np.array([0.3, 0.1, 0.0]), np.full(3, 2.0), np.zeros(3))
    assert lifted(motion, FLAT, spins).blocks
