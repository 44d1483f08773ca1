"""Runs the kernel of a slider: prepares its arguments and makes a path of its output."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any, NoReturn

import numpy as np

from vv.engines.exact.guards import GUARD_ROUNDING
from vv.engines.exact.modes import STATES, State
from vv.engines.exact.reachability import RefusedError
from vv.engines.exact.roots import first_descent_below_zero
from vv.engines.exact.slide.clock import ORDER, Clock
from vv.engines.exact.slide.kernel import CROWDED, ENDED, follow_line
from vv.engines.exact.slide.path import Slide
from vv.engines.exact.slide.system import Slider, TurningSlider
from vv.engines.exact.stopped import StoppedError
from vv.engines.kernels.compiled import entry

MOST_EVENTS = 1_000  # in one cell; with more, events are said to accumulate
MOST_STEPS = 1_000_000  # in one run
FEW = 128  # pieces for which arrays have room at first


class SliderFlow:
    """A slider whose motion over a duration [s] can be computed as often as wanted."""

    def __init__(self, slider: Slider, duration: float) -> None:
        self.slider, self.clock = slider, Clock.of(slider.frequency, slider.phase, duration)
        self.end = self.clock.instant(duration)
        self.room = min(FEW, MOST_STEPS)
        self.filled = self._filled()

    def warm(self) -> None:
        """Load or compile the kernel."""
        self._kernel  # noqa: B018 - a cached property

    def follow(self) -> int:
        """Run the kernel, which is what is timed: the number of pieces; raises as `Flow.follow`."""
        while True:
            outcome, count = self._kernel(*self._arguments, *self.filled)
            if outcome == ENDED:
                return count
            if outcome == CROWDED or self.room >= MOST_STEPS:
                cell = self.filled[0][:count, 0].max(initial=0.0)
                _stop(outcome, f"by t = {self.clock.time((cell, 0.0)):.6g} s")
            self.room = min(4 * self.room, MOST_STEPS)
            self.filled = self._filled()

    def path(self, count: int) -> Slide:
        """The motion, made from the number of pieces that `follow` returned."""
        starts, states, series = (array[:count] for array in self.filled)
        cell, part, length = starts.T
        cells = cell.astype(np.int64)
        return Slide(self.slider, self.clock, cells, part, length, series, states, self.end)

    @functools.cached_property
    def _arguments(self) -> tuple[Any, ...]:
        """The arguments of the kernel that describe the slider."""
        slider, clock = self.slider, self.clock
        start = np.concatenate(((0.0,), slider.base @ slider.along))
        friction = slider.mu * slider.pressing
        rows = np.array([slider.drive, slider.relative_drive, friction, start])
        initial = slider.speed, STATES.index(_state(slider)), _fastest(slider, clock)
        angles = clock.angles(self.end[0] + 1)
        return rows, angles, clock.turn, clock.rate, self.end[1], initial, MOST_EVENTS

    @functools.cached_property
    def _kernel(self) -> Callable[..., tuple[int, int]]:
        return entry(follow_line, (*self._arguments, *self.filled))

    def _filled(self) -> tuple[Any, ...]:
        """The arrays that the kernel fills."""
        room = self.room
        return np.empty((room, 3)), np.empty(room, np.int64), np.empty((room, ORDER + 1))


def _stop(outcome: int, at: str) -> NoReturn:
    """Raise the error of a motion that stops early, or takes too many steps."""
    if outcome == CROWDED:
        raise StoppedError(f"events accumulate: more than {MOST_EVENTS} in a quarter period {at}")
    raise RefusedError(
        f"the duration is too long for so fast a motion: more than {MOST_STEPS} steps {at}"
    )


def lift_off(slider: Slider | TurningSlider, duration: float) -> float | None:
    """The time [s] at which the body leaves the wall within a duration [s], or None."""
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
    """The state at t = 0; without friction it is always STUCK, which then means closed."""
    if slider.mu == 0 or slider.sign == 0:
        return State.STUCK
    return State.SLIP_FORWARD if slider.sign > 0 else State.SLIP_BACKWARD


def _fastest(slider: Slider, clock: Clock) -> float:
    """An estimate of the largest speed [m/s], of which rounding is a part."""
    strength = (
        np.abs(slider.relative_drive) + np.abs(slider.drive) + slider.mu * np.abs(slider.pressing)
    )
    return abs(slider.speed) + float(strength.sum()) / clock.rate
