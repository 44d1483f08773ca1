"""Claims about the search for a landing: trials are replaced by a gap of known course."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from vv.engines.rigid.general import landing
from vv.engines.rigid.limits import APART, GENTLY, LANDED, SHORTLY, SLOWLY

pytestmark = pytest.mark.usefixtures("in_python")
DT, SLACK, FAST = 1e-2, 1e-9, 5.0  # the least velocity of an impact beside weight


class Falls:
    """A gap a + b t + c t^2 + d t^3, whose trials say when a parabola through them closes."""

    def __init__(self, patch: pytest.MonkeyPatch, course: Any, first: float) -> None:
        self.course, self.spans = course, list[float]()
        self.closes: float = 0.0
        self.gained: float = 0.0
        self.asked = list[float]()
        patch.setattr(landing, "attempt", self._attempt)
        patch.setattr(landing, "time_to_closing", self._closing)
        patch.setattr(landing, "earliest_landing", lambda *given: self._earliest(first, given[-1]))
        patch.setattr(landing, "least_impact_speed", lambda *_: FAST)
        patch.setattr(landing, "speed_of_closing", lambda *_: self.closes)
        patch.setattr(landing, "gain_of_closing", lambda *_: self.gained)

    def _earliest(self, first: float, fast: float) -> float:
        self.asked.append(fast)
        return first if not self.gained or self.closes > fast else float("inf")

    def _attempt(self, setting: Any, state: Any, now: float, span: float, *given: Any) -> Any:
        assert (now, given[-1]) == (0.5, APART * SLACK)
        self.spans.append(span)
        return SimpleNamespace(at=span)

    def _closing(self, trial: Any, span: float) -> float:
        assert trial.at == span
        a, b, c, d = self.course
        gap, rate = a + b * span + c * span**2 + d * span**3, b + 2 * c * span + 3 * d * span**2
        return float("inf") if rate >= 0.0 else -gap / rate  # one step of Newton

    def found(self, whole: float = DT) -> tuple[float, bool]:
        """The time to a landing, in steps, and whether there is one."""
        setting: Any = SimpleNamespace(slack=SLACK, tolerance=1e-9)
        nothing: Any = None
        time, there = landing.time_to_landing(
            setting, nothing, nothing, 0.5, whole, DT, nothing, nothing
        )
        return time / DT, there


def test_where_nothing_lands_the_step_is_whole(monkeypatch: pytest.MonkeyPatch) -> None:
    told = Falls(monkeypatch, (1.0, 0.0, 0.0, 0.0), float("inf"))
    assert told.found() == (1.0, False)
    assert told.found(0.3 * DT) == (0.3, False)
    assert not told.spans


@pytest.mark.parametrize(("gained", "fast"), [
    (3.0, 3.0 * SLOWLY), (1e-6, 1e-9 * GENTLY), (1e9, FAST),
])  # fmt: skip
def test_a_contact_slow_beside_weight_is_compared_with_what_it_gains_itself(
    monkeypatch: pytest.MonkeyPatch, gained: float, fast: float
) -> None:
    """In a step, whatever the part of it that is left, and without the contact."""
    told = Falls(monkeypatch, (3.0 * 0.2 * DT, -3.0, 0.0, 0.0), 0.1 * DT)
    told.closes, told.gained = 3.0, 0.4 * gained
    time, there = told.found(0.4 * DT)
    assert told.asked == [FAST, pytest.approx(fast)]
    assert told.spans[0] == 0.4 * DT
    assert there is (fast < FAST)
    assert time == pytest.approx(0.2 if there else 0.4, abs=10 * LANDED)


@pytest.mark.parametrize("ends", [0.2, 0.55, 0.97])
@pytest.mark.parametrize("first", [0.5, 0.9])
def test_a_landing_is_found_by_trials_from_its_lower_bound(
    monkeypatch: pytest.MonkeyPatch, ends: float, first: float
) -> None:
    """Its gap is zero at a part of the step, with a curved course before."""
    t = ends * DT
    told = Falls(monkeypatch, (3.0 * t + t**2 / DT, -3.0, -1.0 / DT, 0.0), first * t)
    time, there = told.found()
    assert there
    assert time == pytest.approx(ends, abs=10 * LANDED)
    assert told.spans[0] == first * t


def test_what_lands_after_the_step_lands_later(monkeypatch: pytest.MonkeyPatch) -> None:
    told = Falls(monkeypatch, (3.0 * 1.2 * DT, -3.0, 0.0, 0.0), 0.9 * DT)
    assert told.found() == (1.0, True)
    told = Falls(monkeypatch, (3.0, -3.0, 0.0, 0.0), 1.5 * DT)
    assert told.found() == (1.0, True)
    assert not told.spans


@pytest.mark.parametrize(("course", "due"), [
    ((0.0, -1.0, 0.0, 0.0), 0.0),  # it has closed within the short trial
    ((3.0 * 0.4 * DT, -3.0, 0.0, 0.0), 0.4),
    ((3.0 * 1.4 * DT, -3.0, 0.0, 0.0), 0.0),
])  # fmt: skip
def test_a_gap_that_seems_closed_is_looked_at_again_after_a_short_time(
    monkeypatch: pytest.MonkeyPatch, course: Any, due: float
) -> None:
    told = Falls(monkeypatch, course, 0.0)
    time, there = told.found()
    assert there
    assert time == pytest.approx(due, abs=10 * LANDED)
    assert told.spans[0] == SHORTLY * DT


@pytest.mark.parametrize(("part", "due"), [(0.9, 0.0), (1.1, None)])
def test_a_landing_at_either_end_of_a_step_is_at_that_end(
    monkeypatch: pytest.MonkeyPatch, part: float, due: float | None
) -> None:
    t = part * LANDED * DT
    told = Falls(monkeypatch, (3.0 * t, -3.0, 0.0, 0.0), t)
    assert told.found()[0] == (pytest.approx(part * LANDED) if due is None else 0.0)
    late = (1.0 - part * LANDED) * DT
    told = Falls(monkeypatch, (3.0 * late, -3.0, 0.0, 0.0), 0.5 * DT)
    assert (told.found()[0] == 1.0) == (due is not None)
