"""Claims about blocks at finite strain: the path of the unit, and the limit of small strains."""

import numpy as np
import pytest

from reference_solutions.bonds import lattice_material, tetrahedral_unit
from reference_solutions.bonds.close_packed_lattice import SIZES, Lattice, lattice, static
from reference_solutions.bonds.lattice_path import path

D = 1e-3
KN, KS = lattice_material.element(lattice_material.QUARTZITE, D)[:2]
HEIGHT = D * np.sqrt(2 / 3)
TURNS = 2 * np.pi / 3 * np.arange(3)
BASE = D / np.sqrt(3) * np.column_stack([np.cos(TURNS), np.sin(TURNS), np.zeros(3)])
UNIT = Lattice(
    np.vstack([BASE, [0.0, 0.0, HEIGHT]]),
    np.array([[0, 1], [0, 2], [1, 2], [0, 3], [1, 3], [2, 3]]),
    np.sqrt(3) / 2 * D**2,
    HEIGHT,
)


@pytest.mark.parametrize("strain", [-5e-3, -1e-3, 2e-3])
@pytest.mark.parametrize("gamma", [5 / 29, 0.0, 1.0])
def test_four_elements_follow_the_path_that_is_known_in_closed_form(
    strain: float, gamma: float
) -> None:
    stress, _, _ = path(UNIT, KN, gamma * KN, np.array([strain]), 8)[0]
    exact = tetrahedral_unit.equilibrium(strain, kn=KN, ks=gamma * KN, d=D)
    assert stress == pytest.approx(exact.stress, rel=1e-8)


@pytest.mark.parametrize("strain", [1e-5, -1e-7, 1e-12])
def test_a_block_that_is_hardly_strained_gives_its_static_answer(strain: float) -> None:
    """Up to the strain itself, and to the residual at which equilibrium is taken for found."""
    block = lattice(*SIZES[82], D)
    answer = static(block, KN, KS)
    ((stress, wide, deep),) = path(block, KN, KS, np.array([strain]), 1)
    assert [stress, -wide, -deep] == pytest.approx(
        [strain * answer.E, strain * answer.nu_x, strain * answer.nu_y],
        rel=2 * abs(strain) + 1e-8,
    )


def test_parts_are_of_second_order() -> None:
    block = lattice(*SIZES[82], D)
    coarse, fine, finest = (path(block, KN, KS, np.array([-5e-3]), n)[0, 0] for n in (1, 2, 4))
    assert (coarse - fine) / (fine - finest) == pytest.approx(4.0, abs=0.6)


def test_strains_must_grow() -> None:
    with pytest.raises(ValueError, match="they must grow in size, with one sign"):
        path(UNIT, KN, KS, np.array([1e-3, -2e-3]), 1)
