"""Claims about the setup of an ask for YADE: what touches at the start, what is added, watched."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
import pytest

from adapters.yade.setup import CLUMP, HALF_STEP, PLAIN, Setup, initial_contacts, set_up
from tests.scene.test_scene import ALL, TURNED, X, balls, bonds, scene
from tests.scenes.blocks.sliding_blocks import Frame, incline
from tests.support.adapters.small_asks import DT, block_ask
from vv.ask import Ask, Displacement, History, Knobs, Velocity
from vv.scene import Scene, Spheres, Term, Wall

HELD = np.zeros(3, bool)


def row(*free: Any, gaps: Any = None, **given: Any) -> Spheres:
    """Balls of 0.5 m in a row along x with freedoms of their own; each overlaps by 1e-3 m."""
    own = np.full(len(free) - 1, -1e-3) if gaps is None else np.array(gaps)
    x = np.concatenate([[0.0], np.cumsum(1.0 + own)])
    made = balls(len(free), **given)
    return dataclasses.replace(made, position=np.outer(x, X), free=np.array(free))


def told(one: Scene) -> tuple[list[bool], int]:
    touching, contacts = initial_contacts(one)
    return touching.tolist(), contacts


def made(one: Scene, scheme: str = PLAIN, *seen: Any) -> Setup:
    return set_up(Ask(one, History(0.1, 0.01), seen or (Displacement(0),), Knobs(DT)), scheme)


def test_contacts_are_those_of_which_one_body_moves() -> None:
    assert told(scene(row(ALL, HELD, HELD, ALL))) == ([True, True, True, True], 2)
    assert told(scene(row(HELD, HELD))) == ([False, False], 0)
    turns = np.array([[False] * 3, [True] * 3])
    assert told(scene(dataclasses.replace(row(HELD, HELD), free_spin=turns))) == ([True, True], 1)


def test_an_overlap_of_a_billionth_of_a_radius_is_a_contact_and_rounding_is_none() -> None:
    gaps = [-5e-10, 0.0, 1e-9, -1e-16]
    assert told(scene(row(*[ALL] * 5, gaps=gaps))) == ([True, True, False, False, False], 1)


def test_bonds_are_no_contacts() -> None:
    bonded = scene(row(ALL, ALL, ALL), bonds=bonds((0, 1)))
    assert told(bonded) == ([False, True, True], 1)


def test_each_sphere_that_presses_on_a_wall_is_a_contact_unless_it_is_held() -> None:
    floor = Wall(np.array([0.0, -0.499, 0.0]), np.array([0.0, 1.0, 0.0]))
    side = Wall(np.array([-0.499, 0.0, 0.0]), X)
    apart = row(ALL, HELD, ALL, gaps=[1.0, 1.0])
    assert told(scene(apart, floor)) == ([True, False, True], 2)
    assert told(scene(apart, floor, side)) == ([True, False, True], 3)
    assert told(scene(apart, side)) == ([True, False, False], 1)
    assert told(scene(row(ALL, ALL, ALL, gaps=[1.0, -1e-3]), side)) == ([True, True, True], 2)


def test_half_a_step_of_drag_is_added_in_its_scheme_alone() -> None:
    assert made(scene(eta=0.5), HALF_STEP).extra == pytest.approx(0.25 * DT, rel=1e-15)
    assert made(scene(eta=0.5)).extra == 0.0


def test_a_load_in_place_of_an_oblique_lock_is_a_term_and_its_sphere_is_watched_once() -> None:
    free = np.array([True, False, True])
    one = scene(balls(free=free, velocity=TURNED[0]), axes=TURNED, gravity=np.array([0.0, -9.0, 0]))
    setup = made(one, PLAIN, Velocity(0))
    assert {Term.OBLIQUE_LOCK, Term.GRAVITY, Term.LOAD} <= setup.terms
    assert setup.watched == (Velocity(0), Displacement(0))
    assert made(one).watched == (Displacement(0),)


def test_a_block_is_a_clump_in_its_scheme_alone() -> None:
    ask = block_ask(incline(Frame(28.0), 15.0))
    assert len(set_up(ask, CLUMP).clumps) == 1
    assert set_up(ask, PLAIN).clumps == ()
    assert set_up(ask, PLAIN).terms >= ask.scene.terms()
