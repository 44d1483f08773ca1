"""Runs the kernel of a slider: prepares its arguments and makes a path of its output."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Callable
from typing import Any, NoReturn

import numpy as np

from vv.engines.exact.guards import GUARD_ROUNDING
from vv.engines.exact.modes import STATES, State
from vv.engines.exact.reachability import RefusedError
from vv.engines.exact.roots import first_descent_below_zero
from vv.engines.exact.slide.clock import ORDER, Clock
from vv.engines.exact.slide.kernel import CROWDED, follow_line
from vv.engines.exact.slide.path import Slide
from vv.engines.exact.slide.system import Slider, TurningSlider
from vv.engines.exact.stopped import StoppedError
from vv.engines.kernels.compiled import entry
from vv.scene import Vector

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
        self._run  # noqa: B018 - a cached property

    def follow(self) -> int:
        """Run the kernel, which is what is timed: the number of pieces; raises as `Flow.follow`."""
        count = self._run()
        while count < 0:
            if count <= CROWDED or self.room >= MOST_STEPS:
                last = CROWDED - count if count <= CROWDED else self.room
                cell = self.filled[0][:last, 0].max(initial=0.0)
                _stop(count <= CROWDED, f"by t = {self.clock.time((cell, 0.0)):.6g} s")
            self.room = min(4 * self.room, MOST_STEPS)
            self.filled = self._filled()
            del self._run
            count = self._run()
        return count

    def path(self, count: int) -> Slide:
        """The motion, made from the number of pieces that `follow` returned."""
        pieces, states = (array[:count] for array in self.filled)
        cell, part, length, place, speed = pieces.T
        begun = cell.astype(np.int64), part, length
        slide = Slide(self.slider, self.clock, *begun, np.empty((0, 0)), states, self.end)
        return dataclasses.replace(slide, series=_series(slide, place, speed))

    @functools.cached_property
    def _arguments(self) -> tuple[Any, ...]:
        """The arguments of the kernel that describe the slider."""
        slider, clock = self.slider, self.clock
        rows, bounds = _rows(slider, clock)
        angles = clock.angles(self.end[0] + 1)
        waves = np.stack((np.sin(angles), np.cos(angles)), axis=1)
        state, fastest = STATES.index(_state(slider)), _fastest(slider, clock)
        rubs = bool(np.abs(slider.mu * slider.pressing).max() > 0)
        begun = slider.speed, state, fastest
        given = np.array([clock.rate, self.end[1], *begun, MOST_EVENTS, rubs])
        return rows, bounds, waves, clock.turn, given, np.empty((4, len(clock.turn)))

    @functools.cached_property
    def _run(self) -> Callable[[], int]:
        """The machine code of the kernel with its arguments."""
        arguments = (*self._arguments, *self.filled)
        return functools.partial(entry(follow_line, arguments), *arguments)

    def _filled(self) -> tuple[Any, ...]:
        """The arrays that the kernel fills."""
        return np.empty((self.room, 5)), np.empty(self.room, np.int64)


def _rows(slider: Slider, clock: Clock) -> tuple[Vector, Vector]:
    """The rows of `follow_line` and the bounds of its guards."""
    start, friction = slider.base @ slider.along, slider.mu * slider.pressing
    wall = np.concatenate(((0.0,), start))
    moving = np.concatenate(((0.0,), 2 * np.pi * slider.frequency * start))
    ahead, back = slider.relative_drive - friction, -slider.relative_drive - friction
    guards = np.array([ahead, back, -ahead, -back]) / clock.rate
    pulls = slider.drive - friction, slider.drive + friction, slider.drive
    powers = clock.turn ** np.array([[3], [3], [4], [4]])
    return np.array([*guards, *pulls, wall, moving]), (np.abs(guards[:, 1:]) * powers).sum(axis=1)


def _series(slide: Slide, place: Vector, speed: Vector) -> Vector:
    """Taylor coefficients (p, ORDER + 1) [m] of the position in each piece."""
    slider, rate = slide.slider, slide.clock.rate
    sign = np.array([state.sign for state in slide.states])[:, None]
    rank = np.arange(1, ORDER)
    wall = np.concatenate(((0.0,), slider.base @ slider.along))
    pull = slide.series_of_row(slider.drive)
    pull = pull - sign * slide.series_of_row(slider.mu * slider.pressing)
    sticks = (sign == 0) & bool(np.abs(slider.mu * slider.pressing).max() > 0)
    free = np.zeros_like(pull)
    free[:, 1], free[:, 2:] = speed / rate, pull[:, :-2] / (rate * rate * rank * (rank + 1))
    series = np.where(sticks, slide.series_of_row(wall), free)
    series[:, 0] = place
    return np.asarray(series)


def _stop(crowded: bool, at: str) -> NoReturn:
    """Raise the error of a motion that stops early, or takes too many steps."""
    if crowded:
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
