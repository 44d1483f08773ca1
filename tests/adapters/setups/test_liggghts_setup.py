"""Claims about the setup of an ask for LIGGGHTS: what moves, what pulls, what is watched."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
import pytest

from adapters.liggghts.setup import CLUMP, HALF_STEP, PLAIN, Setup, set_up
from tests.scene.test_scene import ALL, TURNED, balls, scene
from tests.scenes.blocks.sliding_blocks import Frame, incline
from tests.support.adapters.small_asks import DT, block_ask
from vv.ask import Ask, Displacement, History, Knobs, Velocity
from vv.scene import Harmonic, Scene, Spheres, Term

HELD, X_ONLY = np.zeros(3, bool), np.array([True, False, False])


def group(*free: Any, load: Any = None, **given: Any) -> Spheres:
    """Balls in a row of which each has freedoms, and if wanted a load, of its own."""
    row = dataclasses.replace(balls(len(free)), free=np.array(free), **given)
    return row if load is None else dataclasses.replace(row, load=np.array(load, float))


def made(one: Scene, scheme: str = PLAIN, *seen: Any) -> Setup:
    return set_up(Ask(one, History(0.1, 0.01), seen or (Displacement(0),), Knobs(DT)), scheme)


def test_a_sphere_that_only_turns_is_integrated_and_one_that_is_held_is_not() -> None:
    turns = np.array([[False] * 3, [False, True, False], [False] * 3])
    one = made(scene(group(HELD, HELD, ALL, free_spin=turns)))
    assert one.turning.tolist() == [False, True, False]
    assert one.moving.tolist() == [False, True, True]


def test_loads_and_locks_are_those_of_spheres_that_move() -> None:
    pulled = [[9.0, 0, 0], [0, 2.0, 0], [0, 2.0, 0], [0, 0, 0]]
    one = made(scene(group(HELD, X_ONLY, ALL, X_ONLY, load=pulled)))
    assert one.loads == {(0.0, 2.0, 0.0): [1, 2]}
    assert one.locks == {(False, True, True): [1, 3]}


def test_shaking_acts_on_the_masses_of_the_scene_where_raised_ones_are_integrated() -> None:
    wave = Harmonic(np.ones(3), np.ones(3))
    unlike = group(ALL, HELD, ALL, mass=np.array([2.0, 3.0, 4.0]))
    for scheme in (PLAIN, HALF_STEP):
        assert made(scene(unlike, eta=0.5, shaking=wave), scheme).shaken == {
            (2.0,): [0],
            (4.0,): [2],
        }
    assert made(scene(unlike)).shaken == {}


def test_half_a_step_of_drag_is_added_to_each_mass_and_no_weight() -> None:
    down = np.array([0.0, -10.0, 0.0])
    pulled = group(ALL, ALL, mass=np.array([2.0, 3.0]), load=[[1.0, 0, 0], [0, 0, 0]])
    raised = made(scene(pulled, eta=0.5, gravity=down), HALF_STEP).scene
    assert raised.spheres.mass == pytest.approx([2.0 + 0.25 * DT, 3.0 + 0.25 * DT], rel=1e-15)
    assert raised.spheres.load == pytest.approx(np.array([[1.0, -20.0, 0.0], [0, -30.0, 0]]))
    assert not raised.gravity.any()
    same = made(scene(pulled, gravity=down), HALF_STEP).scene
    assert same.spheres.mass.tolist() == [2.0, 3.0]
    assert same.gravity.tolist() == down.tolist()


def test_a_load_in_place_of_an_oblique_lock_is_a_term_and_its_sphere_is_watched_once() -> None:
    held = np.array([True, False, True])
    one = scene(balls(free=held, velocity=TURNED[0]), axes=TURNED, gravity=np.array([0.0, -9.0, 0]))
    setup = made(one, PLAIN, Velocity(0))
    assert {Term.OBLIQUE_LOCK, Term.GRAVITY, Term.LOAD} <= setup.terms
    assert Term.LOAD not in one.terms()
    assert setup.watched == ((Velocity(0), 0), (Displacement(0), 0))
    assert made(one).watched == ((Displacement(0), 0),)


@pytest.fixture
def block() -> Setup:
    """A clump of a block that slides down and at first has friction in its corners."""
    return set_up(block_ask(incline(Frame(28.0, turn=0.4), 15.0, v0=0.2)), CLUMP)


def test_a_rigid_body_is_its_centre_its_corners_and_its_points(block: Setup) -> None:
    (clump,), (atoms,) = block.clumps, block.parts
    assert atoms == [0, *range(1, 1 + len(clump.corners) + len(clump.points))]
    places = block.spheres.position[atoms]
    due = [block.released.spheres.position, clump.corners, clump.points]
    assert places == pytest.approx(np.vstack(due))


def test_its_corners_slide_by_their_friction_over_their_stiffness_and_nothing_else_does(
    block: Setup,
) -> None:
    (clump,) = block.clumps
    count, ks = len(clump.corners), block.released.contact.ks / len(clump.corners)
    assert clump.friction.any(axis=1).all()
    assert sorted(block.slides) == [*range(1, 1 + count)]
    for corner, row in enumerate(clump.friction):
        assert block.slides[1 + corner] == pytest.approx(-row / ks, rel=1e-12)


def test_it_has_the_room_of_the_sphere_in_its_place(block: Setup) -> None:
    """Ten radii of the sphere, which reaches from the centre to the wall; corners are small."""
    alone = set_up(block.ask, PLAIN)
    assert block.room.low == pytest.approx(alone.room.low)
    assert block.room.high == pytest.approx(alone.room.high)
    assert block.spheres.radius.max() < 0.1 * alone.spheres.radius.max()
