"""Claims about impulses that act at mid-step, and about works and forces of a trial."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from tests.engines.rigid.by_hand.solver.test_joints import jacobian, mobility, scattered
from tests.engines.rigid.by_hand.test_free_motion import BASE, OTHER, begun, rate
from vv.engines.rigid.general.energy import add_work, add_works, arm_covariance
from vv.engines.rigid.general.kernel import add_impulses, fill_forces, remove_penetration
from vv.engines.rigid.general.lever_arms import act_at_midstep, difference, halfway, turned_back
from vv.engines.rigid.general.setting import copy_of, shift_at
from vv.engines.rigid.solver.assembly import Bodies, Joints
from vv.engines.rigid.solver.problem import Problem
from vv.scene import Vector

pytestmark = pytest.mark.usefixtures("in_python")
NOW, SPAN = 0.07, 0.013  # s


def test_arms_and_normals_at_mid_step_are_means_of_those_of_old_contacts() -> None:
    joints, _ = scattered(1)
    began, _ = scattered(2)
    before = np.array([3, -1, 0, 5, -1, 2])
    middle, turn = halfway(joints, before, began)
    for c, row in enumerate(before):
        half = 0.5 * np.cross(began.normal[row], joints.normal[c]) if row >= 0 else np.zeros(3)
        assert turn[c] == pytest.approx(half)
        assert middle.normal[c] == pytest.approx(
            joints.normal[c] - np.cross(half, joints.normal[c])
        )
        for name in ("arm_first", "arm_second"):
            end = getattr(joints, name)[c]
            due = 0.5 * (end + getattr(began, name)[row]) if row >= 0 else end
            assert getattr(middle, name)[c] == pytest.approx(due)
    for name in ("first", "second", "pull", "across", "along"):
        assert getattr(middle, name) is getattr(joints, name)


def effect(joints: Joints, bodies: Any, c: int, p: Vector) -> Vector:
    """The change of all velocities and spins (2, 4, 3) by an impulse."""
    return np.asarray(mobility(bodies) @ jacobian(joints, c).T @ p).reshape(2, 4, 3)


def test_impulses_are_moved_from_the_end_to_mid_step() -> None:
    joints, bodies = scattered(1)
    middle, _ = scattered(2)
    middle = middle._replace(first=joints.first, second=joints.second)
    random = np.random.default_rng(3)
    p, acted, turn = random.normal(size=(3, 6, 3))
    acted[4] = p[4]
    v, w = random.normal(size=(2, 4, 3))
    due, worst = np.array([v, w]), 0.0
    for c in range(6):
        change = p[c] - acted[c]
        back = change - np.cross(turn[c], change)
        assert turned_back(turn, c, tuple(change)) == pytest.approx(back)
        moved = effect(middle, bodies, c, back) - effect(joints, bodies, c, change)
        due += moved
        ends = ((joints.first[c], joints.arm_first[c]), (joints.second[c], joints.arm_second[c]))
        for body, arm in ends:
            at_arm = moved[0, body] + np.cross(moved[1, body], arm)
            worst = max(worst, float(np.linalg.norm(at_arm)))
    friction: Any = None
    problem = Problem(joints, bodies, friction, p, v, w)
    found = act_at_midstep(problem, acted, middle, turn)
    assert found == pytest.approx(worst)
    assert v == pytest.approx(due[0])
    assert w == pytest.approx(due[1])
    assert acted.tolist() == p.tolist()
    assert act_at_midstep(problem, acted, middle, turn) == 0.0


def test_motions_of_a_body_differ_by_the_velocity_at_an_arm() -> None:
    a, b, c, d, arm = np.random.default_rng(4).normal(size=(5, 3))
    due = np.linalg.norm(b - a + np.cross(d - c, arm))
    given: Any = (tuple(x) for x in (a, b, c, d, arm))
    assert difference(*given) == pytest.approx(due)


def test_the_work_of_an_impulse_is_lost_by_friction_impact_or_done_by_the_base() -> None:
    """An impulse at a wall, body 3, and one between blocks; `apart` corrects the velocity."""
    joints, _ = scattered(5)
    v, w = np.random.default_rng(5).normal(size=(2, 4, 3))
    p, apart = np.array([0.3, -2.0, 1.1]), np.array([0.4, 0.2, -0.6])
    for c, wall in ((1, True), (2, False)):
        account = np.arange(7.0)
        add_work(account, joints, c, tuple(p), v, w, 3, tuple(apart))
        u = jacobian(joints, c) @ np.concatenate([v.ravel(), w.ravel()]) + apart
        n = joints.normal[c]
        hit, whole = (p @ n) * (u @ n), p @ u
        base = p @ v[3] if wall else 0.0
        assert account == pytest.approx(
            [0 - (whole - hit), 1 - hit, 2 + base, 3, 4, 5, 6 + p @ apart]
        )


def a_trial() -> Any:
    """A trial of the scene of two blocks and three walls, with four contacts at any place."""
    random = np.random.default_rng(6)
    first, second = np.array([2, 0, 4, 3]), np.array([0, 1, 1, 0])

    def joints() -> Any:
        normal, one, two = random.normal(size=(3, 4, 3))
        normal /= np.linalg.norm(normal, axis=1, keepdims=True)
        return Joints(first, second, normal, one, two, normal, np.ones(4), np.ones(4))

    p, acted, turn = random.normal(size=(3, 4, 3)) * [[[1]], [[1]], [[0.1]]]
    v, w = random.normal(size=(2, 5, 3))
    w[2:] = 0.0
    return SimpleNamespace(joints=joints(), middle=joints(), turn=turn, p=p, acted=acted, v=v, w=w)


def at_contact(joints: Joints, c: int, v: Vector, w: Vector) -> Vector:
    """The relative velocity at a contact."""
    a, b = joints.first[c], joints.second[c]
    two = v[b] + np.cross(w[b], joints.arm_second[c])
    return np.asarray(two - v[a] - np.cross(w[a], joints.arm_first[c]))


@pytest.mark.parametrize("impact", [True, False])
def test_works_of_a_step_are_those_at_mean_velocities(impact: bool) -> None:
    setting, state, made = begun()
    trial: Any = a_trial()
    account = np.arange(1.0, 8.0)
    due = account.copy()
    add_works(account, setting, state, trial, NOW, SPAN, impact)
    walls = np.array([rate(BASE, NOW), np.zeros(3), rate(OTHER, NOW)])
    v = 0.5 * (np.vstack([state.v, walls]) + trial.v)
    w = 0.5 * (np.vstack([state.w, np.zeros((3, 3))]) + trial.w)
    gained = trial.w - w
    for c in range(4):
        a, b = trial.joints.first[c], trial.joints.second[c]
        one = trial.joints.arm_first[c] - trial.middle.arm_first[c]
        two = trial.joints.arm_second[c] - trial.middle.arm_second[c]
        apart = np.cross(gained[b], two) - np.cross(gained[a], one)
        assert arm_covariance(trial, c, gained) == pytest.approx(apart)
        early = trial.acted[c] - np.cross(trial.turn[c], trial.acted[c])
        late = trial.p[c] - trial.acted[c]
        for joints, p, more in ((trial.middle, early, apart), (trial.joints, late, 0.0 * apart)):
            n, u = joints.normal[c], at_contact(joints, c, v, w) + more
            normal = (p @ n) * (u @ n)
            due[0] -= 0.0 if impact else p @ u - normal
            due[1] -= p @ u if impact else normal
            due[2] += p @ v[a] if a >= 2 else 0.0
            due[6] += p @ more
    omega = 2 * np.pi * made.shaking.frequency  # type: ignore[union-attr]
    t = NOW + SPAN * (np.arange(4000) + 0.5) / 4000
    shake = np.array([np.mean(a * np.sin(o * t + p)) for a, o, p in
                      zip(made.shaking.amplitude, omega, made.shaking.phase, strict=True)])  # type: ignore[union-attr]  # fmt: skip
    for k in range(2):
        due[3] += SPAN * made.blocks[k].mass * shake @ v[k]
        due[4] += SPAN * setting.force[k] @ v[k]
    assert account == pytest.approx(due, rel=1e-6)
    impulses = np.ones((5, 3))
    add_impulses(impulses, setting, trial, NOW, SPAN)
    borne = np.ones((5, 3))
    for k in range(2):
        borne[k] += SPAN * made.blocks[k].mass * shake
    for c in range(4):
        p = trial.p[c] - np.cross(trial.turn[c], trial.acted[c])
        borne[trial.joints.second[c]] += p
        borne[trial.joints.first[c]] -= p
    assert impulses == pytest.approx(borne, rel=1e-6)
    force = np.full((5, 3), 9.0)
    fill_forces(force, setting, trial, NOW, SPAN)
    assert force == pytest.approx((borne - 1.0) / SPAN, rel=1e-6, abs=1e-6)


@pytest.mark.parametrize("deep", [-0.5, 0.5, 2.0])
def test_penetration_is_removed_from_places_and_its_work_is_told(deep: float) -> None:
    """Of one contact with a wall that moves; deep is in units of the slack."""
    setting, state, _ = begun()
    setting = setting._replace(slack=1e-6)
    before = copy_of(state)
    trial: Any = a_trial()
    random = np.random.default_rng(7)
    state.centre[:] += 1e-3 * random.normal(size=(2, 3))
    spins = np.zeros((5, 3, 3))
    spins[:2] = [np.diag([1.0, 2.0, 3.0]), np.eye(3)]
    trial.bodies = Bodies(setting.inverse, spins, np.zeros((5, 3)))
    n, arm = trial.joints.normal[0], trial.joints.arm_second[0]
    turn = np.cross(arm, n)
    trial.joints.across[0] = n @ setting.inverse[0] @ n + turn @ spins[0] @ turn
    moved = np.vstack(
        [state.centre - before.centre, shift_at(setting, NOW + SPAN) - shift_at(setting, NOW)]
    )
    turns = np.zeros((5, 3))
    turns[:2] = 0.5 * SPAN * (before.w + trial.w[:2])
    ways = [trial.joints.normal[c] @ at_contact(trial.joints, c, moved, turns) for c in range(4)]
    depths = np.array([deep, -3.0, -4.0, -5.0]) * setting.slack
    trial.gaps = SimpleNamespace(gap=-depths - ways)
    account, start = np.zeros(7), copy_of(state)
    found = remove_penetration(account, setting, state, trial, before, NOW, SPAN)
    assert found == pytest.approx(max(deep, 0.0) * setting.slack, abs=1e-15)
    shoved = state.centre - start.centre
    assert state.moved - start.moved == pytest.approx(shoved, abs=1e-15)
    work = (setting.force * shoved).sum()
    assert account == pytest.approx([0, 0, 0, 0, work, work, 0], rel=1e-6)
    assert shoved.any() == (deep > 1.0)
    if deep > 1.0:
        size = deep * setting.slack / trial.joints.across[0]
        assert shoved[0] == pytest.approx(setting.inverse[0] @ n * size)
        step = state.rotation[0] @ start.rotation[0].T - np.eye(3)
        spun = spins[0] @ turn * size
        assert [step[2, 1], step[0, 2], step[1, 0]] == pytest.approx(spun, rel=1e-3)
        assert not shoved[1].any()
