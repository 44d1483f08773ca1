"""Claims about Newton steps for the contacts of many blocks, and about their banded equations."""

from __future__ import annotations

from typing import Any

import numba
import numpy as np
import pytest

from tests.engines.rigid.test_momentum import MOST, TOLERANCE, pile
from vv.engines.blocks.geometry import Index
from vv.engines.kernels.arrays import zero_rows
from vv.engines.rigid.general.few import polish
from vv.engines.rigid.limits import INNER, STIFF
from vv.engines.rigid.solver.assembly import Bodies, Joints
from vv.engines.rigid.solver.banded import band_ordering, equation_numbers, half_width
from vv.engines.rigid.solver.cone import residual, sweep
from vv.engines.rigid.solver.newton import newton_round
from vv.engines.rigid.solver.problem import Friction, Problem
from vv.scene import Vector

PLANE, SPIN = np.diag([1.0, 0.0, 1.0]), np.diag([0.0, 1.0, 0.0])


def _solved(
    joints: Joints, bodies: Bodies, friction: Friction, v: Vector, w: Vector, newton: bool
) -> tuple[int, float]:
    """Solve by sweeps, with Newton steps after every sixty if asked for; returns the residual."""
    p, blocks = zero_rows(len(joints.first)), len(v) - 1
    place, _ = band_ordering(joints, bodies, blocks)
    problem = Problem(joints, bodies, friction, p, v, w)
    sweeps, left = 0, residual(p, joints, friction, v, w)
    while left > TOLERANCE and sweeps < MOST:
        sweep(p, joints, bodies, friction, v, w)
        left, sweeps = residual(p, joints, friction, v, w), sweeps + 1
        if newton and sweeps % 60 == 0:
            left = polish(problem, TOLERANCE, left, place, STIFF)
    return sweeps, left


def _equations(joints: Joints, bodies: Bodies, blocks: int) -> tuple[Index, int, int]:
    """The equation numbers of velocities, their count, and the half-width of the band."""
    place, _ = band_ordering(joints, bodies, blocks)
    row, many = equation_numbers(bodies, place)
    return row, many, half_width(joints, row, blocks)


def _round_of(
    joints: Joints, bodies: Bodies, friction: Friction, falls: Vector, stiffness: float
) -> tuple[bool, Vector]:
    """Whether a Newton round on contacts of this stiffness converges; and the impulses of it."""
    p, blocks = zero_rows(len(joints.first)), len(falls) - 1
    place, _ = band_ordering(joints, bodies, blocks)
    problem = Problem(joints, bodies, friction, p, 1.0 * falls, 0.0 * falls)
    return newton_round(problem, zero_rows(len(p)), TOLERANCE, stiffness, place, INNER) > 0, p


# not cached on disk, where they would outlive the functions they call
solved: Any = numba.njit(_solved)
round_of: Any = numba.njit(_round_of)
equations: Any = numba.njit(_equations)


def in_plane(height: int, mu: float) -> tuple[Joints, Bodies, Friction, Vector]:
    """The pile, of cubes that move in one plane only, so that half of the velocities are locked."""
    joints, bodies, friction, falls = pile(height, mu)
    pull = np.zeros_like(joints.pull)
    locked = Bodies(bodies.inverse @ PLANE, bodies.inverse_spin @ SPIN, bodies.centre)
    for c, (a, b) in enumerate(zip(joints.first, joints.second, strict=True)):
        n = joints.normal[c]
        for body, arm in ((a, joints.arm_first[c]), (b, joints.arm_second[c])):
            spun = np.cross(locked.inverse_spin[body] @ np.cross(arm, n), arm)
            pull[c] += locked.inverse[body] @ n + spun
    across = np.einsum("ci,ci->c", pull, joints.normal)
    return joints._replace(pull=pull, across=across), locked, friction, falls


@pytest.mark.shows("A sweep passes a force on by one block")
@pytest.mark.parametrize("made", [pile, in_plane])
@pytest.mark.parametrize("mu", [0.5, 0.05])
def test_newton_steps_reach_the_answer_of_sweeps_in_fewer(made: Any, mu: float) -> None:
    joints, bodies, friction, falls = made(8, mu)
    v, w, slow_v, slow_w = falls.copy(), 0 * falls, falls.copy(), 0 * falls
    sweeps, left = solved(joints, bodies, friction, v, w, True)
    slow, beyond = solved(joints, bodies, friction, slow_v, slow_w, False)
    assert max(left, beyond) <= TOLERANCE
    assert sweeps <= slow / 3
    assert np.abs(v - slow_v).max() <= 30 * TOLERANCE
    assert np.abs(w - slow_w).max() <= 60 * TOLERANCE


def test_only_velocities_that_are_free_have_equations_and_these_lie_near_the_diagonal() -> None:
    joints, bodies, _, _ = in_plane(8, 0.5)
    row, many, far = equations(joints, bodies, 8)
    assert many == 8 * 3
    assert sorted(row[row >= 0]) == list(range(24))
    assert far == 5  # those of one cube and of the next


@pytest.mark.parametrize("made", [pile, in_plane])
def test_a_round_on_contacts_so_stiff_that_rounding_makes_it_singular_does_not_converge(
    made: Any,
) -> None:
    joints, bodies, friction, falls = made(8, 0.5)
    met = []
    for stiffness in 10.0 ** np.arange(0, 300, 3):
        converged, p = round_of(joints, bodies, friction, falls, stiffness)
        assert np.isfinite(p).all() or not converged
        met.append(converged)
    assert met[0]
    assert not all(met)
