"""Follows a system from event to event, in Taylor steps that end where a contact changes."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass

import numpy as np

from vv.engines.exact.modes import ORDER, Guard, Mode, State, States, make_mode, quickest_step
from vv.engines.exact.path import Path, Piece
from vv.engines.exact.roots import EPS, first_fall
from vv.engines.exact.system import System
from vv.scene import Vector

BAND = 512 * EPS  # a guard negative by less, over the lengths it is made of, is still zero
EVENTS = 50_000  # in one run; more means that events accumulate
STEPS = 200_000  # in one run
RANK = np.arange(1.0, ORDER + 1)


class StoppedError(Exception):
    """The motion cannot be followed further; the message is the reason."""


@dataclass(frozen=True)
class Now:
    """The state between two pieces of a motion.

    time [s]; q, v: (n,) [m, m/s]; states of the contacts; lengths: (c + s + h,) gaps and
    stretches of springs and ties [m], carried on their own so that small overlaps do not drown
    in large displacements; scale: the largest deflection met or to be expected [m].
    """

    time: float
    q: Vector
    v: Vector
    states: States
    lengths: Vector
    scale: float


def follow(system: System, duration: float) -> Path:
    """The motion of a system over a duration [s]; raises StoppedError if it cannot be followed."""
    modes: dict[States, Mode] = {}
    now, quick = _start(system), min(quickest_step(system), duration)
    pieces: list[Piece] = []
    events = 0
    while True:
        mode = modes.get(now.states)
        if mode is None:
            mode = modes[now.states] = make_mode(system, now.states, duration)
        series, now = _expand(system, mode, now, quick)
        left = (duration - now.time) / mode.h
        guard, x = _next_event(system, mode, now, series, min(1.0, left))
        if x > 0:
            pieces.append(Piece(now.time, mode.h, x, series, now.states, now.lengths))
            now = _moved(system, now, mode, series, x)
        if guard is None and left <= 1:
            return Path.joined(system, pieces)
        if guard is not None:
            now = _changed(system, now, mode.guards[guard])
            events += 1
        _check(now, len(pieces), events)


def _start(system: System) -> Now:
    """The state at t = 0, with slack shear springs."""
    states = tuple(State.STUCK if gap < 0 else State.OPEN for gap in system.gap)
    lengths = np.concatenate((system.gap, np.zeros(len(system.springs)), system.ties.stretch))
    return Now(0.0, np.zeros(len(system.mass)), system.velocity, states, lengths, 0.0)


def _expand(system: System, mode: Mode, now: Now, quick: float) -> tuple[Vector, Now]:
    """Taylor coefficients (ORDER + 1, n) [m] of the displacements over a step of the mode."""
    force = system.weight + system.load - mode.drag @ now.v + mode.push @ now.lengths
    first, second = mode.h * now.v, (mode.h * mode.h / 2) * force / system.mass
    rest = mode.series @ np.concatenate((first, second))
    sizes = np.abs(np.concatenate((quick * now.v, quick * quick * force / system.mass)))
    if not np.isfinite(rest).all():
        raise StoppedError(f"the motion leaves the range of numbers at t = {now.time:.6g} s")
    series = np.vstack((now.q, rest.reshape(ORDER, -1)))
    return series, dataclasses.replace(now, scale=max(now.scale, float(sizes.max())))


def _moved(system: System, now: Now, mode: Mode, series: Vector, x: float) -> Now:
    """The state at x in the step's own time."""
    powers = x**RANK
    travel = powers @ series[1:]
    return dataclasses.replace(
        now,
        time=now.time + x * mode.h,
        q=now.q + travel,
        v=(RANK * powers / x) @ series[1:] / mode.h,
        lengths=now.lengths + system.rows @ travel,
    )


def _changed(system: System, now: Now, guard: Guard) -> Now:
    """The state after a guard fell, with what it watched put to its exact value.

    That is a gap of zero in a contact that closes or opens, and a stretch of zero or of the cap
    mu kn U/ks in a spring that begins to stick.
    """
    c, after = guard.contact, guard.after
    if after is None:
        bodies = "bodies {} and {}".format(*(system.names + system.ties.names)[c])
        raise StoppedError(f"the centres of {bodies} meet at t = {now.time:.6g} s")
    before = now.states[c]
    lengths = now.lengths.copy()
    if State.OPEN in (before, after):
        lengths[c] = 0.0
    if after is State.STUCK and c in system.springs:
        spring = len(now.states) + system.springs.index(c)
        lengths[spring] = -before.sign * system.ratio * lengths[c]
    states = (*now.states[:c], after, *now.states[c + 1 :])
    return dataclasses.replace(now, states=states, lengths=lengths)


def _check(now: Now, steps: int, events: int) -> None:
    """Raise StoppedError if the events or the steps have become too many."""
    at = f"by t = {now.time:.6g} s"
    if events > EVENTS:
        raise StoppedError(f"events accumulate: more than {EVENTS} {at}")
    if steps > STEPS:
        raise StoppedError(
            f"the motion is too quick for its duration: more than {STEPS} steps {at}"
        )


def _next_event(
    system: System, mode: Mode, now: Now, series: Vector, end: float
) -> tuple[int | None, float]:
    """The guard that falls first and when, or None and `end`; x in the step's own time."""
    lengths = system.rows @ series.T
    lengths[:, 0] = now.lengths
    reach = np.abs(system.rows).sum(axis=1)
    guards = mode.values @ lengths
    guards[:, 0] += mode.offset
    bands = np.abs(mode.values) @ (reach * now.scale + np.abs(now.lengths))
    pace = max(now.scale, float(np.abs(series[1:3]).max()))
    if mode.late.any():
        late = mode.late / mode.h
        guards[:, :-1] += late[:, None] * (mode.values @ (lengths[:, 1:] * RANK))
        bands += late * (np.abs(mode.values) @ reach * pace)
    if len(mode.rates):
        rates = mode.rates @ (lengths[:, 1:] * RANK)
        guards = np.vstack((guards, np.pad(rates, ((0, 0), (0, 1)))))
        bands = np.concatenate((bands, np.abs(mode.rates) @ reach * pace))
    bands *= BAND
    found = None
    for g in np.flatnonzero(np.abs(guards[:, 1:]).sum(axis=1) > guards[:, 0] + bands):
        fall = first_fall(guards[g].tolist(), float(bands[g]), end)
        if fall is not None:
            found, end = int(g), fall
    return found, end
