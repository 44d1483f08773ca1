"""Computes the motion of a system by Taylor steps that end where a contact changes its state."""

from __future__ import annotations

import numpy as np

from vv.engines.exact.guards import MET, NONE, next_event
from vv.engines.exact.modes import (
    OPEN,
    STUCK,
    Equations,
    Index,
    press,
    sign_of,
    slow,
    step,
    stretch,
)
from vv.engines.kernels.compiled import compiled, lent
from vv.scene import Vector

ORDER = 28  # of the Taylor series, whose terms decay like 2^k/k!: the last is 1e-21 of the first
ENDED, FULL, BEYOND, MEETING, CROWDED = range(5)


@compiled
def follow_system(  # noqa: PLR0912, PLR0915 - one loop, whose parts share all its variables
    equations: Equations,
    velocity: Vector,
    lengths: Vector,
    states: Index,
    duration: float,
    most: int,
    starts: Vector,
    piece_states: Index,
    piece_lengths: Vector,
    series: Vector,
) -> tuple[int, int, float, int]:
    """The outcome, the number p of pieces, the time reached [s] and the contact that stopped it.

    velocity (n,) [m/s], lengths (c + s + h,) [m] and states (c,): at t = 0, overwritten. most: the
    number of changes of state that is allowed. Filled, up to `room` pieces: starts (room, 3), the
    time at which a piece starts [s], its unit of time h [s] and its end in that unit; piece_states
    (room, c); piece_lengths (room, c + s + h), its initial lengths [m]; series (room, ORDER + 1, n)
    [m]. It is one function since each piece updates nearly all of its variables.
    """
    n, wide = len(velocity), len(lengths)
    position, force, drag = np.zeros(n), np.empty(n), np.empty(n)
    stiff, slows = np.empty((n, n)), np.empty((n, n))
    length_series, column = np.empty((wide, ORDER + 1)), np.empty(wide)
    sizes, rates, work = np.empty(wide), np.empty(wide), np.empty(ORDER + 1)
    closed = np.full(len(states), STUCK)
    reach = np.zeros(wide)
    for k in range(n):
        force[:] = 0.0
        force[k] = 1.0
        stretch(equations, force, column)
        for i in range(wide):
            reach[i] += abs(column[i])
    least_step = min(step(equations, closed, stiff, slows), duration)
    t, count, events, scale, states_changed, h = 0.0, 0, 0, 0.0, True, 0.0
    while t < duration:
        if count == len(starts):
            return FULL, count, t, 0
        if states_changed:
            h, states_changed = min(step(equations, states, stiff, slows), duration), False
        y = series[count]
        for a in range(n):
            y[0, a], y[1, a] = position[a], h * velocity[a]
        press(equations, states, lengths, force)
        slow(equations, states, velocity, drag)
        for a in range(n):
            pull = (equations.load[a] + force[a] - drag[a]) / equations.mass[a]
            y[2, a] = h * h / 2 * pull
            scale = max(scale, abs(least_step * velocity[a]), abs(least_step * least_step * pull))
        _expand(equations, states, h, y, length_series, column, force, drag)
        if not _finite(y):
            return BEYOND, count, t, 0
        pace = scale
        for a in range(n):
            pace = max(pace, abs(y[1, a]), abs(y[2, a]))
        for i in range(wide):
            length_series[i, 0] = lengths[i]
            sizes[i] = reach[i] * scale + abs(lengths[i])
            rates[i] = reach[i] * pace
        left = (duration - t) / h
        contact, after, x = next_event(
            equations, states, length_series, sizes, rates, h, min(1.0, left), work
        )
        if x > 0:
            starts[count, 0], starts[count, 1], starts[count, 2] = t, h, x
            for c in range(len(states)):
                piece_states[count, c] = states[c]
            for i in range(wide):
                piece_lengths[count, i] = lengths[i]
            count += 1
            t += x * h
            _advance(y, x, h, position, velocity, force)
            stretch(equations, force, column)
            for i in range(wide):
                lengths[i] += column[i]
        if after == NONE:
            t = duration if left <= 1 else t
        elif after == MET:
            return MEETING, count, t, contact
        else:
            _change(equations, states, lengths, contact, after)
            states_changed = True
            events += 1
            if events > most:
                return CROWDED, count, t, 0
    return ENDED, count, t, 0


@lent
def _expand(
    equations: Equations,
    states: Index,
    h: float,
    y: Vector,
    length_series: Vector,
    column: Vector,
    force: Vector,
    drag: Vector,
) -> None:
    """Fill the series y (ORDER + 1, n) from its first three rows, and that of the lengths.

    The recursion (k+1)(k+2) y[k+2] = pull y[k] - (k+1) drag y[k+1] holds from k = 1; constant
    forces are in y[2]. length_series: (c + s + h, ORDER + 1), filled from k = 1.
    """
    for k in range(1, ORDER + 1):
        stretch(equations, y[k], column)
        for i in range(len(column)):
            length_series[i, k] = column[i]
        if k < ORDER - 1:
            press(equations, states, column, force)
            slow(equations, states, y[k + 1], drag)
            for a in range(len(force)):
                turned = (h * h * force[a] - (k + 1) * h * drag[a]) / equations.mass[a]
                y[k + 2, a] = turned / ((k + 1) * (k + 2))


@lent
def _finite(y: Vector) -> bool:
    """Whether all numbers are finite: 0 times any other is not 0."""
    total = 0.0
    for k in range(len(y)):
        for a in range(y.shape[1]):
            total += 0.0 * y[k, a]
    return total == 0.0


@lent
def _advance(
    y: Vector, x: float, h: float, position: Vector, velocity: Vector, travel: Vector
) -> None:
    """Move position and velocity to the part x of a step; fill travel, the displacement (n,)."""
    for a in range(len(position)):
        moved, rate = 0.0, 0.0
        for k in range(ORDER, 0, -1):
            moved = (moved + y[k, a]) * x
            rate = rate * x + k * y[k, a]
        travel[a] = moved
        position[a] += moved
        velocity[a] = rate / h


@lent
def _change(equations: Equations, states: Index, lengths: Vector, contact: int, after: int) -> None:
    """Set the state of a contact, and its gap or stretch to the exact value at the event.

    A contact that closes or opens has a gap of zero; a shear spring that begins to stick has the
    stretch mu kn U/ks of the friction limit, or zero if the contact has just closed.
    """
    before, spring = states[contact], equations.spring[contact]
    if OPEN in (before, after):
        lengths[contact] = 0.0
    if after == STUCK and spring >= 0:
        slipped = -sign_of(before) * equations.ratio
        lengths[len(states) + spring] = slipped * lengths[contact] if slipped != 0 else 0.0
    states[contact] = after
