"""Claims about what `rigid` tries where sweeps are stuck, by script: turns, Newton steps, anew."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

from vv.engines.rigid.general import few, many
from vv.engines.rigid.general.few import Limits
from vv.engines.rigid.limits import (
    ADDED,
    CARRIED,
    CHAIN,
    ENOUGH,
    FAR,
    LEAPT,
    POLISHED,
    SHINED,
    SMALL,
    SOFT,
    STALLED,
    STEADIED,
    STIFF,
    STUCK,
    SWEPT,
    TRIED,
)
from vv.engines.rigid.solver.problem import Problem

pytestmark = pytest.mark.usefixtures("in_python")
MET, ASKED = 1e-6, 1e-8  # m/s: the setting's tolerance, and that of the first step
NEAR, WIDE = 0.5 * FAR * MET, 2.0 * FAR * MET
MOST = 20_000


class Stuck:
    """Sweeps that leave given residuals, each after all that they may; rounds that leave others.

    None after no sweep at all. tried: methods with their sweeps or stiffness, and their impulses.
    """

    def __init__(self, patch: pytest.MonkeyPatch, sweeps: list[float], rounds: Any = ()) -> None:
        self._sweeps, self._rounds = iter(sweeps), iter(rounds)
        self.tried: list[Any] = []
        self.aims: list[float] = []
        self.left, self.blurs = np.inf, 0.0
        self.stops: Iterator[int] = iter(
            ()
        )  # numbers of sweeps of methods that stop before they may
        self.p = np.ones((1, 3))
        for where in few, many:
            patch.setattr(where, "velocities_without", lambda given: (given.v, given.w))
            patch.setattr(where, "recomputed", lambda *_: self.left + self.blurs)
            patch.setattr(where, "polish", self._polish)
            patch.setattr(where, "solve_contacts", self._method("solve"))
        patch.setattr(many, "newton_rounds", self._newton_rounds)
        patch.setattr(many, "leap_sweeps", self._method("leap"))
        patch.setattr(many, "momentum_sweeps", self._method("momentum"))

    def _method(self, name: str) -> Any:
        def sweep(*given: Any) -> tuple[int, float]:
            few = next(self.stops, given[-1])
            self.left = next(self._sweeps)
            self.tried.append((name, given[-1], bool(given[0].p.any())))
            return few, self.left

        return sweep

    def _polish(self, *given: Any) -> float:
        self.tried.append(("newton", given[-1], bool(given[0].p.any())))
        self.aims.append(given[1])
        self.left = next(self._rounds)
        return self.left

    def _newton_rounds(self, *given: Any) -> float:
        left = self._polish(*given)
        self.tried[-1] = ("rounds", *self.tried[-1][1:])
        return left

    def leaps(self) -> tuple[int, float]:
        """Solve with leaps."""
        return many.solve_with_leaps(*self._given(99, MOST))

    def turns(self, blocks: int = 99, apart: int = 99, most: int = MOST) -> tuple[int, float]:
        """Solve in turns, or as few blocks or a chain."""
        chained = blocks <= SMALL or apart <= CHAIN
        solve = few.solve_chained if chained else many.solve_in_turns
        return solve(*self._given(blocks, most))

    def _given(self, blocks: int, most: int) -> Any:
        nothing: Any = None
        problem = Problem(nothing, nothing, nothing, self.p, self.p, self.p)
        return Limits(blocks, MET, most, 0.0), problem, 0, ASKED, nothing


def test_leaps_end_where_the_residual_is_met(monkeypatch: pytest.MonkeyPatch) -> None:
    told = Stuck(monkeypatch, [ASKED])
    assert told.leaps() == (STUCK, ASKED)
    told = Stuck(monkeypatch, [MET])  # after so many sweeps the usual residual is enough
    assert told.leaps() == (STUCK, MET)
    assert STUCK >= ENOUGH
    assert told.tried == [("leap", STUCK, True)]


def test_leaps_far_from_a_solution_begin_once_from_none_and_else_are_polished(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    turns = (LEAPT - 2 * STUCK) // STUCK
    told = Stuck(monkeypatch, [WIDE, WIDE] + [NEAR] * turns, [NEAR] * (1 + turns))
    assert told.leaps() == (LEAPT, NEAR)
    assert told.tried == [
        ("leap", STUCK, True), ("leap", STUCK, False), ("newton", SOFT, False),
        *[("leap", STUCK, False), ("rounds", TRIED, False)] * turns,
    ]  # fmt: skip
    assert SWEPT == 3 * STUCK
    assert LEAPT % STUCK == 0
    assert told.aims == [ASKED] * (1 + turns)
    told = Stuck(monkeypatch, [NEAR], [ASKED])
    assert told.leaps() == (STUCK, ASKED)


def test_velocities_without_the_rounding_of_sweeps_count(monkeypatch: pytest.MonkeyPatch) -> None:
    told = Stuck(monkeypatch, [0.9 * MET], [0.5 * MET])
    told.blurs = 0.2 * MET
    assert told.leaps() == (STUCK, 0.5 * MET)
    assert told.tried[1] == ("newton", SOFT, True)
    told = Stuck(monkeypatch, [2.0 * ASKED])
    told.blurs = -1.5 * ASKED
    assert told.turns() == pytest.approx((CARRIED, 0.5 * ASKED))


def test_no_more_sweeps_are_made_than_are_left(monkeypatch: pytest.MonkeyPatch) -> None:
    told = Stuck(monkeypatch, [NEAR] * 99, [NEAR] * 99)
    told.stops = iter([1000])
    assert told.leaps() == (LEAPT, NEAR)
    asked = [few for name, few, _ in told.tried if name == "leap"]
    assert asked == [STUCK] * (len(asked) - 1) + [(LEAPT - 1000) % STUCK]
    told = Stuck(monkeypatch, [NEAR] * 9, [NEAR] * 9)
    assert told.turns(1, most=STALLED + 10) == (STALLED + 10, NEAR)
    assert [few for name, few, _ in told.tried if name == "solve"] == [STALLED, 10]


@pytest.mark.parametrize(("blocks", "apart", "part"), [
    (SMALL, 99, SHINED), (SMALL + 1, CHAIN, POLISHED)])  # fmt: skip
def test_few_blocks_and_chains_are_polished_after_few_sweeps(
    monkeypatch: pytest.MonkeyPatch, blocks: int, apart: int, part: float
) -> None:
    told = Stuck(monkeypatch, [9.0, WIDE], [1.0, 0.1 * ASKED])
    assert told.turns(blocks, apart) == (2 * STALLED, 0.1 * ASKED)
    assert told.tried == [("solve", STALLED, True), ("newton", STIFF, True)] * 2
    assert told.aims == pytest.approx([part * ASKED] * 2)
    told = Stuck(monkeypatch, [9.0], [1.0])
    assert told.turns(blocks, apart, most=STALLED - 1) == (STALLED - 1, 1.0)


@pytest.mark.parametrize(("blocks", "part"), [(SMALL, 1), (SMALL + 1, SMALL + 1), (9999, ADDED)])
def test_each_contact_of_a_chain_is_asked_for_its_part_of_the_residual(
    monkeypatch: pytest.MonkeyPatch, blocks: int, part: int
) -> None:
    told = Stuck(monkeypatch, [1.01 * ASKED / part, 0.99 * ASKED / part], [1.01 * ASKED / part])
    assert told.turns(blocks, CHAIN) == (2 * STALLED, 0.99 * ASKED / part)


@pytest.mark.parametrize(("blocks", "enough"), [(SMALL, False), (SMALL + 1, True)])
def test_many_blocks_need_the_usual_residual_only_after_many_sweeps(
    monkeypatch: pytest.MonkeyPatch, blocks: int, enough: bool
) -> None:
    """Few blocks go on until the finer residual is met."""
    told = Stuck(monkeypatch, [MET] * 99, [MET] * 99)
    sweeps, left = told.turns(blocks, CHAIN, most=3000)
    assert left == MET
    assert (sweeps < 3000) == enough
    assert sweeps >= ENOUGH


def test_walls_are_solved_by_both_kinds_of_sweeps_in_turn(monkeypatch: pytest.MonkeyPatch) -> None:
    told = Stuck(monkeypatch, [9.0, 9.0, 9.0, ASKED])
    assert told.turns()[1] == ASKED
    both = [("momentum", CARRIED, True), ("solve", STEADIED, True)]
    assert told.tried == both * 2


def test_walls_where_both_are_stuck_begin_once_from_none_and_else_are_polished(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """With momentum first after the new start; Newton steps follow all sweeps after that."""
    told = Stuck(monkeypatch, [WIDE] * 8 + [ASKED], [WIDE, WIDE])
    told.turns()
    first = STUCK // (CARRIED + STEADIED) * 2
    assert first * (CARRIED + STEADIED) // 2 == STUCK
    names = [name for name, *_ in told.tried]
    assert names[:first] == ["momentum", "solve"] * (first // 2)
    assert names[first : first + 4] == ["momentum", "newton", "solve", "newton"]
    assert [pressed for *_, pressed in told.tried] == [True] * first + [False] * 5
    assert told.aims == [ASKED, ASKED]
    assert {stiff for name, stiff, _ in told.tried if name == "newton"} == {SOFT}
    told = Stuck(monkeypatch, [NEAR] * first, [ASKED])
    assert told.turns() == (STUCK, ASKED)
    assert told.tried[-1] == ("newton", SOFT, True)
