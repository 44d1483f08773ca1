"""Integrates a slider from event to event, by Taylor steps within quarter periods."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from vv.engines.exact.flow import StoppedError
from vv.engines.exact.guards import GUARD_ROUNDING
from vv.engines.exact.modes import State
from vv.engines.exact.roots import bernstein, first_descent_below_zero
from vv.engines.exact.slide.clock import ORDER, Clock, Instant
from vv.engines.exact.slide.path import Slide, SlidePiece
from vv.engines.exact.slide.system import Slider, TurningSlider
from vv.scene import Vector

MOST_EVENTS = 1_000  # in one cell; more are taken for an accumulation
MOST_STEPS = 1_000_000  # in one run
POWER = np.arange(ORDER + 1.0)
TO_BERNSTEIN = bernstein(ORDER)


class Law(NamedTuple):
    """The equation of motion and the guards while the contact keeps a state.

    maps: (1 + g, ORDER + 1, 3 + 2k), from waves, place and speed to Taylor coefficients in cells:
    of the place [m], and of g guards [m/s] that are positive while the law holds; after: the
    state that follows when each falls.
    """

    maps: Vector
    after: tuple[State, ...]


@dataclass(frozen=True)
class Moment:
    """The state between two pieces: instant, place and speed [m, m/s] along the slip.

    fastest: the largest speed so far or expected [m/s].
    """

    instant: Instant
    place: float
    speed: float
    state: State
    fastest: float


def follow_slider(slider: Slider, duration: float) -> Slide:
    """The motion of a slider over a duration [s]; raises StoppedError if it cannot be followed."""
    clock = Clock.of(slider.frequency, slider.phase, duration)
    laws, last = _laws(slider, clock), clock.instant(duration)
    now, busy, events = _start(slider, clock), 0, 0
    pieces: list[SlidePiece] = []
    while now.instant < last:
        law, waves, (cell, part) = laws[now.state], clock.waves(now.instant), now.instant
        terms = law.maps @ np.concatenate((waves, (now.place, now.speed)))
        room = last[1] - part if cell == last[0] else 1.0 - part
        after, x = _next_event(law, terms[1:], GUARD_ROUNDING * now.fastest, room)
        if x > 0:
            pieces.append(SlidePiece(now.instant, x, terms[0], now.state, waves))
        arrival = min(last, (cell + 1, 0.0)) if after is None else (cell, part + x)
        now = _moved(now, clock, terms[0], x, arrival, after or now.state)
        busy, events = cell, (events if cell == busy else 0) + (after is not None)
        _check(clock.time(now.instant), len(pieces), events)
    return Slide.joined(slider, clock, pieces, last)


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


def _laws(slider: Slider, clock: Clock) -> dict[State, Law]:
    """The law of each state; see Slider. Without friction the one state is STUCK, closed.

    Slip along sigma ends when it would turn: the guard is sigma times its speed. Rest ends when a
    slip could grow: the guards are the decelerations of both slips, over a cell.
    """
    if not slider.mu > 0:
        return {State.STUCK: Law(_place_map(clock, slider.drive)[None], ())}
    friction, wall = slider.mu * slider.pressing, slider.base @ slider.along
    motion = _with_place_and_speed(clock.taylor(np.concatenate(((0.0,), wall))))
    held = motion.copy()
    held[0], held[0, -2] = 0.0, 1.0
    laws = {}
    for state in (State.SLIP_FORWARD, State.SLIP_BACKWARD):
        place = _place_map(clock, slider.drive - state.sign * friction)
        speed = state.sign * clock.rate * _derivative_map(place - motion)
        laws[state] = Law(np.array([place, speed]), (State.STUCK,))
    grow = [
        (slider.relative_drive - friction) / clock.rate,
        (slider.relative_drive + friction) / clock.rate,
    ]
    rest = np.array(
        [
            held,
            _with_place_and_speed(-clock.taylor(grow[0])),
            _with_place_and_speed(clock.taylor(grow[1])),
        ]
    )
    return {State.STUCK: Law(rest, tuple(laws)), **laws}


def _place_map(clock: Clock, acceleration: Vector) -> Vector:
    """The map to the place under the acceleration of a row."""
    maps = np.zeros((ORDER + 1, 3 + 2 * len(clock.phase)))
    steps = (POWER[2:] * (POWER[2:] - 1))[:, None] * clock.rate**2
    maps[2:, :-2] = clock.taylor(acceleration)[:-2] / steps
    maps[0, -2] = 1.0
    maps[1, -1] = 1 / clock.rate
    return maps


def _with_place_and_speed(maps: Vector) -> Vector:
    """A map from waves as one from waves, place and speed."""
    return np.pad(maps, ((0, 0), (0, 2)))


def _derivative_map(maps: Vector) -> Vector:
    """The map to the derivative in cells."""
    return np.vstack((maps[1:] * POWER[1:, None], 0 * maps[:1]))


def _start(slider: Slider, clock: Clock) -> Moment:
    """The state at t = 0."""
    state = {0: State.STUCK, 1: State.SLIP_FORWARD, -1: State.SLIP_BACKWARD}[
        slider.sign if slider.mu > 0 else 0
    ]
    strength = (
        np.abs(slider.relative_drive) + np.abs(slider.drive) + slider.mu * np.abs(slider.pressing)
    )
    fastest = abs(slider.speed) + float(strength.sum()) / clock.rate
    return Moment((0, 0.0), 0.0, slider.speed, state, fastest)


def _next_event(law: Law, guards: Vector, band: float, end: float) -> tuple[State | None, float]:
    """The state after the guard that falls first, and when; or None and `end`, in cells."""
    found = None
    if len(guards):
        least = ((guards * end**POWER) @ TO_BERNSTEIN).min(axis=1)
        for g in np.flatnonzero(least < -band / 4):
            fall = first_descent_below_zero(guards[g].tolist(), band, end)
            if fall is not None:
                found, end = law.after[g], fall
    return found, end


def _moved(
    now: Moment, clock: Clock, series: Vector, x: float, arrival: Instant, state: State
) -> Moment:
    """The state x cells later, on arrival at an instant."""
    if x == 0:
        return replace(now, instant=arrival, state=state)
    terms = series * x**POWER
    speed = float(POWER @ terms) * clock.rate / x
    return Moment(arrival, float(terms.sum()), speed, state, max(now.fastest, abs(speed)))


def _check(time: float, steps: int, events: int) -> None:
    """Raise StoppedError if the events or the steps have become too many."""
    at = f"by t = {time:.6g} s"
    if events > MOST_EVENTS:
        raise StoppedError(f"events accumulate: more than {MOST_EVENTS} in a quarter period {at}")
    if steps > MOST_STEPS:
        raise StoppedError(
            f"the duration is too long for so fast a motion: more than {MOST_STEPS} steps {at}"
        )
