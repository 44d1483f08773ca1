"""Claims about the quantities derived from displacements of four bonded elements, by hand."""

from __future__ import annotations

import math

import numpy as np
import pytest

from cases.bonds.parts._unit import CORNERS, EDGES, OUT, as_it_is, beside, moved_ends, quantity_of
from vv.scene import Vector

D = 0.25
NAMES = ("E", "nu", "dz", "X_n1", "X_s1", "X_n2")


def told(u: Vector, fz: float = 3.0) -> dict[str, float]:
    """All quantities that follow from displacements (4, 3) [diameters]."""
    return {name: as_it_is(name, fz, D, D * u) for name in NAMES}


def test_the_unit_is_four_corners_a_diameter_apart_and_the_first_three_bonds_bear_the_top() -> None:
    sides = CORNERS[EDGES[:, 1]] - CORNERS[EDGES[:, 0]]
    assert np.linalg.norm(sides, axis=1) == pytest.approx(np.ones(6))
    assert (EDGES[:3] == 0).any(axis=1).all()
    assert not (EDGES[3:] == 0).any()
    assert CORNERS[1:, 2].tolist() == [0.0, 0.0, 0.0]
    assert OUT.sum(axis=0) == pytest.approx(np.zeros(3))


def test_offsets_of_bonds_lead_from_one_end_to_the_other_and_so_does_what_they_moved() -> None:
    u = np.zeros((4, 3))
    u[2] = [0.0, 0.5, 0.25]
    offset, moved = moved_ends(D, u)
    assert offset[0] == pytest.approx([1 / math.sqrt(3), 0.0, -math.sqrt(2 / 3)])
    assert offset[3] == pytest.approx([-1.5 / math.sqrt(3), 0.5, 0.0])
    expected = np.zeros((6, 3))
    expected[1] = expected[3] = [0.0, 2.0, 1.0]
    expected[4] = [0.0, -2.0, -1.0]
    assert moved == pytest.approx(expected)


@pytest.mark.parametrize("part", [1e-9, 1e-3, 0.2])
def test_growth_on_all_sides_stretches_each_bond_alike_and_shears_none(part: float) -> None:
    seen = told(part * CORNERS)
    assert seen["X_n1"] == pytest.approx(D * part, rel=1e-6)
    assert seen["X_n2"] == pytest.approx(D * part, rel=1e-6)
    assert seen["X_s1"] == pytest.approx(0.0, abs=1e-15)
    assert seen["dz"] == pytest.approx(D * part * math.sqrt(2 / 3))
    assert seen["nu"] == pytest.approx(-1.0, rel=1e-6)
    assert seen["E"] == pytest.approx(3.0 / (math.sqrt(3) / 2 * D**2 * part))


def test_a_top_that_rises_stretches_its_bonds_by_their_slope_and_shears_them_by_the_rest() -> None:
    small = 1e-6
    u = np.zeros((4, 3))
    u[0, 2] = small
    seen = told(u)
    assert seen["dz"] == pytest.approx(D * small)
    assert seen["X_n1"] == pytest.approx(D * small * math.sqrt(2 / 3), rel=1e-5)
    assert seen["X_s1"] == pytest.approx(D * small / math.sqrt(3), rel=1e-5)
    assert (seen["X_n2"], seen["nu"]) == (0.0, 0.0)


def test_what_goes_beside_a_bond_is_what_is_not_along_it() -> None:
    along = np.array([[1.0, 0.0, 0.0], [0.6, 0.8, 0.0]])
    moved = np.array([[5.0, 3.0, 4.0], [3.0, 4.0, 2.0]])
    assert beside(moved, along) == pytest.approx([5.0, 2.0])


def test_means_are_over_bonds_of_a_kind() -> None:
    stretch, across = np.array([1.0, 2.0, 6.0, 4.0, 8.0, 9.0]), np.arange(6.0)
    strain = 0.5 / math.sqrt(2 / 3)
    got = {name: quantity_of(name, 3.0, D, 0.5, stretch, across) for name in NAMES}
    assert got == pytest.approx({
        "E": 3.0 / (math.sqrt(3) / 2 * D**2 * strain), "nu": -7.0 / strain, "dz": 0.125,
        "X_n1": 0.75, "X_s1": 0.25, "X_n2": 1.75,
    })  # fmt: skip
