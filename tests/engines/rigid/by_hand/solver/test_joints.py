"""Claims about the matrices of contacts: J, its transpose and its response, against numpy."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from vv.engines.blocks.contacts import Contacts
from vv.engines.rigid.solver.assembly import (
    MOBILE,
    Bodies,
    Joints,
    apply,
    apply_nonzero,
    assemble,
    local_response,
    relative,
    tangents,
    times,
)
from vv.scene import Vector

pytestmark = pytest.mark.usefixtures("in_python")
BLOCKS = 3  # and a wall after them


def spd(random: Any, n: int) -> Vector:
    """So many symmetric positive matrices (n, 3, 3)."""
    roots = random.normal(size=(n, 3, 3))
    return np.asarray(roots @ roots.transpose(0, 2, 1) + 0.3 * np.eye(3))


def scattered(seed: int, count: int = 6) -> tuple[Joints, Bodies]:
    """Contacts among three blocks of any inertia and a wall, at any place with any normal."""
    random = np.random.default_rng(seed)
    inverse, spins = spd(random, BLOCKS + 1), spd(random, BLOCKS + 1)
    inverse[BLOCKS] = spins[BLOCKS] = 0.0
    centre = np.vstack([random.normal(size=(BLOCKS, 3)), np.zeros(3)])
    bodies = Bodies(inverse, spins, centre)
    normal = random.normal(size=(count + 2, 3))
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    pairs = np.array([(0, 1), (3, 2), (1, 2), (3, 0), (0, 2), (3, 1), (0, 1), (0, 1)])
    empty = np.zeros(count + 2)
    found = Contacts(
        pairs[:, 0].copy(), pairs[:, 1].copy(), random.normal(size=(count + 2, 3)), normal,
        empty, empty, np.arange(count + 2),
    )  # fmt: skip
    return assemble(found, count, bodies), bodies


def jacobian(joints: Joints, c: int) -> Vector:
    """J (3, 6 b) of a contact, for all velocities and then all spins."""
    found = np.zeros((2, BLOCKS + 1, 3, 3))
    for body, sign, arm in (
        (joints.first[c], -1.0, joints.arm_first[c]), (joints.second[c], 1.0, joints.arm_second[c])
    ):  # fmt: skip
        found[0, body] = sign * np.eye(3)
        found[1, body] = sign * np.cross(np.eye(3), arm).T
    return np.concatenate([*found[0], *found[1]], axis=1)


def mobility(bodies: Bodies) -> Vector:
    """W (6 b, 6 b)."""
    blocks = [*bodies.inverse, *bodies.inverse_spin]
    full = np.zeros((3 * len(blocks), 3 * len(blocks)))
    for k, block in enumerate(blocks):
        full[3 * k : 3 * k + 3, 3 * k : 3 * k + 3] = block
    return full


@pytest.mark.parametrize("seed", range(3))
def test_joints_have_their_arms_and_their_mobilities(seed: int) -> None:
    joints, bodies = scattered(seed)
    assert len(joints.across) == 6
    for c in range(6):
        response = jacobian(joints, c) @ mobility(bodies) @ jacobian(joints, c).T
        n = joints.normal[c]
        flat = np.linalg.svd(n[None])[2][1:]
        assert joints.pull[c] == pytest.approx(response @ n)
        assert joints.across[c] == pytest.approx(n @ response @ n)
        assert joints.along[c] == pytest.approx(np.linalg.eigvalsh(flat @ response @ flat.T)[-1])
        arm = joints.arm_first[c] + bodies.centre[joints.first[c]]
        assert arm == pytest.approx(joints.arm_second[c] + bodies.centre[joints.second[c]])


@pytest.mark.parametrize("seed", range(3))
def test_impulses_and_velocities_are_those_of_the_matrix(seed: int) -> None:
    joints, bodies = scattered(seed)
    random = np.random.default_rng(seed)
    for c in range(6):
        v, w, p = (random.normal(size=(4, 3)) for _ in range(3))
        both = np.concatenate([v.ravel(), w.ravel()])
        j, one = jacobian(joints, c), tuple(p[0])
        assert relative(joints, c, v, w) == pytest.approx(j @ both)
        assert local_response(joints, c, bodies, one) == pytest.approx(
            j @ mobility(bodies) @ j.T @ p[0]
        )
        due = both + mobility(bodies) @ j.T @ p[0]
        for act in (apply, apply_nonzero):
            one_v, one_w = v.copy(), w.copy()
            act(joints, c, bodies, one_v, one_w, one)
            assert np.concatenate([one_v.ravel(), one_w.ravel()]) == pytest.approx(due)
        apply_nonzero(joints, c, bodies, v, w, (0.0, 0.0, 0.0))
        assert np.concatenate([v.ravel(), w.ravel()]).tolist() == both.tolist()


def test_a_matrix_of_several_times_a_vector_is_that_of_numpy() -> None:
    many = np.arange(18.0).reshape(2, 3, 3) ** 1.5
    assert times(many, 1, (0.3, -2.0, 5.0)) == pytest.approx(many[1] @ [0.3, -2.0, 5.0])


@pytest.mark.parametrize("n", [(1.0, 0, 0), (0.6, 0.0, 0.8), (-0.8, 0.6, 0.0), (0.5, 0.1, -0.86)])
def test_tangents_are_unit_and_perpendicular(n: Any) -> None:
    n = np.array(n) / np.linalg.norm(n)
    frame = np.array([*tangents(tuple(n)), n])
    assert frame @ frame.T == pytest.approx(np.eye(3), abs=1e-14)
    assert np.linalg.det(frame) == pytest.approx(1.0)


@pytest.mark.parametrize(("part", "moves"), [(0.9, False), (1.1, True)])
@pytest.mark.parametrize("light", [1.0, 1e-6])
def test_a_direction_much_less_mobile_than_the_other_is_locked(
    part: float, moves: bool, light: float
) -> None:
    """Of a block that cannot turn: along the normal of a wall, or in all of its plane."""
    none, nil = np.zeros((2, 3, 3)), np.zeros(1)
    found = Contacts(np.array([1]), np.array([0]), np.zeros((1, 3)), np.array([[0.0, 0.0, 1.0]]),
                     nil, nil, np.zeros(1, int))  # fmt: skip
    for spans, locked, free in (
        ([1.0, 1.0, part * MOBILE], "across", "along"),
        ([part * MOBILE, part * MOBILE, 1.0], "along", "across"),
    ):
        inverse = np.array([np.diag(light * np.array(spans)), none[1]])
        joints = assemble(found, 1, Bodies(inverse, none, np.zeros((2, 3))))
        assert getattr(joints, free)[0] == pytest.approx(light)
        assert (getattr(joints, locked)[0] > 0.0) == moves
