"""Claims about the springs from which the largest stable step follows: truths by hand."""

from __future__ import annotations

import dataclasses
import math
from typing import Any

import numpy as np
import pytest
import scipy.sparse.linalg

from vv.engines import dem
from vv.engines.dem.critical_step import CLOSE, DENSE, delay, highest_delay, highest_square
from vv.engines.dem.space import springs
from vv.engines.dem.space.model import Space, space
from vv.engines.dem.terms import bonds as of_bonds
from vv.engines.dem.terms.bonds import Bonds as BondTerm
from vv.scene import Bonds, Contact, Hertz, Scene, Spheres, Vector, Wall

KN, KS = 1e5, 4e4
ROUGH, SMOOTH = Contact(KN, KS, 0.5), Contact(KN)
MASS, RADIUS = np.array([2.0, 0.7, 5.0]), np.array([0.4, 0.35, 0.3])
ALL = np.ones((3, 3), bool)
UP = np.array([0.0, 0.0, 1.0])


def three(
    gaps: tuple[float, float], contact: Contact, free: Any = ALL, turn: Any = ALL, **others: Any
) -> Scene:
    """Three unlike spheres in a row, oblique to the axes, with gaps between neighbours [m]."""
    along = np.array([0.6, 0.48, 0.64])
    away = np.cumsum([0.0, *(RADIUS[i] + RADIUS[i + 1] + gaps[i] for i in range(2))])
    spheres = Spheres(np.outer(away, along), 0.0 * ALL, RADIUS, MASS, free, free_spin=turn)
    return Scene((spheres,), contact, **others)


def square(one: Scene) -> float:
    return highest_square(space(one).state)


def test_one_contact_swings_by_its_reduced_mass_or_by_what_slides_and_rolls() -> None:
    """kn (1/m1 + 1/m2), or ks (1/m1 + 1/m2 + r1^2/I1 + r2^2/I2) of the pair that is quickest."""
    inertia = three((1.0, 1.0), ROUGH).spheres.inertia
    loose = 1.0 / MASS
    rolling = loose + RADIUS**2 / inertia
    assert square(three((1.0, 1.0), SMOOTH)) == pytest.approx(KN * (loose[0] + loose[1]))
    due = KS * (rolling[0] + rolling[1])
    assert due > KN * (loose[0] + loose[1])
    assert square(three((1.0, 1.0), ROUGH)) == pytest.approx(due)
    stiff = dataclasses.replace(ROUGH, ks=1e3)
    assert square(three((1.0, 1.0), stiff)) == pytest.approx(KN * (loose[0] + loose[1]))


def test_contacts_that_are_closed_at_first_swing_together() -> None:
    """The middle one of three has springs on both sides."""
    matrix = KN * np.array([[1.0, -1.0, 0.0], [-1.0, 2.0, -1.0], [0.0, -1.0, 1.0]])
    due = np.linalg.eigvalsh(matrix / np.sqrt(np.outer(MASS, MASS)))[-1]
    assert square(three((-1e-3, 0.0), SMOOTH)) == pytest.approx(due)
    assert square(three((-1e-3, 1e-6), SMOOTH)) == pytest.approx(KN * (1 / 2.0 + 1 / 0.7))


def test_a_sphere_that_is_held_moves_nothing_and_a_locked_one_in_part() -> None:
    held = ALL.copy()
    held[1] = False
    one = three((-1e-3, 1.0), SMOOTH, held, held)
    assert square(one) == pytest.approx(KN * (1 / MASS[0] + 1 / MASS[2]))  # these may meet
    part = ALL.copy()
    part[0] = [True, False, False]
    due = KN * (0.36 / MASS[0] + 1 / MASS[1])
    closed = three((-1e-3, -1e-3), SMOOTH, part)
    assert square(closed) > due


