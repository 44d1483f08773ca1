"""Claims about what follows sweeps that do not converge: rounds and starts anew, by script.

The solvers run as Python; sweeps and rounds are replaced by ones that leave given residuals.
"""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from tests.engines.rigid.by_hand.solver.test_joints import jacobian, mobility, scattered
from tests.engines.rigid.by_hand.solver.test_sweeps import rubbing
from vv.engines.rigid.general import converge, few, many
from vv.engines.rigid.limits import (
    BLURRED,
    CHAIN,
    FIRMEST,
    LONGEST,
    OUTER,
    PAUSE,
    SMALL,
    SOFT,
    SOFTEST,
)
from vv.engines.rigid.solver import rounds
from vv.engines.rigid.solver.cone import residual
from vv.engines.rigid.solver.problem import Problem
from vv.scene import Vector

pytestmark = pytest.mark.usefixtures("in_python")
ASKED, FINEST = 1e-6, 1e-13  # m/s


def test_velocities_are_parted_from_impulses_and_joined_with_them() -> None:
    joints, bodies = scattered(1)
    random = np.random.default_rng(1)
    p, (v, w) = random.normal(size=(6, 3)), random.normal(size=(2, 4, 3))
    p[2] = 0.0
    given = np.concatenate([v.ravel(), w.ravel()])
    effect = sum(mobility(bodies) @ jacobian(joints, c).T @ p[c] for c in range(6))
    free_v, free_w = few.velocities_without(Problem(joints, bodies, rubbing(1), p, v, w))
    assert np.concatenate([free_v.ravel(), free_w.ravel()]) == pytest.approx(given - effect)
    again_v, again_w = np.full((2, 4, 3), np.nan)
    left = few.recomputed(Problem(joints, bodies, rubbing(1), p, again_v, again_w), free_v, free_w)
    assert again_v == pytest.approx(v)
    assert again_w == pytest.approx(w)
    assert left == pytest.approx(residual(p, joints, rubbing(1), v, w))


class Rounds:
    """Newton rounds that leave given residuals; it records how stiff each is, and from where.

    One that does not converge is marked by a minus sign; others take five Newton steps.
    """

    def __init__(self, patch: pytest.MonkeyPatch, where: Any, left: list[float], at: float) -> None:
        self.stiff: list[float] = []
        self.begun: list[float] = []
        self._left, self._now = iter(left), at
        patch.setattr(where, "newton_round", self._round)
        patch.setattr(where, "residual", lambda *_: self._now)
        self.p = np.ones((2, 3))
        self.joints = SimpleNamespace(across=np.array([1.0, 3.0]))
        patch.setattr(where, "apply_changes", self._applied)
        self.v, self.w = np.zeros((2, 3)), np.zeros((2, 3))
        nothing: Any = None
        joints: Any = self.joints
        self.problem = Problem(joints, nothing, nothing, self.p, self.v, self.w)

    def _round(self, problem: Problem, q: Vector, *given: Any) -> int:
        p = problem.p
        self.stiff.append(given[1])
        self.begun.append(float(p[0, 0]))
        self._now = next(self._left)
        p += 1.0
        return 5 if self._now >= 0.0 else -int(given[-1])

    def _applied(self, problem: Problem, before: Vector, v: Vector, w: Vector) -> None:
        change = (problem.p - before)[:, 0].sum()
        v += change
        w -= change


def polished(told: Rounds, left: float, stiffness: float) -> float:
    """Polish from a residual."""
    nothing: Any = None
    return few.polish(told.problem, ASKED, left, nothing, stiffness)


