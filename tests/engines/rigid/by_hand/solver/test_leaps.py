"""Claims about leaps along the drift of impulses: each one, and when they are made, by script."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from tests.engines.rigid.by_hand.solver.test_joints import jacobian, mobility, scattered
from tests.engines.rigid.by_hand.solver.test_sweeps import MU, disc, nearest, rubbing
from vv.engines.rigid.solver import drift
from vv.engines.rigid.solver.drift import (
    AHEAD,
    CARRIED,
    LONGER,
    SETTLED,
    SHORTER,
    WATCHED,
    WORSE,
    leap,
    leap_sweeps,
)
from vv.engines.rigid.solver.problem import Problem
from vv.scene import Vector

pytestmark = pytest.mark.usefixtures("in_python")
ASKED = 1e-6  # m/s


@pytest.mark.parametrize("seed", range(3))
def test_a_leap_extrapolates_impulses_within_friction(seed: int) -> None:
    joints, bodies = scattered(seed)
    friction, random = rubbing(seed), np.random.default_rng(seed)
    p, before = random.normal(size=(2, 6, 3)) + joints.normal
    joints.across[5], p[1] = 0.0, -joints.normal[1]
    v, w = random.normal(size=(2, 4, 3))
    both, due = np.concatenate([v.ravel(), w.ravel()]), p.copy()
    for c in range(5):
        n, on = joints.normal[c], p[c] + 1.7 * (p[c] - before[c])
        normal = max(on @ n, 0.0)
        limits = disc(MU * normal, friction.d[c], friction.turn[c])
        due[c] = (nearest(on - on @ n * n, *limits) + normal * n) if normal else 0.0
        both = both + mobility(bodies) @ jacobian(joints, c).T @ (due[c] - p[c])
    leap(Problem(joints, bodies, friction, p, v, w), before, 1.7)
    assert p == pytest.approx(due)
    assert np.concatenate([v.ravel(), w.ravel()]) == pytest.approx(both)
    assert not due[1].any()


def leapt(
    monkeypatch: pytest.MonkeyPatch, left: list[float], most: int
) -> tuple[list[int], list[float], tuple[int, float], float]:
    """Sweeps that leave given residuals, leaps between them, the result and the impulse."""
    few: list[int] = []
    ahead: list[float] = []
    rest = iter(left)

    def swept(problem: Problem, *given: Any) -> tuple[int, float]:
        few.append(given[-1])
        problem.p[:] += 1.0
        return given[-1], next(rest)

    def jumped(problem: Problem, before: Vector, far: float) -> None:
        ahead.append(far * float(problem.p[0, 0] - before[0, 0]))
        problem.p[:] += 1000.0

    monkeypatch.setattr(drift, "momentum_sweeps", swept)
    monkeypatch.setattr(drift, "leap", jumped)
    p, v = np.zeros((2, 3)), np.zeros((2, 3))
    nothing: Any = None
    found = leap_sweeps(Problem(nothing, nothing, nothing, p, v, v.copy()), ASKED, 0, most)
    return few, ahead, found, float(p[0, 0])


def test_leaps_grow_after_good_ones_and_are_undone_and_shrink_after_bad_ones(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The first and the third leap help, the second makes it worse than WORSE times the least."""
    bad = 1.01 * WORSE * 0.6
    few, ahead, found, p = leapt(
        monkeypatch, [1.0, 0.8, 0.7, 0.6, bad, 0.5, 0.4, 0.1 * ASKED], 9999
    )
    assert few == [CARRIED, *[WATCHED, SETTLED] * 3, WATCHED]
    assert ahead == pytest.approx([AHEAD, LONGER * AHEAD, SHORTER * LONGER * AHEAD])
    assert found == (CARRIED + 3 * (WATCHED + SETTLED) + WATCHED, 0.1 * ASKED)
    assert p == 2.0 * 1000.0 + 1.0 + 2.0 + 1.0 + 2.0 + 1.0


def test_leaps_end_with_the_sweeps_allowed(monkeypatch: pytest.MonkeyPatch) -> None:
    few, _, found, _ = leapt(monkeypatch, [1.0] * 99, CARRIED + WATCHED + 30)
    assert (few, found) == ([CARRIED, WATCHED, 30], (CARRIED + WATCHED + 30, 1.0))
    few, _, found, _ = leapt(monkeypatch, [0.5 * ASKED], 100)
    assert (few, found) == ([100], (100, 0.5 * ASKED))