@pytest.mark.parametrize(
    ("spheres", "sparse"), [(20, False), (DENSE // 6, False), (DENSE // 6 + 1, True), (90, True)]
)
def test_a_chain_swings_as_its_band_says_by_a_full_and_by_a_sparse_matrix(
    spheres: int, sparse: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Equal masses on springs in a row: 2 kn/m (1 + cos(pi/n)), from below if sparse."""
    asked, solve = [], scipy.sparse.linalg.eigsh

    def counted(matrix: Any, *others: Any, **named: Any) -> Any:
        asked.append(matrix.shape)
        return solve(matrix, *others, **named)

    monkeypatch.setattr(scipy.sparse.linalg, "eigsh", counted)
    place = np.outer(np.arange(spheres) * 0.999, UP)
    ones = np.ones(spheres)
    free = np.ones((spheres, 3), bool)
    row = Spheres(place, 0.0 * place, 0.5 * ones, 2.0 * ones, free)
    due = 2.0 * KN / 2.0 * (1.0 + math.cos(math.pi / spheres))
    found = square(Scene((row,), SMOOTH))
    assert due * (1.0 - (CLOSE if sparse else 1e-12)) <= found <= due * (1.0 + 1e-12)
    assert bool(asked) == sparse


@pytest.mark.parametrize("rough", [True, False])
def test_three_spheres_that_touch_one_another_swing_by_all_their_springs(rough: bool) -> None:
    """Each spring is stretched by the difference of its ends, and sheared also by both spins."""
    place = np.array([[0.0, 0.0, 0.0], [0.7, 0.0, 0.0], [0.35, 0.0, 0.5]])
    spheres = Spheres(place, 0.0 * ALL, RADIUS, MASS, ALL, free_spin=ALL)
    weights = np.sqrt(np.concatenate([np.repeat(MASS, 3), np.repeat(spheres.inertia, 3)]))
    lines: list[Vector] = []
    for i, j in ((0, 1), (0, 2), (1, 2)):
        n = (place[j] - place[i]) / np.linalg.norm(place[j] - place[i])
        for e in np.eye(3):
            across = e - (e @ n) * n
            for way, k in ((np.outer(n, n) @ e, KN), (across, KS if rough else 0.0)):
                line = np.zeros(18)
                line[3 * j : 3 * j + 3], line[3 * i : 3 * i + 3] = way, -way
                for body in (i, j):
                    line[9 + 3 * body : 12 + 3 * body] = -RADIUS[body] * np.cross(n, way)
                lines.append(np.sqrt(k) * line / weights)
    due = np.linalg.norm(np.array(lines), 2) ** 2
    assert square(Scene((spheres,), ROUGH if rough else SMOOTH)) == pytest.approx(due)


def test_on_a_line_the_spring_that_is_there_counts() -> None:
    """That of the normal, or that of friction; without either no step is critical."""
    axes = np.array([UP, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    floor = Wall(np.array([0.0, 0.0, -0.39]), UP)
    for free, contact, k in (
        ([True, False, False], ROUGH, KN), ([False, True, False], ROUGH, KS),
        ([False, True, False], SMOOTH, 0.0),
    ):  # fmt: skip
        sphere = Spheres(np.zeros((1, 3)), np.zeros((1, 3)), RADIUS[:1], MASS[:1], np.array([free]))
        step = dem.critical_step(Scene((floor, sphere), contact, axes=axes), dem.CENTRED)
        assert step == pytest.approx(2.0 / math.sqrt(k / 2.0) if k else math.inf)


def test_springs_of_contacts_are_those_of_pairs_and_of_walls_as_ground() -> None:
    """An overlap, a gap that is rounding, and a gap; the smaller radius counts."""
    rows, n = np.array([[0, 1], [1, 2], [0, 2]]), np.array([[3.0, 0.0, 4.0], UP, -2.0 * UP])
    gap, radii = np.array([-1e-3, 0.9e-9, 1.1e-9]), np.array([[1.0, 2.0], [3.0, 1.0], [1.0, 4.0]])
    found, closed = springs.springs_of_contacts(rows, n, gap, radii, KN, KS)
    assert (found.rows == rows).all()
    assert found.n == pytest.approx(np.array([[0.6, 0.0, 0.8], UP, -UP]))
    assert (found.kn == KN).all()
    assert (found.ks == KS).all()
    assert (found.arms == radii).all()
    assert closed.tolist() == [True, True, False]
    walls, shut = springs.springs_of_contacts(rows[:, 0], n, gap, radii[:, 1], KN, KS)
    assert (walls.rows == [[springs.GROUND, i] for i in (0, 1, 0)]).all()
    assert (walls.arms == radii[:, 1:]).all()
    assert shut.tolist() == [True, True, True]


BONDS = Bonds(
    np.array([[1, 0], [1, 2]]), np.array([0.7, 0.66]), np.array([3e4, 7e4]), np.array([2e4, 0.0])
)


def test_springs_of_bonds_reach_to_amid_the_surfaces_and_all_exist() -> None:
    one: Space = space(three((0.02, 0.03), SMOOTH, bonds=BONDS))
    found, there = of_bonds.springs(one.state.term(BondTerm), None)
    assert there.all()
    assert found.kn == pytest.approx([3e4, 7e4])
    assert found.ks == pytest.approx([2e4, 0.0])
    assert found.arms == pytest.approx(np.array([[0.41, 0.36], [0.365, 0.315]]))
    assert found.n == pytest.approx(np.tile([0.6, 0.48, 0.64], (2, 1)))


def test_a_delay_is_the_viscosity_over_the_stiffness() -> None:
    """With Hertz, 2 z over the frequency; without a frequency there is none."""
    assert delay(three((1.0, 1.0), Contact(KN, eta_n=30.0)), 4.0) == pytest.approx(30.0 / KN)
    elastic = three((1.0, 1.0), Contact(0.0, hertz=Hertz(1e8, 8e7, 0.2)))
    assert delay(elastic, 16.0) == pytest.approx(0.1)
    assert delay(elastic, 0.0) == 0.0
    assert highest_delay(three((1.0, 1.0), Contact(KN, eta_n=30.0))) == pytest.approx(30.0 / KN)


@pytest.mark.parametrize("leapfrog", [dem.CENTRED, dem.LAGGED])
def test_drag_and_dashpots_that_lag_shorten_the_largest_step_together(leapfrog: Any) -> None:
    """The smallest mass of all counts for drag."""
    scene = three((-1e-3, 1.0), Contact(KN, eta_n=30.0), eta=9.0)
    w2 = KN * (1.0 / 2.0 + 1.0 / 0.7)
    n = 0.5 * (9.0 / 0.7 + 30.0 / KN * w2) * (2.0 * leapfrog.lag - 1.0)
    due = 2.0 / (math.sqrt(n * n + w2) + n)
    assert dem.critical_step(scene, leapfrog) == pytest.approx(due)


def test_a_wall_is_ground_for_the_step() -> None:
    spheres = three((1.0, 1.0), SMOOTH).spheres
    wall = Wall(np.array([0.0, 0.0, -0.4]), UP)
    alone = Scene((wall, spheres.part(slice(0, 1))), ROUGH)
    inertia = float(spheres.inertia[0])
    due = max(KN / 2.0, KS * (1.0 / 2.0 + 0.16 / inertia))
    assert square(alone) == pytest.approx(due)