def test_rounds_stiffen_while_they_help_and_are_undone_if_not(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Of five rounds the third makes it worse and the fourth does not converge."""
    told = Rounds(monkeypatch, few, [0.5, 0.4, 0.6, -1.0, 0.1 * ASKED, 9.0], 1.0)
    assert polished(told, 1.0, 1e5) == 0.1 * ASKED
    assert told.stiff == pytest.approx([1e5, 1e6, 1e7, 1e5, 1e3])
    assert told.begun == [1.0, 2.0, 3.0, 3.0, 3.0]
    assert (told.p == 4.0).all()
    assert (told.v == 6.0).all()
    assert (told.w == -6.0).all()


def test_rounds_end_where_contacts_are_soft_or_are_too_many(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    told = Rounds(monkeypatch, few, [2.0] * 9, 1.0)
    assert polished(told, 1.0, 100.0) == 1.0
    assert told.stiff == [100.0, 1.0]
    told = Rounds(monkeypatch, few, [1.0 / k for k in range(2, 99)], 1.0)
    assert polished(told, 1.0, 1.0) == 1.0 / (OUTER + 1)
    assert len(told.stiff) == OUTER
    told = Rounds(monkeypatch, few, [0.0], 1.0)
    assert polished(told, ASKED, 1.0) == ASKED
    assert not told.stiff


@pytest.mark.parametrize(("part", "kept"), [(1.9, True), (2.1, False)])
def test_a_round_that_adds_no_more_than_rounding_is_kept(
    monkeypatch: pytest.MonkeyPatch, part: float, kept: bool
) -> None:
    """Rounding is that of the velocity by the largest impulse, of 1e11 N s at 3 per kg."""
    rounding = BLURRED * 3.0 * np.sqrt(3.0) * 1e11
    told = Rounds(monkeypatch, few, [part * rounding], 0.5 * part * rounding)
    told.p[:] = 1e11
    monkeypatch.setattr(few, "OUTER", 1)
    found = polished(told, 0.5 * part * rounding, 10.0)
    assert found == pytest.approx(part * rounding if kept else 0.5 * part * rounding)


def rounded(told: Rounds) -> float:
    """Newton rounds that go on where the residual grows."""
    nothing: Any = None
    return rounds.newton_rounds(told.problem, ASKED, nothing, LONGEST)


def test_rounds_go_on_where_the_residual_grows_up_to_a_stiffness(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    told = Rounds(monkeypatch, rounds, [2.0, 3.0, -1.0, 2.0, 5.0, 4.0, 3.0, 3.0, 0.5 * ASKED], 1.0)
    assert rounded(told) == 0.5 * ASKED
    assert PAUSE == 2
    assert told.stiff == pytest.approx([SOFT, 100, 1e3, 100, 100, 1e3, FIRMEST, FIRMEST, FIRMEST])
    assert told.begun == [1.0, 2.0, 3.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0]
    assert (told.v == 16.0).all()


def test_rounds_that_never_converge_soften_until_they_are_given_up(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    told = Rounds(monkeypatch, rounds, [-1.0] * 99, 1.0)
    assert rounded(told) == 1.0
    assert told.stiff == pytest.approx([SOFT * 0.1**k for k in range(len(told.stiff))])
    assert SOFTEST <= told.stiff[-1] < 11.0 * SOFTEST
    told = Rounds(monkeypatch, rounds, [2.0, 0.5, *[3.0] * 999], 1.0)
    assert rounded(told) == 0.5
    assert len(told.stiff) == LONGEST // 5
    assert (told.p == 3.0).all()  # the best is kept
    assert (told.v == 4.0).all()
    assert (told.w == -4.0).all()


def test_rounds_wait_twice_as_long_after_each_failure_before_they_stiffen(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    told = Rounds(monkeypatch, rounds, [2.0, -1.0, *[2.0] * 3, -1.0, *[2.0] * 5, 0.0], 1.0)
    assert rounded(told) == 0.0
    assert told.stiff == pytest.approx([10, 100, 10, 10, 100, 1e3, *[100] * 4, 1e3, 1e4])


def told_by(
    monkeypatch: pytest.MonkeyPatch,
    apart: int,
    leaps: float,
    turns: float,
    rounds: list[float],
    first: float = 1.0,
    anew: float = 9.0,
) -> tuple[list[Any], tuple[int, float], Vector]:
    """What `solve_or_retry` tries, its result and impulses; each method adds to the impulses.

    leaps, turns, rounds: the residuals that they leave, and anew that of leaps from zero impulses;
    first: the part of the usual residual that is asked, below 1 in the first step.
    """
    said: list[Any] = []
    left = iter(rounds)

    def method(name: str, sweeps: int, more: float, *residuals: float) -> Any:
        each = iter(residuals)

        def solve(*given: Any) -> tuple[int, float]:
            said.append((name, float(given[1].p[0, 0])))
            given[1].p[:] += more
            return sweeps, next(each)

        return solve

    def newton(problem: Problem, *given: Any) -> float:
        said.append(("newton", float(problem.p[0, 0])))
        problem.p[:] += 100.0
        return next(left)

    def settle(problem: Problem, tolerance: float, _: Any) -> float:
        said.append(("settled", float(problem.p[0, 0])))
        return tolerance

    monkeypatch.setattr(many, "band_ordering", lambda *_: (None, apart))
    monkeypatch.setattr(many, "solve_with_leaps", method("leaps", 7, 1.0, leaps, anew))
    monkeypatch.setattr(many, "solve_in_turns", method("turns", 20, 10.0, turns))
    monkeypatch.setattr(many, "solve_chained", method("chained", 30, 1000.0, 9.0))
    monkeypatch.setattr(many, "velocities_without", lambda given: (given.v, given.w))
    monkeypatch.setattr(many, "recomputed", lambda *_: 0.0)
    monkeypatch.setattr(many, "newton_rounds", newton)
    monkeypatch.setattr(many, "settled", settle)
    limits = few.Limits(SMALL + 1, ASKED, 20_000, FINEST)
    p = np.full((2, 3), 0.5)
    nothing: Any = None
    problem = Problem(nothing, nothing, nothing, p, p.copy(), p.copy())
    result = many.solve_or_retry(limits, problem, 1, first * ASKED)
    return said, result, p


def test_the_first_step_of_many_blocks_is_solved_until_it_bears_their_weights(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    said, result, _ = told_by(monkeypatch, CHAIN + 1, GOOD, BAD, [], first=0.1)
    assert (said, result) == ([("leaps", 0.5), ("settled", 1.5)], (7, FINEST))


def test_a_chain_is_solved_as_one(monkeypatch: pytest.MonkeyPatch) -> None:
    said, result, _ = told_by(monkeypatch, CHAIN, 0.0, 9.0, [])
    assert (said, result) == ([("chained", 0.5)], (30, 9.0))


@pytest.mark.parametrize("blocks", [SMALL, SMALL + 1])
def test_contacts_of_many_blocks_are_solved_at_the_address_given(
    monkeypatch: pytest.MonkeyPatch, blocks: int
) -> None:
    def solve_many_at(address: int, left: Vector, limits: Any, *_: Any) -> int:
        left[0] = limits.most + address
        return int(limits.blocks)

    monkeypatch.setattr(converge, "solve_few", lambda limits, *_: (limits.blocks, limits.tolerance))
    monkeypatch.setattr(converge, "solve_many_at", solve_many_at)
    setting: Any = SimpleNamespace(
        mass=np.ones(blocks), tolerance=ASKED, most=40, solver=2, finest=0.0
    )
    nothing: Any = None
    found = converge.converged(setting, nothing, 0, ASKED)
    assert found == (blocks, ASKED if blocks <= SMALL else 42)


BAD, GOOD = 2.0 * ASKED, 0.9 * ASKED
WORSE = 2.0 * BAD
LATER = {  # residuals of leaps, of turns, of leaps from zero impulses and of rounds; methods tried
    "leaps": (GOOD, BAD, BAD, [], 1, (7, GOOD), 1.5),
    "turns": (BAD, GOOD, BAD, [], 2, (27, GOOD), 10.5),
    "leaps from none": (BAD, WORSE, GOOD, [], 3, (34, GOOD), 1.0),
    "rounds from the start": (BAD, WORSE, WORSE, [GOOD], 4, (34, GOOD), 100.5),
    "rounds from none": (BAD, WORSE, WORSE, [9.0, GOOD], 5, (34, GOOD), 100.0),
    "rounds from the best, by leaps": (BAD, WORSE, WORSE, [9.0, 9.0, GOOD], 6, (34, GOOD), 101.5),
    "rounds from the best, in turns": (WORSE, BAD, WORSE, [9.0, 9.0, GOOD], 6, (34, GOOD), 110.5),
    "rounds from the best, from none": (WORSE, WORSE, BAD, [9.0, 9.0, GOOD], 6, (34, GOOD), 101.0),
    "none, and leaps were best": (BAD, WORSE, WORSE, [9.0] * 3, 6, (34, BAD), 1.5),
    "none, and turns were best": (WORSE, BAD, WORSE, [9.0] * 3, 6, (34, BAD), 10.5),
    "none, and leaps from none were best": (WORSE, WORSE, BAD, [9.0] * 3, 6, (34, BAD), 1.0),
}


@pytest.mark.parametrize("solved_by", LATER)
def test_many_blocks_are_solved_by_leaps_then_in_turns_then_by_rounds(
    monkeypatch: pytest.MonkeyPatch, solved_by: str
) -> None:
    leaps, turns, anew, rounds, tries, due, impulse = LATER[solved_by]
    said, result, p = told_by(monkeypatch, CHAIN + 1, leaps, turns, rounds, anew=anew)
    starts = [("leaps", 0.5), ("turns", 0.5), ("leaps", 0.0), ("newton", 0.5), ("newton", 0.0)]
    bests = {leaps: 1.5, turns: 10.5, anew: 1.0}
    best = ("newton", bests[min(leaps, turns, anew)])
    assert said == [*starts, best][:tries]
    assert result == due
    assert (p == impulse).all()
