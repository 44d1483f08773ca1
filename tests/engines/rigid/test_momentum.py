"""Claims about sweeps with momentum, which reach the answer of plain sweeps in fewer, and arms."""

from __future__ import annotations

from typing import Any, NamedTuple

import numba
import numpy as np
import pytest

from vv.engines.blocks.geometry import Index
from vv.engines.kernels.arrays import zero_rows
from vv.engines.rigid.general.energy import arm_covariance
from vv.engines.rigid.general.lever_arms import halfway
from vv.engines.rigid.solver.assembly import Bodies, Joints
from vv.engines.rigid.solver.cone import residual, sweep
from vv.engines.rigid.solver.drift import leap_sweeps
from vv.engines.rigid.solver.momentum import momentum_sweeps
from vv.engines.rigid.solver.problem import Friction, Problem
from vv.scene import Vector

TOLERANCE, MOST = 1e-8, 20_000  # m/s; sweeps
STEP = 1e-2  # m/s gained from gravity in a step
Z = np.array([0.0, 0.0, 1.0])


def pile(height: int, mu: float) -> tuple[Joints, Bodies, Friction, Vector]:
    """A pile of unit cubes of 1 kg on a floor that slides at 0.1 m/s, with four contacts for each.

    Also their velocities (height + 1, 3) [m/s] after a step without contact.
    """
    corners = 0.5 * np.array([[x, y, 0.0] for x in (-1.0, 1.0) for y in (-1.0, 1.0)])
    inertia = np.concatenate([6.0 * np.ones(height), [0.0]])
    free = np.concatenate([np.ones(height), [0.0]])
    bodies = Bodies(
        free[:, None, None] * np.eye(3), inertia[:, None, None] * np.eye(3),
        np.zeros((height + 1, 3)),
    )  # fmt: skip
    below = np.repeat(np.array([height, *range(height - 1)]), 4)  # the last body is the floor
    above = np.repeat(np.arange(height), 4)
    low = np.tile(corners, (height, 1)) + 0.5 * Z * (below < height)[:, None]
    high = np.tile(corners, (height, 1)) - 0.5 * Z
    arms = low * free[below][:, None]
    pull = (free[below] + free[above])[:, None] * Z
    pull += 6.0 * (free[below][:, None] * np.cross(np.cross(arms, Z), arms))
    pull += 6.0 * np.cross(np.cross(high, Z), high)
    along = (free[below] + free[above]) * (1.0 + 6.0 * 0.5)
    normal, nil = np.tile(Z, (4 * height, 1)), np.zeros((4 * height, 3))
    joints = Joints(below, above, normal, arms, high, pull, pull @ Z, along)
    falls = np.concatenate([np.tile(-STEP * Z, (height, 1)), [[0.1, 0.0, 0.0]]])
    return joints, bodies, Friction(mu, np.zeros(4 * height), nil, nil), falls


def _solved(
    joints: Joints,
    bodies: Bodies,
    friction: Friction,
    v: Vector,
    carries: bool,
    leaps: bool = False,
) -> tuple[int, float, Vector]:
    p, w, sweeps = zero_rows(len(joints.first)), zero_rows(len(v)), 0
    left, problem = residual(p, joints, friction, v, w), Problem(joints, bodies, friction, p, v, w)
    if leaps:
        sweeps, left = leap_sweeps(problem, TOLERANCE, sweeps, MOST)
    elif carries:
        sweeps, left = momentum_sweeps(problem, TOLERANCE, sweeps, MOST)
    while left > TOLERANCE and sweeps < MOST:
        sweep(p, joints, bodies, friction, v, w)
        left, sweeps = residual(p, joints, friction, v, w), sweeps + 1
    return sweeps, left, p


solve: Any = numba.njit(
    _solved
)  # not cached on disk, where it would outlive the functions it calls


@pytest.mark.parametrize(("height", "mu"), [(6, 0.5), (8, 0.5), (8, 0.05)])
def test_momentum_reaches_the_plain_sweeps_answer_in_fewer(height: int, mu: float) -> None:
    joints, bodies, friction, falls = pile(height, mu)
    plain, ahead = falls.copy(), falls.copy()
    slow, left, _ = solve(joints, bodies, friction, plain, False)
    fast, beyond, _ = solve(joints, bodies, friction, ahead, True)
    assert max(left, beyond) <= TOLERANCE
    assert np.abs(ahead - plain).max() <= 30 * TOLERANCE
    assert fast <= slow / 8


