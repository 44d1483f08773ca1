"""Claims about the lattice along other directions: two routes agree, and it is not isotropic."""

from types import ModuleType

import numpy as np
import pytest

from reference_solutions.bonds import lattice_directions, lattice_material
from reference_solutions.bonds.lattice_material import QUARTZITE
from reference_solutions.checks.bonds import lattice_directions as repeated
from tests.support.turned_signs import caught, signs, turned

D = 1e-3
ELEMENT = lattice_material.element(QUARTZITE, D)
SPRINGS = {"kn": ELEMENT.kn, "ks": ELEMENT.ks, "d": D}
STRAINS = np.random.default_rng(2017).normal(size=(8, 6))


STRONG = {**SPRINGS, "xb": ELEMENT.xb}
SIDES = np.random.default_rng(17).normal(size=(3, 3))


def apart(route: ModuleType, second: ModuleType = repeated) -> float:
    """The largest relative difference of the two routes, in energy and in strength."""
    stiff = np.linalg.inv(route.compliance(**SPRINGS))
    off = []
    for e in STRAINS:
        tensor = np.array([[e[0], e[5] / 2, e[4] / 2], [0, e[1], e[3] / 2], [0, 0, e[2]]])
        tensor += np.triu(tensor, 1).T
        off.append(0.5 * e @ stiff @ e / second.energy(tensor, **SPRINGS) - 1.0)
    for side in SIDES:
        n = side / np.linalg.norm(side)
        off.append(route.opening(side, **STRONG) / second.opening(n, **STRONG) - 1.0)
    return float(np.abs(off).max())


def along(direction: list[float]) -> float:
    """E in a direction over E along the axis of the unit."""
    E = lattice_directions.modulus(direction, **SPRINGS)
    return E / lattice_material.youngs_modulus(**SPRINGS)


def test_the_two_routes_agree() -> None:
    assert apart(lattice_directions) < 1e-12


def test_along_the_axis_of_the_unit_it_is_eq_6() -> None:
    assert along([0.0, 0.0, 2.0]) == pytest.approx(1.0, rel=1e-13)


def test_along_its_other_three_axes_it_is_not() -> None:
    sides = [[np.sqrt(8) * np.sin(a), np.sqrt(8) * np.cos(a), -1.0] for a in (0.0, 2.1, 4.2)]
    assert along(sides[0]) == pytest.approx(0.8715, abs=1e-4)
    assert along([1.0, 0.0, 0.0]) == along([0.3, 0.4, 0.0]) == pytest.approx(0.9112, abs=1e-4)
    tilts = np.linspace(0.0, np.pi / 2, 200)
    assert min(along([np.sin(t), 0.0, np.cos(t)]) for t in tilts) == pytest.approx(0.829, abs=1e-3)


def test_pulled_along_the_axis_of_the_unit_its_first_bond_opens_at_eq_7() -> None:
    due = lattice_material.tensile_strength(**STRONG)
    assert lattice_directions.opening([0.0, 0.0, 1.0], **STRONG) == pytest.approx(due, rel=1e-12)


@pytest.mark.shows(
    "at 0.931 of it along the unit's other three axes, at 0.559 to 0.808 in the plane of the "
    "base, and at 0.540 at least"
)
def test_it_is_weaker_along_all_other_directions() -> None:
    def share(direction: list[float]) -> float:
        whole = lattice_material.tensile_strength(**STRONG)
        return lattice_directions.opening(direction, **STRONG) / whole

    assert share([0.0, np.sqrt(8), 1.0]) == pytest.approx(0.9311, abs=1e-4)
    assert share([1.0, 0.0, 0.0]) == pytest.approx(0.5589, abs=1e-4)
    assert share([0.0, 1.0, 0.0]) == pytest.approx(0.8084, abs=1e-4)
    tilted = np.random.default_rng(1).normal(size=(500, 3)).tolist()
    assert all(0.5395 < share(direction) < 1.0 for direction in tilted)


@pytest.mark.parametrize("sign", signs(lattice_directions, without=("-1.0",)))
def test_any_wrong_sign_is_caught(sign: int) -> None:
    assert caught(lambda: apart(turned(lattice_directions, sign)) < 1e-9)


@pytest.mark.parametrize("sign", signs(repeated, without=("-1", "PLACES[j] + BOX * image")))
def test_any_wrong_sign_in_the_second_route_is_caught(sign: int) -> None:
    assert caught(lambda: apart(lattice_directions, turned(repeated, sign)) < 1e-9)


def test_no_direction_is_refused() -> None:
    with pytest.raises(ValueError, match=r"direction = \[0.0, 0.0, 0.0\]; it must be finite"):
        lattice_directions.modulus([0.0, 0.0, 0.0], **SPRINGS)
