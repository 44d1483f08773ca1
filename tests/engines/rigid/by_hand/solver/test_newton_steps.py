"""Claims about the parts of a Newton step of `rigid`: its matrix is what it is said to be."""

from __future__ import annotations

from typing import Any

import numba
import numpy as np
import pytest

from tests.engines.rigid.test_momentum import pile
from vv.engines.rigid.solver.assembly import Bodies, Joints
from vv.engines.rigid.solver.augmented import projected_impulse
from vv.engines.rigid.solver.newton import add_stiffness, longest_arms
from vv.engines.rigid.solver.problem import Friction
from vv.scene import Vector

STIFF, MU = 1e3, 0.4
ASKEW = np.array([[3.0, 1.0, -1.0], [0.5, 2.0, 0.7], [0.2, -0.3, 4.0]])  # unlike its transpose


def _projected(joints: Joints, friction: Friction, q: Vector, u: Vector) -> tuple[Vector, Vector]:
    slope, p = np.empty((3, 3)), np.empty(3)
    one, two = (q[0], q[1], q[2]), (u[0], u[1], u[2])
    p[0], p[1], p[2] = projected_impulse(joints, 0, friction, STIFF, one, two, slope)
    return p, slope


projected: Any = numba.njit(_projected)


@pytest.mark.parametrize("way", ["sticks", "slips", "slips on", "parts"])
def test_the_slope_of_a_projected_impulse_is_its_derivative(way: str) -> None:
    """By differences of 1e-6 m/s; an impulse that slides on has a mean direction of slip."""
    joints, _, friction, _ = pile(1, MU)
    d, turn = np.zeros((4, 3)), np.zeros((4, 3))
    if way == "slips on":
        d[0], turn[0] = [0.6, 0.8, 0.0], [0.05, -0.02, 0.0]
    friction = friction._replace(need=np.full(4, 1e-3), d=d, turn=turn)
    q = np.array([0.1, -0.2, 2.0])
    u = np.array([2e-4, -1e-4, -5e-3]) * {"parts": -4.0}.get(way, 1.0)
    if way.startswith("slips"):
        u[:2] = -4e-2, 3e-2
    p, slope = projected(joints, friction, q, u)
    assert (p == 0.0).all() == (way == "parts")
    if way == "sticks":
        stiff = STIFF / np.array([joints.along[0], joints.along[0], joints.across[0]])
        assert p == pytest.approx(q - stiff * (u - [0.0, 0.0, 1e-3]))
    step = 1e-6
    by_differences = [
        (projected(joints, friction, q, u - e)[0] - projected(joints, friction, q, u + e)[0])
        / (2 * step)
        for e in step * np.eye(3)
    ]
    assert slope == pytest.approx(np.transpose(by_differences), rel=1e-6, abs=1e-4)


def _added(
    joints: Joints, bodies: Bodies, slope: Vector, lever: Vector, rows_of: Any, half: int
) -> Vector:
    matrix = np.zeros((12, 3 * half + 1))
    add_stiffness(matrix, joints, 5, bodies, rows_of, half, slope, lever)
    return matrix


def motions(joints: Joints, c: int, lever: Vector) -> Vector:
    """J (3, 12): relative velocities at a contact per velocity, and per spin times its lever."""
    found = np.zeros((3, 12))
    for body, sign, arm in (
        (joints.first[c], -1.0, joints.arm_first[c]),
        (joints.second[c], 1.0, joints.arm_second[c]),
    ):
        for k in range(3):
            found[k, 6 * body + k] = sign
            found[:, 6 * body + 3 + k] = sign * np.cross(np.eye(3)[k], arm) / lever[body]
    return found


def test_the_matrix_of_a_contact_is_the_motion_by_the_impulse_by_the_motion() -> None:
    """W J^T S J of contact 5 between two cubes, in a band that holds all of it."""
    joints, bodies, *_ = pile(2, MU)
    joints.arm_first[5] += [0.02, -0.05, 0.01]
    bodies.inverse[1] *= 0.5
    bodies.inverse_spin[0] *= 0.3
    lever, half = np.array([0.7, 1.3]), 11
    band = np.asarray(numba.njit(_added)(joints, bodies, ASKEW, lever, np.arange(12), half))
    full = np.array([[band[i, j - i + half] for j in range(12)] for i in range(12)])
    j = motions(joints, 5, lever)
    w = np.zeros((12, 12))
    for i in range(2):
        w[6 * i : 6 * i + 3, 6 * i : 6 * i + 3] = bodies.inverse[i]
        spins = slice(6 * i + 3, 6 * i + 6)
        w[spins, spins] = lever[i] ** 2 * bodies.inverse_spin[i]
    assert full == pytest.approx(w @ j.T @ ASKEW @ j, abs=1e-13)


def _longest(joints: Joints) -> Vector:
    return longest_arms(joints, 3)


def test_the_lever_of_a_block_is_its_longest_arm_or_one_metre() -> None:
    joints, *_ = pile(2, MU)
    joints.arm_second[3] = [1.0, -2.0, 2.0]
    joints.arm_first[6] = [0.0, 3.0, 4.0]
    joints.arm_second[7] = [2.0, 3.0, -6.0]
    joints.first[:4] = 5  # the floor
    kernel: Any = numba.njit(_longest)
    assert kernel(joints) == pytest.approx([5.0, 7.0, 1.0])
