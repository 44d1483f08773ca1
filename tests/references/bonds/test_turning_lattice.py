"""Claims about bonded elements that rotate: two routes agree; the unit's shear springs are idle."""

import numpy as np
import pytest
from numpy.typing import NDArray

from reference_solutions.bonds import close_packed_lattice, lattice_material, turning_lattice
from reference_solutions.bonds.close_packed_lattice import SIZES, Lattice, lattice
from reference_solutions.checks.bonds import turning_lattice as points
from tests.scenes.spheres.bonded_scenes import CORNERS, EDGES, KN, KS, D
from tests.support.turned_signs import caught, signs, turned

Array = NDArray[np.float64]
SMALL = lattice(*SIZES[82], D)
FORCE, MOVED = points.static(SMALL.position / D, KS / KN)
UNIT = Lattice(CORNERS, EDGES, np.sqrt(3) / 2 * D * D, D * np.sqrt(2 / 3))


def test_a_block_is_the_least_squares_of_where_its_points_part() -> None:
    answer = turning_lattice.static(SMALL, KN, KS)
    assert pytest.approx(KN * D * FORCE / SMALL.area, rel=1e-11) == answer.E
    widths = [close_packed_lattice.narrowing(SMALL, MOVED * D, axis) for axis in (0, 1)]
    assert [answer.nu_x, answer.nu_y] == pytest.approx(widths, rel=1e-9)
    assert answer.nu == pytest.approx(np.mean(widths), rel=1e-9)


def test_in_the_unit_the_shear_springs_hold_nothing() -> None:
    force, u = points.static(CORNERS / D, KS / KN)
    E = force * KN * D / UNIT.area
    assert lattice_material.youngs_modulus(KN, 0.0, D) == pytest.approx(E, rel=1e-12)
    assert lattice_material.youngs_modulus(KN, KS, D) * (1 - 0.11765) == pytest.approx(E, rel=1e-5)
    wider = (u[2] - u[1]) @ (CORNERS[2] - CORNERS[1]) / D
    assert -wider == pytest.approx(0.2, rel=1e-12)


def test_soft_shear_springs_lose_little_by_turning() -> None:
    one, two = (r.static(SMALL, KN, 1e-6 * KN) for r in (close_packed_lattice, turning_lattice))
    assert pytest.approx(one.E, rel=1e-6) == two.E
    assert one.E > two.E
    with pytest.raises(ValueError, match=r"ks = 0.0 N/m"):
        turning_lattice.static(SMALL, KN, 0.0)


@pytest.mark.shows("and 0.4 % at 580")
@pytest.mark.parametrize(("N", "softer"), [(82, 0.01898), (255, 0.00788), (580, 0.00438)])
def test_turning_softens_the_faces(N: int, softer: float) -> None:
    block = lattice(*SIZES[N], D)
    still, turning = (r.static(block, KN, KS).E for r in (close_packed_lattice, turning_lattice))
    assert 1 - turning / still == pytest.approx(softer, abs=2e-5)


@pytest.mark.parametrize(
    "sign",
    signs(turning_lattice, ("static", "_stiffness"), ("-poissons_ratio(kn, ks)",)),
)
def test_no_sign_can_be_turned(sign: int) -> None:
    def agrees() -> bool:
        answer = turned(turning_lattice, sign).static(SMALL, KN, KS)
        told = [answer.E * SMALL.area / (KN * D), answer.nu]
        widths = [close_packed_lattice.narrowing(SMALL, MOVED * D, axis) for axis in (0, 1)]
        return told == pytest.approx([FORCE, sum(widths) / 2], rel=1e-9)

    assert caught(agrees)
