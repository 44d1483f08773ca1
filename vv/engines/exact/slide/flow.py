"""The motion of a slider: what its kernel is given, and what became of it."""

from __future__ import annotations

import numpy as np

from vv.engines.exact.flow import StoppedError
from vv.engines.exact.guards import GUARD_ROUNDING
from vv.engines.exact.modes import STATES, State
from vv.engines.exact.roots import first_descent_below_zero
from vv.engines.exact.slide.clock import ORDER, Clock, Instant
from vv.engines.exact.slide.kernel import CROWDED, ENDED, follow_line
from vv.engines.exact.slide.path import Slide
from vv.engines.exact.slide.system import Slider, TurningSlider

MOST_EVENTS = 1_000  # in one cell; more are taken for an accumulation
MOST_STEPS = 1_000_000  # in one run
FEW = 128  # pieces for which there is room at first


def follow_slider(slider: Slider, duration: float) -> Slide:
    """The motion of a slider over a duration [s]; raises StoppedError if it cannot be followed."""
    clock = Clock.of(slider.frequency, slider.phase, duration)
    end, start = clock.instant(duration), np.concatenate(((0.0,), slider.base @ slider.along))
    friction, room = slider.mu * slider.pressing, min(FEW, MOST_STEPS)
    rows = np.array([slider.drive, slider.relative_drive, friction, start])
    begun = slider.speed, STATES.index(_state(slider)), _fastest(slider, clock)
    angles = clock.angles(end[0] + 1)
    while True:
        starts, states = np.empty((room, 3)), np.empty(room, np.int64)
        series = np.empty((room, ORDER + 1))
        outcome, count = follow_line(
            rows, angles, clock.turn, clock.rate, end[1], begun, MOST_EVENTS, starts, states,
            series,
        )  # fmt: skip
        cell, part, length = starts[:count].T
        if outcome == ENDED:
            cells = cell.astype(np.int64)
            return Slide(slider, clock, cells, part, length, series[:count], states[:count], end)
        if outcome == CROWDED or room >= MOST_STEPS:
            raise StoppedError(_why(outcome, clock, (cell.max(initial=0.0), 0.0)))
        room = min(4 * room, MOST_STEPS)


def _why(outcome: int, clock: Clock, instant: Instant) -> str:
    at = f"by t = {clock.time(instant):.6g} s"
    if outcome == CROWDED:
        return f"events accumulate: more than {MOST_EVENTS} in a quarter period {at}"
    return f"the duration is too long for so fast a motion: more than {MOST_STEPS} steps {at}"


def lift_off(slider: Slider | TurningSlider, duration: float) -> float | None:
    """When the body is no longer pressed on the wall within a duration [s], or None."""
    band = GUARD_ROUNDING * float(np.abs(slider.pressing).sum())
    if slider.pressing[0] - np.abs(slider.pressing[1:]).sum() > band:
        return None
    clock = Clock.of(slider.frequency, slider.phase, duration)
    terms, last = clock.taylor(slider.pressing), clock.instant(duration)
    if not (terms @ clock.waves((0, 0.0)))[0] > band:
        return 0.0
    for cell in range(last[0] + 1):
        c = (terms @ clock.waves((cell, 0.0))).tolist()
        fall = first_descent_below_zero(c, band, last[1] if cell == last[0] else 1.0)
        if fall is not None:
            return clock.time((cell, fall))
    return None


def _state(slider: Slider) -> State:
    """The state at t = 0; without friction there is one, closed."""
    if slider.mu == 0 or slider.sign == 0:
        return State.STUCK
    return State.SLIP_FORWARD if slider.sign > 0 else State.SLIP_BACKWARD


def _fastest(slider: Slider, clock: Clock) -> float:
    """The largest speed that can be expected [m/s]."""
    strength = (
        np.abs(slider.relative_drive) + np.abs(slider.drive) + slider.mu * np.abs(slider.pressing)
    )
    return abs(slider.speed) + float(strength.sum()) / clock.rate
