"""Claims about the arrays that bonds and searches of a scene are built from: by hand."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from vv.engines.dem.bonds.layout import MANY, SKIN, bonds_turn_alone
from vv.engines.dem.space.placed import Placed, placed
from vv.scene import Bonds, Contact, Scene, Spheres

KN, KS = 1e5, 4e4
RADIUS, MASS = np.array([0.4, 0.35, 0.3, 0.5]), np.array([2.0, 0.7, 5.0, 1.0])
PLACE = np.array([[0.0, 0.0, 0.0], [0.8, 0.0, 0.0], [0.7, 0.8, 0.0], [0.0, 0.9, 0.3]])
PAIRS = np.array([[3, 0], [1, 2], [0, 2], [1, 3]])
LENGTH = np.array([0.9, 0.65, 1.1, 1.2])


def built(
    contact: Contact, held: tuple[int, ...] = (), turns: bool = True, ks: float = KS, **more: Any
) -> Placed:
    free = np.ones((4, 3), bool)
    free[list(held)] = False
    spheres = Spheres(PLACE, 0.0 * PLACE, RADIUS, MASS, free, free_spin=free & turns)
    kn = np.array([1e4, 2e4, 3e4, 4e4])
    bonds = Bonds(PAIRS, LENGTH, kn, ks * np.array([1.0, 2.0, 3.0, 4.0]), **more)
    return placed(Scene((spheres,), contact, bonds=bonds))


def test_bonds_with_an_end_that_moves_are_sorted_by_their_spheres() -> None:
    """Spheres 1 and 3 are held: their bond is left out, and they have the row of the ground."""
    found = built(Contact(KN), held=(1, 3)).bonds
    assert found.springs is not None
    rows, offset, first, stretch, kn, radius = found.springs
    order, pairs = [2, 0, 1], np.array([[0, 2], [0, 3], [1, 2]])
    assert rows.tolist() == [[0, 1], [0, 2], [2, 1]]
    assert offset == pytest.approx(PLACE[pairs[:, 1]] - PLACE[pairs[:, 0]])
    assert first == pytest.approx(np.linalg.norm(offset, axis=1))
    assert stretch == pytest.approx(first - LENGTH[order])
    assert kn.tolist() == [3e4, 1e4, 2e4]
    assert radius == pytest.approx(RADIUS[pairs])
    assert found.ks is not None
    assert found.ks.tolist() == [3 * KS, KS, 2 * KS]
    assert found.frail is None
    assert found.state.shape[0] == 0
    assert built(Contact(KN), ks=0.0).bonds.ks is None
    assert built(Contact(KN), held=(0, 1, 2, 3)).bonds.springs is None


def test_a_search_beside_bonds_knows_whom_each_sphere_is_bonded_to() -> None:
    """Its skin is a fifth of the smallest radius; a bond is kept with its lower sphere."""
    near = built(Contact(KN)).near
    assert near is not None
    assert near.skin == pytest.approx(0.2 * 0.3)
    assert SKIN == 0.2
    assert near.start.tolist() == [0, 2, 4, 4, 4]
    assert near.partner.tolist() == [2, 3, 2, 3]
    assert near.broken.shape == (0,)
    assert not near.viscous
    assert built(Contact(KN, eta_n=2.0)).near is not None


def test_bonds_turn_alone_where_they_shear_spheres_that_turn_on_springs() -> None:
    """Friction, dashpots and Hertz are the others."""

    def alone(contact: Contact, **changes: Any) -> bool:
        return bonds_turn_alone(built(contact, **changes).scene)

    assert alone(Contact(KN))
    assert not alone(Contact(KN), ks=0.0)
    assert not alone(Contact(KN), turns=False)
    assert not alone(Contact(KN, KS, 0.3))
    assert not alone(Contact(KN, eta_n=2.0))


@pytest.mark.parametrize(("spheres", "searches"), [(MANY - 1, False), (MANY, True)])
def test_without_bonds_many_spheres_are_searched(spheres: int, searches: bool) -> None:
    place = np.arange(3.0 * spheres).reshape(-1, 3)
    ones = np.ones(spheres)
    some = Spheres(place, 0.0 * place, ones, ones, np.ones((spheres, 3), bool))
    assert (placed(Scene((some,), Contact(KN))).near is not None) == searches
