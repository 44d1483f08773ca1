"""Integrates a system from event to event, by Taylor steps that end where a contact changes."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass

import numpy as np

from vv.engines.exact.modes import ORDER, Guard, Mode, State, States, make_mode, quickest_step
from vv.engines.exact.path import Path, Piece
from vv.engines.exact.roots import EPS, first_descent_below_zero
from vv.engines.exact.system import System
from vv.scene import Vector

GUARD_ROUNDING = 512 * EPS  # of the lengths in a guard: one that is negative by less is zero
MOST_EVENTS = 50_000  # in one run; more are taken for an accumulation
MOST_STEPS = 200_000  # in one run
POWER = np.arange(1.0, ORDER + 1)


class StoppedError(Exception):
    """The motion cannot be followed further; the message is the reason."""


@dataclass(frozen=True)
class Moment:
    """The state between two pieces of a motion.

    time [s]; q, v: (n,) [m, m/s]; states of the contacts; lengths: (c + s + h,) gaps and
    stretches of shear and bond springs [m], integrated on their own so that small overlaps are
    not lost in the rounding of large displacements; scale: the largest deflection so far or
    expected [m].
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


def _start(system: System) -> Moment:
    """The state at t = 0, with slack shear springs."""
    states = tuple(State.STUCK if gap < 0 else State.OPEN for gap in system.gap)
    lengths = np.concatenate(
        (system.gap, np.zeros(len(system.springs)), system.bond_springs.stretch)
    )
    return Moment(0.0, np.zeros(len(system.mass)), system.velocity, states, lengths, 0.0)


def _expand(system: System, mode: Mode, now: Moment, quick: float) -> tuple[Vector, Moment]:
    """Taylor coefficients (ORDER + 1, n) [m] of the displacements over a step of the mode."""
    force = system.weight + system.load - mode.drag @ now.v + mode.push @ now.lengths
    first, second = mode.h * now.v, (mode.h * mode.h / 2) * force / system.mass
    rest = mode.series @ np.concatenate((first, second))
    sizes = np.abs(np.concatenate((quick * now.v, quick * quick * force / system.mass)))
    if not np.isfinite(rest).all():
        raise StoppedError(f"the motion leaves the range of numbers at t = {now.time:.6g} s")
    series = np.vstack((now.q, rest.reshape(ORDER, -1)))
    return series, dataclasses.replace(now, scale=max(now.scale, float(sizes.max())))


def _moved(system: System, now: Moment, mode: Mode, series: Vector, x: float) -> Moment:
    """The state after the part x of a step."""
    powers = x**POWER
    travel = powers @ series[1:]
    return dataclasses.replace(
        now,
        time=now.time + x * mode.h,
        q=now.q + travel,
        v=(POWER * powers / x) @ series[1:] / mode.h,
        lengths=now.lengths + system.rows @ travel,
    )


def _changed(system: System, now: Moment, guard: Guard) -> Moment:
    """The state after an event, with the length that its guard watched set to the exact value.

    A contact that closes or opens has a gap of zero; a spring that begins to stick has the
    stretch mu kn U/ks of the friction limit, or zero.
    """
    c, after = guard.contact, guard.after
    if after is None:
        bodies = "bodies {} and {}".format(*(system.names + system.bond_springs.names)[c])
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


def _check(now: Moment, steps: int, events: int) -> None:
    """Raise StoppedError if there are too many events or steps."""
    at = f"by t = {now.time:.6g} s"
    if events > MOST_EVENTS:
        raise StoppedError(f"events accumulate: more than {MOST_EVENTS} {at}")
    if steps > MOST_STEPS:
        raise StoppedError(
            f"the duration is too long for so fast a motion: more than {MOST_STEPS} steps {at}"
        )


def _next_event(
    system: System, mode: Mode, now: Moment, series: Vector, end: float
) -> tuple[int | None, float]:
    """The number of the guard that first becomes negative and the part x of the step, or None
    and `end`.
    """
    lengths = system.rows @ series.T
    lengths[:, 0] = now.lengths
    reach = np.abs(system.rows).sum(axis=1)
    guards = mode.values @ lengths
    guards[:, 0] += mode.offset
    bands = np.abs(mode.values) @ (reach * now.scale + np.abs(now.lengths))
    pace = max(now.scale, float(np.abs(series[1:3]).max()))
    if mode.delay.any():
        delay = mode.delay / mode.h
        guards[:, :-1] += delay[:, None] * (mode.values @ (lengths[:, 1:] * POWER))
        bands += delay * (np.abs(mode.values) @ reach * pace)
    if len(mode.rates):
        rates = mode.rates @ (lengths[:, 1:] * POWER)
        guards = np.vstack((guards, np.pad(rates, ((0, 0), (0, 1)))))
        bands = np.concatenate((bands, np.abs(mode.rates) @ reach * pace))
    bands *= GUARD_ROUNDING
    found = None
    for g in np.flatnonzero(np.abs(guards[:, 1:]).sum(axis=1) > guards[:, 0] + bands):
        fall = first_descent_below_zero(guards[g].tolist(), float(bands[g]), end)
        if fall is not None:
            found, end = int(g), fall
    return found, end
