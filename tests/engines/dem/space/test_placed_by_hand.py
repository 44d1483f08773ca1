"""Claims about how the general model places spheres, walls, cells and bonds: by hand."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
import pytest

from tests.engines.dem.space.test_stiffness_by_hand import (
    ALL,
    BONDS,
    KN,
    KS,
    MASS,
    RADIUS,
    ROUGH,
    SMOOTH,
    UP,
    three,
)
from tests.support.plain import plain
from vv.ask import Displacement, Reaction, Velocity
from vv.engines.dem.bonds.blocks import SCRATCH, WIDE
from vv.engines.dem.contact.law import NO_FRICTION
from vv.engines.dem.space import neighbours
from vv.engines.dem.space.model import space
from vv.engines.dem.space.placed import placed
from vv.engines.dem.terms import bonds as of_bonds
from vv.engines.dem.terms import wall_contacts
from vv.scene import Contact, Harmonic, Scene, Spheres, Vector, Wall


@pytest.mark.parametrize(("spheres", "most"), [(70, 9), (120, 9)])
@pytest.mark.parametrize("corner", [[0.0, 0.0, 0.0], [7.0, -9.0, 30.0]])
def test_cells_are_as_many_as_fit_but_not_many_more_than_spheres(
    corner: Any, spheres: int, most: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """At most twice the cube root of their number, and one, along an axis; arrays begin as any."""
    sort: Any = plain(neighbours.cells)
    monkeypatch.setitem(sort.__globals__, "counts", lambda n: np.full(n, 99))
    place = np.random.default_rng(3).uniform(size=(spheres, 3)) * [3.0, 0.5, 40.0]
    place[0], place[1] = 0.0, [3.0, 0.5, 40.0]
    place += corner
    count, cell, first, following = sort(place, 0.7)
    assert count.tolist() == [4, 1, most]
    low, high = place.min(axis=0), place.max(axis=0)
    due = np.minimum(((place - low) / (high - low) * count).astype(int), count - 1)
    assert (cell.reshape(-1, 3) == due).all()
    assert len(first) == count.prod()
    seen = []
    for k, begun in enumerate(first.tolist()):
        chain, i = [], begun
        while i >= 0:
            chain.append(i)
            i = int(following[i])
        assert chain == sorted(chain)
        assert all((due[j] @ [count[1] * count[2], count[2], 1]) == k for j in chain)
        seen += chain
    assert sorted(seen) == list(range(spheres))


def test_cells_are_as_wide_as_two_of_the_largest_spheres_and_the_skin(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    find: Any = plain(neighbours.near_pairs)
    original, edges = find.__globals__["cells"], []

    def seen(place: Vector, edge: float) -> Any:
        edges.append(edge)
        return original(place, edge)

    monkeypatch.setitem(find.__globals__, "cells", seen)
    near = space(three((0.02, 0.03), SMOOTH, bonds=BONDS)).state.near
    assert near is not None
    find(near, np.zeros((4, 3)))
    assert edges == pytest.approx([2.0 * 0.4 + near.skin])


def test_walls_have_a_row_for_each_sphere_and_those_that_move_rows_of_their_own() -> None:
    """The second sphere is held; walls begin behind the rows of two spheres and of the ground."""
    held = ALL.copy()
    held[1] = False
    spheres = three((0.02, 0.03), ROUGH, held, held).spheres
    wave = Harmonic(np.array([0.1, 0.0, 0.0]), np.ones(3))
    floor = Wall(np.array([0.0, 0.0, -0.5]), UP, wave)
    side = Wall(np.array([-0.7, 9.0, 0.0]), np.array([1.0, 0.0, 0.0]))
    here = placed(Scene((floor, spheres, side), ROUGH))
    found = wall_contacts.listed(here)
    assert found is not None
    rows, normals, gap, radius = found
    place = spheres.position[[0, 2]]
    assert rows.tolist() == [0, 1, 0, 1]
    assert normals == pytest.approx(np.array([UP, UP, [1.0, 0.0, 0.0], [1.0, 0.0, 0.0]]))
    due = [*(place[:, 2] + 0.5 - RADIUS[[0, 2]]), *(place[:, 0] + 0.7 - RADIUS[[0, 2]])]
    assert gap == pytest.approx(due)
    assert radius.tolist() == [0.4, 0.3, 0.4, 0.3]
    moving = wall_contacts.wall_rows(here)
    assert moving is not None
    assert moving[0].tolist() == [3, 3, 4, 4]
    assert moving[1].shape == (4, 3)
    assert wall_contacts.wall_rows(placed(Scene((spheres, side), ROUGH))) is None


@pytest.mark.parametrize("charge", [None, 0.0, 5.0])
@pytest.mark.parametrize("contact", [ROUGH, SMOOTH])
def test_walls_are_charged_where_there_is_friction_to_be_charged(
    contact: Contact, charge: float | None
) -> None:
    spheres = three((0.02, 0.03), contact).spheres.part(slice(0, 1))
    given = None if charge is None else np.array([[charge, 0.0, 0.0]])
    here = placed(Scene((Wall(-UP, UP), spheres), contact), given)
    term = wall_contacts.build(here)
    assert term is not None
    assert len(term.charged) == (1 if contact is ROUGH and charge else 0)
    assert len(term.shear) == (1 if contact is ROUGH else 0)


def test_something_may_touch_where_something_moves_and_is_not_alone() -> None:
    alone = three((0.02, 0.03), SMOOTH).spheres.part(slice(0, 1))
    held = three((0.02, 0.03), SMOOTH, ~ALL, ~ALL).spheres
    wall = Wall(-UP, UP)
    scenes = (
        ((alone,), False), ((alone, wall), True), ((three((0.02, 0.03), SMOOTH).spheres,), True),
        ((held,), False), ((held, wall), False),
    )  # fmt: skip
    for bodies, due in scenes:
        assert placed(Scene(bodies, SMOOTH)).may_touch == due


@pytest.mark.parametrize("mu", [0.0, 0.5])
def test_a_law_that_steps_look_at_has_friction_or_none_of_it(mu: float) -> None:
    spheres = three((0.02, 0.03), SMOOTH).spheres
    for eta_n, due in ((30.0, ((KS, mu) if mu else NO_FRICTION, 0)), (0.0, None)):
        law = placed(Scene((spheres,), Contact(KN, KS, mu, eta_n))).law
        there = (KS, mu) if mu else None
        assert (law.friction, law.at_run_time) == (due or (there, None))


def test_arrays_of_bonds_have_rows_for_what_moves_and_for_the_ground() -> None:
    held = ALL.copy()
    held[0] = False
    term = of_bonds.build(placed(three((0.02, 0.03), SMOOTH, held, held, bonds=BONDS)))
    assert term is not None
    each = term.arrays.pushes, term.arrays.torques, term.arrays.scratch, term.arrays.held
    assert [array.shape for array in each] == [(3, 3), (3, 3), (1, SCRATCH * WIDE), (1, 3)]


LOCKED = np.array([[True, True, False], [False, False, False], [True, True, True]])


def test_the_general_model_has_rows_for_what_moves_and_columns_for_what_is_seen() -> None:
    """Velocities are those along free axes, and steady ones along locked axes."""
    some = three((0.02, 0.03), ROUGH, LOCKED, LOCKED)
    (spheres,) = some.bodies
    assert isinstance(spheres, Spheres)
    speed, spin = np.zeros((3, 3)), np.zeros((3, 3))
    speed[0], speed[2], spin[2] = [1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, 9.0]
    moving = dataclasses.replace(spheres, velocity=speed, spin=spin)
    found = space(dataclasses.replace(some, bodies=(moving,)))
    bodies = found.state.bodies
    assert bodies.velocity == pytest.approx(speed[[0, 2]])
    assert bodies.spin == pytest.approx(spin[[0, 2]])
    assert found.row.tolist() == [0, 2, 1]
    path, energy, watched = found.outputs(5, (2, 0, 1))
    assert path.shape == (5, 3, 12)
    assert (energy.shape, watched.tolist()) == ((5, 12), [1, 0, 2])
    assert found.words.startswith("12 unknowns: 2 moving spheres that turn")
    filled: Vector = np.arange(180.0).reshape(5, 3, 12)
    seen: tuple[tuple[Any, int], ...] = (Displacement(0), 0), (Velocity(0), 3), (Reaction(0), 9)
    for what, first in seen:
        assert (found.observed(filled, 1, 0, what) == filled[:, 1, first : first + 3]).all()
    whole = 0.5 * (MASS @ (speed**2).sum(axis=1) + spheres.inertia @ (spin**2).sum(axis=1))
    table = np.zeros((2, 12))
    table[0] = np.arange(12.0)
    assert found.put_in(table) == pytest.approx(whole + 1.0 + 2.0 + 10.0 + 11.0)


def test_spheres_that_nothing_turns_have_no_spin_and_no_lock_no_force() -> None:
    some = space(three((0.02, 0.03), SMOOTH))
    assert some.state.bodies.spin is None
    assert some.outputs(5, (0,))[0].shape == (5, 1, 6)
    assert some.words.startswith("9 unknowns: 3 moving spheres")
    assert "that turn" not in some.words
    assert not some.observed(np.ones((5, 1, 6)), 0, 0, Reaction(0)).any()
    still = space(three((0.02, 0.03), ROUGH, ALL, ~ALL))
    assert still.state.bodies.spin is None
