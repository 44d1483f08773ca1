"""Claims about sweeps over contacts: each step, what is left, and how they go on."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from tests.engines.rigid.by_hand.solver.test_joints import jacobian, mobility, scattered
from vv.engines.rigid.solver.cone import (
    change_of,
    follow_direction,
    limit,
    normal_mobility,
    projected,
    push_out,
    residual,
    solve_contacts,
    sweep,
)
from vv.engines.rigid.solver.problem import Friction, Problem
from vv.scene import Vector

pytestmark = pytest.mark.usefixtures("in_python")
MU = 0.6


def rubbing(seed: int, slides: bool = True) -> Friction:
    """Friction of six contacts, every second of which slides at the start of the step."""
    random = np.random.default_rng(seed)
    d, turn = random.normal(size=(2, 6, 3))
    d /= np.linalg.norm(d, axis=1, keepdims=True)
    there = (np.arange(6) % 2 == 0)[:, None] * slides
    return Friction(MU, random.normal(size=6), d * there, 0.1 * turn * there)


def disc(cap: float, d: Vector, turn: Vector) -> tuple[Vector, float]:
    """Centre and radius of the tangential impulses."""
    return (-cap * (0.5 * d + turn), 0.5 * cap) if d.any() else (np.zeros(3), cap)


def nearest(flat: Vector, centre: Vector, radius: float) -> Vector:
    """The point of a disc that is nearest."""
    off = flat - centre
    return np.asarray(centre + off * min(1.0, radius / max(float(np.linalg.norm(off)), 1e-300)))


@pytest.mark.parametrize("slides", [True, False])
def test_tangential_impulses_lie_in_a_disc_that_slip_shifts(slides: bool) -> None:
    friction = rubbing(1, slides)
    d, turn = friction.d[0], friction.turn[0]
    centre, radius = limit(3.0, tuple(d), tuple(turn))
    due = disc(3.0, d, turn)
    assert centre == pytest.approx(due[0])
    assert radius == due[1]


@pytest.mark.parametrize("along", [0.0, 0.4])
@pytest.mark.parametrize("seed", range(5))
def test_a_projected_step_goes_against_slip_into_the_disc(seed: int, along: float) -> None:
    random = np.random.default_rng(seed)
    n, u, p = random.normal(size=(3, 3))
    n /= np.linalg.norm(n)
    d, turn = rubbing(seed).d[seed % 2], rubbing(seed).turn[seed % 2]
    flat = p - p @ n * n
    if along:
        flat = flat - (u - u @ n * n) / along
    cap = random.uniform(0.2, 6.0)
    due = nearest(flat, *disc(cap, d, turn))
    given: Any = (along, *(tuple(a) for a in (n, u, p)), cap, tuple(d), tuple(turn))
    assert projected(*given) == pytest.approx(due)


@pytest.mark.parametrize(("pull", "mu", "due"), [
    ((0.0, 0.0, 2.0), 9.0, 2.0), ((3.0, 4.0, 2.0), 0.39, 2.0), ((3.0, 4.0, 2.0), 0.41, 2.0 + 2.05),
])  # fmt: skip
def test_friction_that_lifts_more_than_the_normal_impulse_adds_to_mobility(
    pull: Any, mu: float, due: float
) -> None:
    assert normal_mobility(2.0, pull, mu) == pytest.approx(due)


def swept(joints: Any, bodies: Any, friction: Friction, p: Vector, both: Vector) -> Vector:
    """A sweep with the matrices of contacts, for velocities and spins in one; p is changed."""
    for c in range(len(p)):
        n, j = joints.normal[c], jacobian(joints, c)
        u, had = j @ both, p[c] @ n
        pull = joints.pull[c]
        lifts = MU * np.linalg.norm(pull - pull @ n * n)
        yields = joints.across[c] + (lifts if lifts > joints.across[c] else 0.0)
        normal = max(0.0, had - (u @ n - friction.need[c]) / yields)
        u = u + (normal - had) * pull
        flat = p[c] - had * n - (u - u @ n * n) / joints.along[c]
        rub = nearest(flat, *disc(MU * normal, friction.d[c], friction.turn[c]))
        change = rub + normal * n - p[c]
        both = both + mobility(bodies) @ j.T @ change
        p[c] += change
    return both


@pytest.mark.parametrize("seed", range(4))
def test_a_sweep_presses_each_contact_and_then_rubs_it(seed: int) -> None:
    joints, bodies = scattered(seed)
    friction, random = rubbing(seed), np.random.default_rng(seed)
    v, w = random.normal(size=(2, 4, 3))
    p = np.zeros((6, 3))
    due, both = p.copy(), np.concatenate([v.ravel(), w.ravel()])
    for _ in range(3):
        sweep(p, joints, bodies, friction, v, w)
        both = swept(joints, bodies, friction, due, both)
        assert p == pytest.approx(due, abs=1e-12)
        assert np.concatenate([v.ravel(), w.ravel()]) == pytest.approx(both, abs=1e-12)
    assert (p != 0.0).any(1).sum() >= 2
    locked = joints._replace(across=np.zeros(6))
    before = p.copy()
    sweep(p, locked, bodies, friction, v, w)
    assert p.tolist() == before.tolist()
    assert residual(p, locked, friction, v, w) == 0.0


@pytest.mark.parametrize("seed", range(6))
def test_the_residual_is_the_largest_change_by_a_projected_step(seed: int) -> None:
    """Of normal and tangential velocities, with impulses that press, pull or are zero."""
    joints, _ = scattered(seed)
    friction, random = rubbing(seed), np.random.default_rng(seed)
    v, w = 0.3 * random.normal(size=(2, 4, 3))
    p = np.where(np.arange(6)[:, None] % 3 > 0, random.normal(size=(6, 3)), 0.0)
    p += 2.0 * joints.normal * (p != 0.0)
    worst = []
    for c in range(6):
        n, u = joints.normal[c], jacobian(joints, c) @ np.concatenate([v.ravel(), w.ravel()])
        had = p[c] @ n
        normal = max(0.0, had - (u @ n - friction.need[c]) / joints.across[c])
        flat = p[c] - had * n
        step = flat - (u - u @ n * n) / joints.along[c]
        rub = nearest(step, *disc(MU * had, friction.d[c], friction.turn[c]))
        worst += [abs(normal - had) * joints.across[c],
                  float(np.linalg.norm(rub - flat)) * joints.along[c]]  # fmt: skip
    assert residual(p, joints, friction, v, w) == pytest.approx(max(worst))


def test_a_change_of_impulses_has_a_size_and_a_largest_effect() -> None:
    joints, _ = scattered(2)
    p, before = np.random.default_rng(2).normal(size=(2, 6, 3))
    sizes = np.linalg.norm(p - before, axis=1)
    size, largest = change_of(p, before, joints)
    assert size == pytest.approx((sizes**2).sum())
    assert largest == pytest.approx((sizes * np.maximum(joints.across, joints.along)).max())


@pytest.mark.parametrize("goes_on", [True, False])
def test_a_search_goes_on_along_its_direction_or_begins_anew(goes_on: bool) -> None:
    direction, before, now = np.random.default_rng(3).normal(size=(3, 4, 3))
    found, there = direction.copy(), now.copy()
    follow_direction(found, before, there, 0.3, goes_on)
    due = 0.3 * direction + now - before if goes_on else np.zeros((4, 3))
    assert found == pytest.approx(due)
    assert there == pytest.approx(now + 0.3 * direction * goes_on)


def test_penetration_is_removed_by_displacements_alone() -> None:
    joints, bodies = scattered(4)
    gap = np.array([-0.1, 0.3, -0.2, 0.05, -0.02, 9.0])
    x, turn = np.full((4, 3), 7.0), np.full((4, 3), 7.0)
    push_out(joints, bodies, gap, x, turn, 2000)
    both = np.concatenate([x.ravel(), turn.ravel()])
    left = np.array([gap[c] + joints.normal[c] @ jacobian(joints, c) @ both for c in range(6)])
    assert left.min() >= -1e-9
    normals = np.array([jacobian(joints, c).T @ joints.normal[c] for c in range(6)])
    pushes = np.linalg.lstsq((normals @ mobility(bodies)).T, both, rcond=None)[0]
    assert both == pytest.approx(pushes @ normals @ mobility(bodies))
    assert pushes.min() >= -1e-9
    assert abs(pushes * left).max() <= 1e-8
    push_out(joints._replace(across=np.zeros(6)), bodies, gap, x, turn, 3)
    assert not x.any()


@pytest.mark.parametrize("fewest", [0, 40])
def test_sweeps_go_on_until_the_residual_is_met_and_not_fewer(fewest: int) -> None:
    joints, bodies = scattered(5)
    friction, falls = rubbing(5, slides=False), np.random.default_rng(5).normal(size=(2, 4, 3))
    given: dict[int, Any] = {}
    for most in (3, 500):
        p, (v, w) = np.zeros((6, 3)), falls.copy()
        problem = Problem(joints, bodies, friction, p, v, w)
        sweeps, left = solve_contacts(problem, 1e-6, fewest, most)
        assert left == pytest.approx(residual(p, joints, friction, v, w))
        given[most] = sweeps, left
    assert given[3][0] == 3
    assert given[3][1] > 1e-6
    assert given[500][1] <= 1e-6
    assert max(fewest, 4) <= given[500][0] < 500
    assert solve_contacts(problem, 1e-5, 0, 9) == (0, given[500][1])
