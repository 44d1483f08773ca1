"""Claims about modes of the tetrahedral unit: no mechanism, breathing, and rotation."""

import numpy as np
import pytest

from cases.bonds.parts._unit import CORNERS, EDGES, OUT, ROUND
from vv.plan.project import find
from vv.scene import Vector

CASE = find().load_case("tetrahedral-unit")


def stiffness(gamma: float) -> Vector:
    """The stiffness (12, 12) over kn of all displacements: 1 along bonds, gamma across them."""
    whole = np.zeros((4, 3, 4, 3))
    for i, j in EDGES:
        n = CORNERS[j] - CORNERS[i]
        spring = gamma * np.eye(3) + (1 - gamma) * np.outer(n, n)
        for a, b, sign in ((i, i, 1), (j, j, 1), (i, j, -1), (j, i, -1)):
            whole[a, :, b] += sign * spring
    return whole.reshape(12, 12)


@pytest.mark.parametrize(("gamma", "idle"), [(0.0, 6), (1e-3, 3), (5 / 29, 3), (1.0, 3)])
def test_only_rigid_motions_cost_nothing_and_turns_only_without_shear(
    gamma: float, idle: int
) -> None:
    """No mechanism exists at gamma = 0: only three translations and three rotations are free."""
    squares = np.linalg.eigvalsh(stiffness(gamma))
    assert (np.abs(squares) < 1e-12).sum() == idle
    assert squares[idle] > 1e-4


@pytest.mark.parametrize(("shape", "square"), [(OUT, 1.0), (ROUND, 5 / 29)])
def test_breathing_and_turning_are_modes_at_twice_the_root_of_their_spring(
    shape: Vector, square: float
) -> None:
    moved = shape.ravel()
    assert stiffness(5 / 29) @ moved == pytest.approx(4 * square * moved, abs=1e-13)


def test_a_turn_by_a_small_angle_costs_two_ks_d2_of_its_square() -> None:
    energy = 0.5 * ROUND.ravel() @ stiffness(5 / 29) @ ROUND.ravel()
    assert energy == pytest.approx(2 * 5 / 29, rel=1e-12)


def test_the_case_throws_the_unit_so_that_it_turns_as_a_whole() -> None:
    """All distances stay constant to second order in the angle."""
    study = CASE.declare("turned", CASE.defaults("turned")).study
    v = study.scene.spheres.velocity
    i, j = EDGES.T
    rates = np.einsum("bk,bk->b", CORNERS[j] - CORNERS[i], v[j] - v[i])
    assert np.abs(rates).max() < 1e-12 * np.abs(v).max()
    assert np.abs(v).max() > 0
