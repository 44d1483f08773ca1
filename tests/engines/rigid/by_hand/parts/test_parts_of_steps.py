"""Claims about how the general kernel of `rigid` divides steps, by script.

Trials and the searches within them are replaced by ones that say what is told them in advance.
"""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from vv.engines.rigid.general import kernel
from vv.engines.rigid.limits import (
    APART,
    BRIEF,
    CUTS,
    HITS,
    IMPACT_TIME,
    NEARLY,
    SMALL,
    SPLITS,
    STILL,
)

pytestmark = pytest.mark.usefixtures("in_python")
DT, SLACK, FAST, PULL, BRAKING = 0.01, 3e-9, 2.0, 20.0, 9.0
WIDE = SLACK + HITS * DT * FAST
ASKED = ("begun", "ended", "landing", "ends", "starts", "acted", "may", "even")


class Told:
    """A step of some blocks; what each question is answered by, in turn, and then by no event.

    begun, ended: whether slip does in a trial; landing, ends, starts: times in steps; acted:
    whether an impact did; may: whether a contact may slip; even: the part of a trial in which no
    slow slip turns.
    """

    def __init__(self, patch: pytest.MonkeyPatch, blocks: int = 1, **told: list[Any]) -> None:
        self.told = {name: iter(told.get(name, ())) for name in ASKED}
        self.trials: list[tuple[float, float, float]] = []  # now, span [steps] and slack [m]
        self.moved: list[float] = []  # spans
        self.asked: list[str] = []
        self.past: list[Any] = []  # the time and least speed of `past_after`
        self.works: list[bool] = []
        for name, made in {
            "attempt": self._attempt, "time_to_landing": self._landing,
            "time_to_slip_end": self._ends, "time_to_slip_start": self._starts,
            "time_of_even_slip": lambda *given: given[4] * self._next("even", 1.0),
            "impact_acted": lambda *_: self._next("acted", False),
            "may_slip": lambda *_: self._next("may", False),
            "move": lambda setting, state, trial, span: self.moved.append(span / DT),
            "past_after": lambda trial, over, least: self.past.append((over / DT, least)),
            "past_with_impulses": lambda trial, span: self.asked.append("impulses"),
            "add_works": lambda *given: self.works.append(given[-1]),
            "remove_penetration": lambda *_: 1e-7, "fastest_speed": lambda *_: FAST,
            "no_past": lambda *_: None, "kinetic": lambda *_: 1.0, "add_impulses": lambda *_: None,
            "fill_forces": lambda *_: self.asked.append("forces"),
        }.items():  # fmt: skip
            patch.setattr(kernel, name, made)
        setting: Any = SimpleNamespace(
            mass=np.ones(blocks), slack=SLACK, pull=PULL, braking=BRAKING, tolerance=0.0
        )
        path, energy = np.zeros((2, blocks, 9)), np.zeros((2, 8))
        self.report, reaction = np.zeros((2, 4)), np.zeros((2, blocks + 1, 6))
        zero = np.zeros((blocks, 3))
        rows = kernel.move_rigid(
            path, energy, self.report, reaction, np.arange(blocks), 1, DT, setting, zero, zero, zero
        )
        assert rows == 2
        assert self.report[1] == pytest.approx([2e-9, 5.0, 1e-7, len(self.moved) - 1.0])

    def _next(self, name: str, otherwise: Any) -> Any:
        if name not in ("begun", "ended"):
            self.asked.append(name)
        return next(self.told[name], otherwise)

    def _attempt(self, setting: Any, state: Any, now: float, span: float, *rest: Any) -> Any:
        self.trials.append((now / DT, span / DT, rest[-1]))
        begun, ended = (np.array([self._next(name, False)]) for name in ("begun", "ended"))
        return SimpleNamespace(begun=begun, ended=ended, residual=2e-9, sweeps=5,
                               gaps=SimpleNamespace(slack=rest[-1]))  # fmt: skip

    def _landing(self, *given: Any) -> tuple[float, bool]:
        span = self._next("landing", None)
        return (given[4], False) if span is None else (span * DT, True)

    def _ends(self, *given: Any) -> float:
        return DT * float(self._next("ends", 0.0))

    def _starts(self, *given: Any) -> float:
        return DT * float(self._next("starts", 0.0))


def steps(*trials: tuple[float, float, float]) -> list[Any]:
    """Trials, but for rounding."""
    return [pytest.approx(one, rel=1e-9) for one in trials]


def test_a_step_without_events_is_one_trial(monkeypatch: pytest.MonkeyPatch) -> None:
    told = Told(monkeypatch)
    assert told.trials == steps((0.0, 1.0, SLACK))
    assert told.asked == ["landing", "may", "even", "forces"]
    assert told.past == [pytest.approx((1.0, STILL * BRAKING * DT))]
    assert told.works == [False]


