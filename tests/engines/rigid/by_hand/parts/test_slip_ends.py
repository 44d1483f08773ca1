"""Claims about the search for the end of a slip: trials are replaced by slips of known course."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from vv.engines.rigid.general import events
from vv.engines.rigid.limits import CLOSE

pytestmark = pytest.mark.usefixtures("in_python")
DT, NOW, SLACK, LEAST = 1e-2, 0.5, 1e-9, 0.1  # s, s, m, m/s


class Slips:
    """Slips that end at a time, after which contacts 0 and 2 of three have ended."""

    def __init__(self, patch: pytest.MonkeyPatch, ends: float, speed: float) -> None:
        self.ends, self.speed, self.spans = ends, speed, list[float]()
        self.past = SimpleNamespace(key=np.array([5, 6]), still=np.zeros(2, bool))
        patch.setattr(events, "attempt", self._attempt)
        patch.setattr(events, "rates", lambda *_: None)
        patch.setattr(events, "slowest_slip", lambda trial, v, w: self._speed(trial.span))
        patch.setattr(events, "least_impact_speed", lambda *_: LEAST)
        patch.setattr(events, "past_with_impulses", lambda trial, span: ("impulses", span))
        self.trials_of: list[Any] = []

    def _speed(self, span: float) -> float:
        return self.speed * (1.0 - span / self.ends) if span else self.speed

    def _attempt(self, setting: Any, state: Any, now: float, span: float, *given: Any) -> Any:
        assert (now, given[-1]) == (NOW, SLACK)
        self.spans.append(span)
        self.trials_of.append(given[-2])
        return self.trial(span)

    def trial(self, span: float) -> Any:
        """A trial of such a length."""
        over = span > self.ends
        return SimpleNamespace(
            ended=np.array([over, False, over]), gaps=SimpleNamespace(slack=SLACK), span=span,
            key=np.array([6, 5, 9]), v=np.zeros((1, 3)), w=np.zeros((1, 3)),
        )  # fmt: skip

    def found(self) -> float:
        """The time to the end of the slip, in steps."""
        nothing: Any = None
        past: Any = self.past
        whole = self.trial(DT)
        whole.span = 0.0  # its slowest slip is asked at the start
        return float(
            events.time_to_slip_end(nothing, nothing, past, NOW, DT, DT, nothing, whole) / DT
        )


@pytest.mark.parametrize("ends", [0.2, 0.5, 0.93])
def test_a_slip_goes_on_until_just_before_its_end(
    monkeypatch: pytest.MonkeyPatch, ends: float
) -> None:
    told = Slips(monkeypatch, ends * DT, 0.9 * LEAST)
    found = told.found()
    assert ends - CLOSE <= found <= ends
    assert len(told.spans) <= 12
    assert all(past is told.past for past in told.trials_of)
    assert not told.past.still.any()


@pytest.mark.parametrize(("speed", "jams"), [(0.98 * LEAST, False), (1.02 * LEAST, True)])
def test_a_fast_slip_that_ends_at_once_jams(
    monkeypatch: pytest.MonkeyPatch, speed: float, jams: bool
) -> None:
    """It is seen in a trial of the accuracy asked, which starts with the impulses of the step."""
    told = Slips(monkeypatch, 0.5 * CLOSE * DT, speed)
    found = told.found()
    assert found == (-np.inf if jams else 0.0)
    if jams:
        assert told.spans == [CLOSE * DT]
        assert told.trials_of == [("impulses", CLOSE * DT)]
        assert not told.past.still.any()
    else:
        assert told.past.still.tolist() == [False, True]  # the row of key 6


def test_a_fast_slip_that_goes_on_is_searched_as_others(monkeypatch: pytest.MonkeyPatch) -> None:
    told = Slips(monkeypatch, 0.4 * DT, 2.0 * LEAST)
    assert 0.4 - CLOSE <= told.found() <= 0.4
    assert told.spans[0] == CLOSE * DT


def test_guesses_that_are_too_late_step_back_by_ever_longer_ways(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """First by half of the accuracy, then by the mean of the step back and of what is left.

    The slip ends at 0.6; the guess after the trial at 0.5, which is the last one in time, is 0.95.
    The mean is the geometric one, so that any distance is covered in a few trials.
    """
    monkeypatch.setattr(events, "zero_after", lambda *_: 0.95 * DT)
    told = Slips(monkeypatch, 0.6 * DT, 0.9 * LEAST)
    assert 0.6 - CLOSE <= told.found() <= 0.6
    guess, back, wanted = 0.95 + 0.25 * CLOSE, 0.0, [0.5]
    while guess > 0.6:
        wanted.append(guess)
        back = math.sqrt(back * (guess - 0.5)) if back else 0.5 * CLOSE
        guess -= back
    assert len(wanted) >= 5
    assert np.array(told.spans[: len(wanted)]) / DT == pytest.approx(np.array(wanted), rel=1e-12)
