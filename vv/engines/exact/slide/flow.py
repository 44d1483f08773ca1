"""Follows a slider from event to event, in Taylor steps within quarter periods of its drive."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from vv.engines.exact.flow import BAND, StoppedError
from vv.engines.exact.modes import State
from vv.engines.exact.roots import bernstein, first_fall
from vv.engines.exact.slide.clock import ORDER, Clock, Instant
from vv.engines.exact.slide.path import Slide, SlidePiece
from vv.engines.exact.slide.system import Slider
from vv.scene import Vector

CHATTER = 1_000  # events in one cell; more means that they accumulate
STEPS = 1_000_000  # in one run
RANK = np.arange(ORDER + 1.0)
ENCLOSING = bernstein(ORDER)


class Law(NamedTuple):
    """What holds while the contact keeps a state.

    maps: (1 + g, ORDER + 1, 3 + 2k), from waves, place and speed to Taylor coefficients in cells:
    of the place [m], and of g guards [m/s] that are positive while the law holds; after: the
    state that follows when each falls.
    """

    maps: Vector
    after: tuple[State, ...]


@dataclass(frozen=True)
class Now:
    """Between two pieces: the instant, place and speed [m, m/s] along the slip, and the state.

    fastest: the greatest speed met or to be expected [m/s].
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
        after, x = _next_event(law, terms[1:], BAND * now.fastest, room)
        if x > 0:
            pieces.append(SlidePiece(now.instant, x, terms[0], now.state, waves))
        arrival = min(last, (cell + 1, 0.0)) if after is None else (cell, part + x)
        now = _moved(now, clock, terms[0], x, arrival, after or now.state)
        busy, events = cell, (events if cell == busy else 0) + (after is not None)
        _check(clock.time(now.instant), len(pieces), events)
    return Slide.joined(slider, clock, pieces, last)


def lift_off(slider: Slider, duration: float) -> float | None:
    """When the body is no longer pressed on the wall within a duration [s], or None."""
    band = BAND * float(np.abs(slider.press).sum())
    if slider.press[0] - np.abs(slider.press[1:]).sum() > band:
        return None
    clock = Clock.of(slider.frequency, slider.phase, duration)
    terms, last = clock.taylor(slider.press), clock.instant(duration)
    if not (terms @ clock.waves((0, 0.0)))[0] > band:
        return 0.0
    for cell in range(last[0] + 1):
        c = (terms @ clock.waves((cell, 0.0))).tolist()
        fall = first_fall(c, band, last[1] if cell == last[0] else 1.0)
        if fall is not None:
            return clock.time((cell, fall))
    return None


def _laws(slider: Slider, clock: Clock) -> dict[State, Law]:
    """The law of each state; see Slider. Without friction the one state is STUCK, closed.

    Slip along sigma ends when it would turn: the guard is sigma times its speed. Rest ends when a
    slip could grow: the guards are the decelerations of both slips, over a cell.
    """
    if not slider.mu > 0:
        return {State.STUCK: Law(_placed(clock, slider.push)[None], ())}
    friction, wall = slider.mu * slider.press, slider.base @ slider.along
    motion = _padded(clock.taylor(np.concatenate(((0.0,), wall))))
    held = motion.copy()
    held[0], held[0, -2] = 0.0, 1.0
    laws = {}
    for state in (State.SLIP_FORWARD, State.SLIP_BACKWARD):
        place = _placed(clock, slider.push - state.sign * friction)
        speed = state.sign * clock.rate * _derived(place - motion)
        laws[state] = Law(np.array([place, speed]), (State.STUCK,))
    grow = [(slider.pull - friction) / clock.rate, (slider.pull + friction) / clock.rate]
    rest = np.array([held, _padded(-clock.taylor(grow[0])), _padded(clock.taylor(grow[1]))])
    return {State.STUCK: Law(rest, tuple(laws)), **laws}


def _placed(clock: Clock, acceleration: Vector) -> Vector:
    """The map to the place under the acceleration of a row."""
    maps = np.zeros((ORDER + 1, 3 + 2 * len(clock.phase)))
    steps = (RANK[2:] * (RANK[2:] - 1))[:, None] * clock.rate**2
    maps[2:, :-2] = clock.taylor(acceleration)[:-2] / steps
    maps[0, -2] = 1.0
    maps[1, -1] = 1 / clock.rate
    return maps


def _padded(maps: Vector) -> Vector:
    """A map from waves as one from waves, place and speed."""
    return np.pad(maps, ((0, 0), (0, 2)))


def _derived(maps: Vector) -> Vector:
    """The map to the derivative in cells."""
    return np.vstack((maps[1:] * RANK[1:, None], 0 * maps[:1]))


def _start(slider: Slider, clock: Clock) -> Now:
    """The state at t = 0."""
    state = {0: State.STUCK, 1: State.SLIP_FORWARD, -1: State.SLIP_BACKWARD}[
        slider.sign if slider.mu > 0 else 0
    ]
    strength = np.abs(slider.pull) + np.abs(slider.push) + slider.mu * np.abs(slider.press)
    fastest = abs(slider.speed) + float(strength.sum()) / clock.rate
    return Now((0, 0.0), 0.0, slider.speed, state, fastest)


def _next_event(law: Law, guards: Vector, band: float, end: float) -> tuple[State | None, float]:
    """The state after the guard that falls first, and when; or None and `end`, in cells."""
    found = None
    if len(guards):
        least = ((guards * end**RANK) @ ENCLOSING).min(axis=1)
        for g in np.flatnonzero(least < -band / 4):
            fall = first_fall(guards[g].tolist(), band, end)
            if fall is not None:
                found, end = law.after[g], fall
    return found, end


def _moved(now: Now, clock: Clock, series: Vector, x: float, arrival: Instant, state: State) -> Now:
    """The state x cells later, on arrival at an instant."""
    if x == 0:
        return replace(now, instant=arrival, state=state)
    terms = series * x**RANK
    speed = float(RANK @ terms) * clock.rate / x
    return Now(arrival, float(terms.sum()), speed, state, max(now.fastest, abs(speed)))


def _check(time: float, steps: int, events: int) -> None:
    """Raise StoppedError if the events or the steps have become too many."""
    at = f"by t = {time:.6g} s"
    if events > CHATTER:
        raise StoppedError(f"events accumulate: more than {CHATTER} in a quarter period {at}")
    if steps > STEPS:
        raise StoppedError(
            f"the motion is too quick for its duration: more than {STEPS} steps {at}"
        )
