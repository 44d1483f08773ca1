"""Claims about blocks of bonded elements: their geometry, and their static solutions."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from reference_solutions.bonds import close_packed_lattice, lattice_material
from reference_solutions.bonds.close_packed_lattice import SIZES, count, cut, lattice, static
from reference_solutions.checks.bonds import close_packed_lattice as crystal
from tests.support.turned_signs import caught, signs, turned

Array = NDArray[np.float64]

D = 1e-3
KN, KS = lattice_material.element(lattice_material.QUARTZITE, D)[:2]
GAMMA = KS / KN
# errors in percent of E and nu against the infinite lattice's 90 GPa and 0.16
KNOWN = {
    82: (3.64, -1.28),
    255: (2.29, -0.80),
    580: (1.69, -0.39),
    1105: (1.34, -0.14),
    2166: (1.05, 1.10),
    5461: (0.83, 0.46),
}


def ordered(x: Array) -> Array:
    """Rows sorted by z, y and x, independently of rounding."""
    return x[np.lexsort(np.round(x, 6).T)]


@pytest.mark.parametrize("N", SIZES)
def test_blocks_have_the_published_numbers_of_elements(N: int) -> None:
    assert count(*SIZES[N]) == N
    if N <= 5461:
        assert len(lattice(*SIZES[N], D).position) == N


@given(st.integers(2, 6), st.integers(1, 3), st.integers(1, 3))
@settings(max_examples=15)
def test_a_block_is_a_box_of_the_crystal(n: int, p: int, q: int) -> None:
    block = lattice(n, p, q, D)
    assert np.allclose(ordered(block.position / D), ordered(crystal.centres(n, p, q)), atol=1e-12)
    assert len(block.position) == count(n, p, q)


@pytest.mark.parametrize("N", [82, 255])
def test_every_bond_touches_and_an_inner_element_has_twelve(N: int) -> None:
    block = lattice(*SIZES[N], D)
    i, j = block.bonds.T
    length = np.linalg.norm(block.position[j] - block.position[i], axis=1)
    assert np.abs(length / D - 1).max() < 1e-13
    assert np.bincount(block.bonds.ravel()).max() == 12
    assert (i < j).all()
    assert all(tuple(a) < tuple(b) for a, b in pairwise(block.bonds.tolist()))


@pytest.mark.parametrize("N", KNOWN)
def test_the_static_answer_of_blocks_of_quartzite(N: int) -> None:
    answer = static(lattice(*SIZES[N], D), KN, KS)
    E, nu = KNOWN[N]
    assert pytest.approx(E, abs=0.005) == 100 * (answer.E / 90e9 - 1)
    assert 100 * (answer.nu / 0.16 - 1) == pytest.approx(nu, abs=0.005)


def test_the_smallest_block_widens_unequally() -> None:
    answer = static(lattice(*SIZES[82], D), KN, KS)
    off = [100 * (nu / 0.16 - 1) for nu in (answer.nu_x, answer.nu_y)]
    assert off == pytest.approx([-14.4, 11.9], abs=0.05)


@pytest.mark.parametrize(("N", "gamma"), [(82, GAMMA), (82, 0.0), (82, 1.0), (255, GAMMA)])
def test_the_static_answer_is_the_least_squares_of_all_slips(N: int, gamma: float) -> None:
    answer = static(lattice(*SIZES[N], D), KN, gamma * KN)
    E, nu_x, nu_y = crystal.static(*SIZES[N], gamma)
    assert pytest.approx(E, rel=1e-11) == answer.E * D / KN
    assert [answer.nu_x, answer.nu_y] == pytest.approx([nu_x, nu_y], rel=1e-10, abs=1e-11)


@given(st.floats(0.01, 1.0))
@settings(max_examples=10)
def test_the_infinite_lattice_is_the_formulas(gamma: float) -> None:
    """Eqs. 4 and 6 hold along the c axis."""
    gradient = crystal.pulled(gamma, np.array([0.0, 0.0, 1.0]))
    E = lattice_material.youngs_modulus(1.0, gamma, 1.0)
    nu = lattice_material.poissons_ratio(1.0, gamma)
    assert gradient == pytest.approx(np.diag([-nu, -nu, 1.0]) / E, rel=1e-11, abs=1e-13)


def test_the_lattice_is_softer_along_the_other_axes_of_its_units() -> None:
    """A unit has four equivalent axes; the crystal of such units has only one."""
    line = np.array([0.0, -np.sqrt(8.0) / 3.0, 1.0 / 3.0])
    E = 1 / float(line @ crystal.pulled(GAMMA, line) @ line)
    assert E / lattice_material.youngs_modulus(1.0, GAMMA, 1.0) == pytest.approx(0.871, abs=5e-4)


def test_the_answer_forgets_the_order_of_the_elements() -> None:
    block = lattice(*SIZES[82], D)
    order = np.random.default_rng(3).permutation(len(block.position))
    back = np.argsort(order)
    mixed = block._replace(position=block.position[order], bonds=back[block.bonds])
    one, two = static(block, KN, KS), static(mixed, KN, KS)
    assert pytest.approx(one.E, rel=1e-11) == two.E
    assert two.nu == pytest.approx(one.nu, rel=1e-10)


@pytest.mark.parametrize(
    "sign",
    signs(
        close_packed_lattice,
        ("_layer", "_stiffness", "narrowing", "static", "relaxed"),
        ("row + kind", "-poissons_ratio(kn, ks)"),  # a parity; where the descent begins
    ),
)
def test_no_sign_can_be_turned(sign: int) -> None:
    def agrees() -> bool:
        route = turned(close_packed_lattice, sign)
        answer = route.static(route.lattice(*SIZES[82], D), KN, KS)
        E, *widths = LEAST
        told = [answer.E * D / KN, answer.nu_x, answer.nu_y, 2 * answer.nu]
        return told == pytest.approx([E, *widths, sum(widths)], rel=1e-9)

    assert caught(agrees)


LEAST = crystal.static(*SIZES[82], GAMMA)


def test_a_block_that_no_formula_counts_is_refused() -> None:
    with pytest.raises(ValueError, match="n, p, q, d = 1, 2, 2"):
        lattice(1, 2, 2, D)


@pytest.mark.parametrize("degrees", [0.0, 50.0, 70.5, 90.0])
def test_a_box_cut_along_any_direction_is_of_the_crystal(degrees: float) -> None:
    block = cut((5.5 * D, 5.5 * D, 7.5 * D), np.radians(degrees), D)
    i, j = block.bonds.T
    bond = block.position[j] - block.position[i]
    assert np.abs(np.linalg.norm(bond, axis=1) / D - 1).max() < 1e-12
    assert np.bincount(block.bonds.ravel()).max() == 12
    axis = np.array([np.sin(np.radians(degrees)), 0.0, np.cos(np.radians(degrees))])
    rises = np.abs(bond @ axis) / D
    assert set(np.round(rises, 6)) == {0.0, np.round(np.sqrt(2 / 3), 6)}
    full = 7.5 * 5.5**2 * np.sqrt(2.0)
    assert 0.8 * full < len(block.position) < 1.3 * full


@pytest.mark.parametrize("degrees", [50.0, 90.0])
def test_the_static_answer_of_a_box_leaves_no_force_on_what_is_free(degrees: float) -> None:
    block = cut((4.5 * D, 4.5 * D, 6.5 * D), np.radians(degrees), D)
    answer = static(block, KN, KS)
    force = np.zeros_like(answer.u)
    for i, j in block.bonds:
        n, apart = (block.position[j] - block.position[i]) / D, answer.u[j] - answer.u[i]
        pull = KS * apart + (KN - KS) * (apart @ n) * n
        force[i] += pull
        force[j] -= pull
    held = block.at(2, 0) | block.at(2, 1)
    size = np.abs(force[held, 2]).max()
    assert np.abs(force[~held]).max() < 1e-9 * size
    assert np.abs(force[held, :2]).max() < 1e-9 * size
    assert answer.u[held, 2] == pytest.approx(block.position[held, 2], abs=1e-15)
    assert -force[block.at(2, 1), 2].sum() / block.area == pytest.approx(answer.E, rel=1e-10)


def test_a_box_of_few_elements_is_refused() -> None:
    with pytest.raises(ValueError, match="sides must be at least 4 d"):
        cut((3.0 * D, 5.0 * D, 5.0 * D), 0.0, D)