@pytest.mark.parametrize("acted", [True, False])
def test_a_step_ends_at_a_landing_and_an_impact_takes_no_time(
    monkeypatch: pytest.MonkeyPatch, acted: bool
) -> None:
    """After an impact that did nothing, none is looked for any more in this step."""
    told = Told(monkeypatch, landing=[0.4, 0.0], acted=[acted])
    rest = 0.6 - IMPACT_TIME
    assert told.trials == steps(
        (0.0, 1.0, SLACK), (0.0, 0.4, APART * SLACK), (0.4, 0.6, SLACK),
        (0.4, IMPACT_TIME, WIDE), (0.4 + IMPACT_TIME, rest, SLACK),
    )  # fmt: skip
    assert told.moved == pytest.approx([0.4, IMPACT_TIME, rest])
    assert told.works == [False, True, False]
    assert told.asked.count("landing") == (3 if acted else 2)
    assert told.asked.count("forces") == 2
    assert [over for over, _ in told.past] == pytest.approx([0.4, 1.0 / CUTS, rest])
    assert told.past[1][1] == pytest.approx(STILL * BRAKING * DT)


@pytest.mark.parametrize("span", [0.3, 0.05])
def test_a_step_ends_where_slip_does_and_brief_forces_are_averaged(
    monkeypatch: pytest.MonkeyPatch, span: float
) -> None:
    told = Told(monkeypatch, ended=[True, False, False], ends=[span])
    assert told.trials == steps((0.0, 1.0, SLACK), (0.0, span, SLACK), (span, 1.0 - span, SLACK))
    assert told.past[0] == pytest.approx((max(span, BRIEF), NEARLY * PULL * DT))
    assert told.past[1][1] == pytest.approx(STILL * BRAKING * (1.0 - span) * DT)


def test_a_slip_that_ends_at_once_and_one_that_jams_are_tried_again(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    told = Told(monkeypatch, ended=[True, False], ends=[0.0])
    assert told.trials == steps(*[(0.0, 1.0, SLACK)] * 2)
    assert told.moved == [1.0]
    told = Told(monkeypatch, ended=[True, False, False], ends=[-np.inf], acted=[True])
    assert told.trials == steps(
        (0.0, 1.0, SLACK), (0.0, IMPACT_TIME, SLACK), (0.0, IMPACT_TIME, WIDE),
        (IMPACT_TIME, 1.0 - IMPACT_TIME, SLACK),
    )  # fmt: skip
    assert told.asked.count("impulses") == 2
    assert told.works == [True, False]


@pytest.mark.parametrize("why", [{"begun": [True, False, True]}, {"may": [True, True]}])
def test_a_step_ends_once_where_slip_begins(monkeypatch: pytest.MonkeyPatch, why: Any) -> None:
    told = Told(monkeypatch, starts=[0.7, 0.1], **why)
    assert told.trials == steps((0.0, 1.0, SLACK), (0.0, 0.7, SLACK), (0.7, 0.3, SLACK))
    assert told.asked.count("starts") == 1


def test_a_step_is_shortened_where_a_slow_slip_turns(monkeypatch: pytest.MonkeyPatch) -> None:
    """So is the part before the end of a slip; an impact is not."""
    told = Told(monkeypatch, even=[0.25, 1.0])
    assert told.trials == steps((0.0, 1.0, SLACK), (0.0, 0.25, SLACK), (0.25, 0.75, SLACK))
    told = Told(monkeypatch, ended=[True, False, False, False], ends=[0.4], even=[0.5, 1.0])
    assert told.moved == pytest.approx([0.2, 0.8])
    told = Told(monkeypatch, landing=[0.0], acted=[True])
    assert told.asked.count("even") == 1


def test_the_last_part_of_a_step_is_not_divided(monkeypatch: pytest.MonkeyPatch) -> None:
    many = 2 * SPLITS
    told = Told(monkeypatch, landing=[0.0] * many, acted=[True] * many, ended=[True] * many)
    assert len(told.moved) == SPLITS
    assert told.works == [True] * (SPLITS - 1) + [False]
    assert told.asked.count("landing") == SPLITS - 1
    assert "ends" not in told.asked
    told = Told(monkeypatch, ended=[True] * many, ends=[0.01] * many)
    assert told.asked.count("ends") == SPLITS - 1
    told = Told(monkeypatch, even=[0.01] * many)
    assert told.asked.count("even") == SPLITS - 1


@pytest.mark.parametrize(("blocks", "parts"), [(SMALL, 2), (SMALL + 1, 1)])
def test_steps_of_many_blocks_are_not_divided(
    monkeypatch: pytest.MonkeyPatch, blocks: int, parts: int
) -> None:
    told = Told(monkeypatch, blocks, landing=[0.5], ended=[True], begun=[True], ends=[0.5])
    assert len(told.moved) == parts
    assert len(told.asked) >= 4 * parts - 3
    assert parts == 2 or told.asked == ["forces"]
