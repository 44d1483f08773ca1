"""Claims about springs of spheres that are found by a search, beside bonds or not: by hand."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from tests.engines.dem.space.test_stiffness_by_hand import (
    ALL,
    BONDS,
    KN,
    KS,
    MASS,
    ROUGH,
    SMOOTH,
    UP,
    three,
)
from vv.engines.dem.space.model import space
from vv.engines.dem.terms import near_contacts
from vv.engines.dem.terms.near_contacts import NearContacts
from vv.scene import Bonds, Contact, Scene, Spheres, Vector, Wall


def near_of(one: Scene) -> tuple[NearContacts, Any, Any]:
    state = space(one).state
    return state.term(NearContacts), state.near, state.bodies


def test_contacts_beside_bonds_are_those_of_pairs_that_no_bond_joins() -> None:
    """The last two overlap and are bonded, the outer two overlap and are not."""
    some = three((-0.4, -0.35), ROUGH, bonds=BONDS)
    term, near, _ = near_of(some)
    found, closed = near_contacts.springs(term, near)
    assert len(found.kn) == 1
    assert sorted(found.rows[0].tolist()) == [0, 2]
    assert closed.all()


@pytest.mark.parametrize("held", [0, 1, 2])
def test_where_bonds_that_hold_join_all_pairs_no_contact_counts(held: int) -> None:
    """Pairs of spheres that cannot move need no bond; where one may break, contacts may close."""
    free = ALL.copy()
    free[:held] = False
    pairs = np.array([[0, 1], [1, 2], [0, 2]])
    length, k = np.array([0.7, 0.66, 1.4]), np.full(3, 3e4)

    def fastest(many: int, may_break: int = 0) -> float:
        tie = Bonds(pairs[:many], length[:many], k[:many], k[:many])
        term, near, moving = near_of(three((0.02, 0.03), SMOOTH, free, free, bonds=tie))
        frail = near._replace(broken=np.zeros(may_break, np.uint8))
        return near_contacts.highest_square(term, frail, moving)

    assert fastest(3) == 0.0
    due = KN * np.sort(1.0 / MASS[held:])[-2:].sum()
    assert fastest(2) == pytest.approx(due)
    assert fastest(3, may_break=3) == pytest.approx(due)


def many(gap: float, contact: Contact) -> tuple[NearContacts, Any, Any]:
    """Eighty spheres of unlike masses and radii in a row with gaps, so that pairs are searched."""
    radius: Vector = np.linspace(3.0, 3.8, 80)
    mass: Vector = 1.0 + np.arange(80.0) % 7
    away = np.cumsum(np.concatenate([[0.0], radius[:-1] + radius[1:] + gap]))
    free = np.ones((80, 3), bool)
    row = Spheres(
        np.outer(away, UP), np.zeros((80, 3)), radius, mass, free,
        free_spin=free,
    )  # fmt: skip
    return near_of(Scene((row, Wall(-99.0 * UP, UP)), contact))


@pytest.mark.parametrize("contact", [SMOOTH, ROUGH])
def test_any_two_of_many_spheres_may_meet(contact: Contact) -> None:
    """The quickest contact is that of the two that yield most, along the normal or across it."""
    term, near, moving = many(1.0, contact)
    loose = 1.0 / moving.mass
    due = KN * np.sort(loose)[-2:].sum()
    if contact is ROUGH:
        yields = loose + near.radius**2 / moving.inertia
        due = max(due, KS * np.sort(yields)[-2:].sum())
    assert near_contacts.highest_square(term, near, moving) == pytest.approx(due)


@pytest.mark.parametrize(("gap", "pairs"), [(-0.01, 79), (2e-9, 79), (4e-9, 0)])
def test_of_many_spheres_those_in_touch_have_springs(gap: float, pairs: int) -> None:
    """A gap of a billionth of the smaller radius counts as none."""
    term, near, _ = many(gap, SMOOTH)
    found, closed = near_contacts.springs(term, near)
    assert len(found.kn) == len(closed) == pairs
    assert closed.all()
    if pairs:
        assert sorted(found.rows.tolist()) == [[i, i + 1] for i in range(79)]
        assert found.n == pytest.approx(np.tile(UP, (79, 1)))