def test_a_pile_that_slides_gains_what_friction_gives() -> None:
    joints, bodies, friction, v = pile(8, 0.05)
    solve(joints, bodies, friction, v, True)
    assert np.abs(v[:-1] - [0.05 * STEP, 0.0, 0.0]).max() <= 100 * TOLERANCE


@pytest.mark.parametrize("leaps", [False, True])
def test_velocities_are_those_of_the_impulses(leaps: bool) -> None:
    joints, bodies, friction, falls = pile(40 if leaps else 6, 0.5)
    v = falls.copy()
    sweeps, left, p = solve(joints, bodies, friction, v, True, leaps)
    assert left <= TOLERANCE
    assert sweeps > 700 * leaps  # so that some are leaps
    made = falls.copy()
    np.add.at(made, joints.second, p)
    np.add.at(made[:-1], joints.first[4:], -p[4:])
    assert np.abs(v - made).max() <= 1e-12


def _at_most(problem: Problem, most: int) -> int:
    return int(leap_sweeps(problem, 0.0, 0, most)[0])


@pytest.mark.parametrize("most", [500, 650, 850, 1000])
def test_sweeps_with_leaps_are_no_more_than_allowed(most: int) -> None:
    """600 before the first look, then 200 and 100 in turn: each part is cut where it must be."""
    joints, bodies, friction, v = pile(40, 0.5)
    nil = np.zeros_like(joints.normal), np.zeros_like(v)
    kernel: Any = numba.njit(_at_most)
    assert kernel(Problem(joints, bodies, friction, nil[0], v, nil[1]), most) == most


def _halfway(joints: Joints, before: Index, began: Joints) -> tuple[Vector, Vector, Vector, Vector]:
    """Normals and both arms at mid-step, and how far normals turn from there."""
    middle, turn = halfway(joints, before, began)
    return middle.normal, middle.arm_first, middle.arm_second, turn


def test_at_mid_step_arms_are_means_and_normals_are_turned_back_by_half() -> None:
    """One contact whose normal has turned by 0.02, and seven that are new."""
    (joints, *_), (began, *_) = pile(2, 0.5), pile(2, 0.5)
    turn = 0.02
    joints.normal[0] = [np.sin(turn), 0.0, np.cos(turn)]
    joints.arm_first[:] += [0.3, 0.0, 0.1]
    joints.arm_second[:] -= [0.0, 0.2, 0.4]
    kernel: Any = numba.njit(_halfway)
    normal, one, two, turned = kernel(joints, np.array([0, *7 * [-1]]), began)
    assert turned[0] == pytest.approx([0.0, 0.5 * np.sin(turn), 0.0])
    assert normal[0] == pytest.approx([np.sin(turn / 2), 0.0, np.cos(turn / 2)], abs=1e-4)
    assert one[0] == pytest.approx(began.arm_first[0] + [0.15, 0.0, 0.05])
    assert two[0] == pytest.approx(began.arm_second[0] - [0.0, 0.1, 0.2])
    assert not turned[1:].any()
    assert (normal[1:] == joints.normal[1:]).all()
    assert (one[1:] == joints.arm_first[1:]).all()


class Arms(NamedTuple):
    """Of a trial only its joints: at the end of the step, and at mid-step."""

    joints: Joints
    middle: Joints


def _covariance(arms: Any, gained: Vector) -> Any:
    return arm_covariance(arms, 4, gained)


def test_the_mean_of_spin_times_arm_is_more_than_the_product_of_means_by_both_bodies() -> None:
    """Contact 4 is between two cubes; a mean is that of the values at both ends of the step."""
    (ends, *_), (begins, *_) = pile(2, 0.5), pile(2, 0.5)
    ends.arm_first[4] += [0.3, -0.1, 0.1]
    ends.arm_second[4] += [0.0, 0.2, -0.5]
    middle = ends._replace(
        arm_first=0.5 * (ends.arm_first + begins.arm_first),
        arm_second=0.5 * (ends.arm_second + begins.arm_second),
    )
    spins = np.array([[[1.0, 2.0, -1.0], [0.5, -3.0, 0.0]], [[2.0, 0.0, 3.0], [-1.0, 1.0, 4.0]]])
    moves = [
        np.cross(w[1], joints.arm_second[4]) - np.cross(w[0], joints.arm_first[4])
        for w, joints in zip(spins, (begins, ends), strict=True)
    ]
    w = spins.mean(axis=0)
    product = np.cross(w[1], middle.arm_second[4]) - np.cross(w[0], middle.arm_first[4])
    kernel: Any = numba.njit(_covariance)
    found = kernel(Arms(ends, middle), 0.5 * (spins[1] - spins[0]))
    assert found == pytest.approx(np.mean(moves, axis=0) - product)
