"""Computes the motion of a slider by Taylor steps within quarter periods, from event to event."""

from __future__ import annotations

import math

import numpy as np

from vv.engines.exact.guards import GUARD_ROUNDING
from vv.engines.exact.modes import BACKWARD, FORWARD, STUCK, Index, sign_of
from vv.engines.exact.roots import first_descent
from vv.engines.exact.slide.clock import ORDER
from vv.engines.kernels.compiled import compiled, lent
from vv.scene import Vector

ENDED, FULL, CROWDED = range(3)
DRIVE, RELATIVE, FRICTION, BASE = range(4)


@compiled
def follow_line(
    rows: Vector,
    angles: Vector,
    turn: Vector,
    rate: float,
    last: float,
    initial: tuple[float, int, float],
    most: int,
    starts: Vector,
    states: Index,
    series: Vector,
) -> tuple[int, int]:
    """The outcome and the number p of pieces.

    rows (4, 1 + k): the acceleration of the body along the slip without friction, the same relative
    to the wall, mu times the pressing [m/s2], and the position of the wall [m], each as a constant
    and amplitudes of k sines. angles (cells, k), turn (k,) [rad]: the phases of the sines at the
    start of each cell, and their change in a cell. rate: cells per second; last: the part of the
    last cell at which the motion ends. initial: speed [m/s], state and fastest speed [m/s] at t =
    0. most: number of events allowed in a cell. Filled: starts (room, 3), the cell and part at
    which a piece starts and its length in cells; states (room,); series (room, ORDER + 1) [m]. It
    is one function since each piece updates nearly all of its variables.
    """
    speed, state, fastest = initial
    place, cell, part, count, events = 0.0, 0, 0.0, 0, 0
    known, guard = np.empty((4, ORDER + 1)), np.empty(ORDER + 1)
    rubs = np.abs(rows[FRICTION]).max() > 0
    while cell < len(angles):
        if count == len(starts):
            return FULL, count
        whole = last if cell == len(angles) - 1 else 1.0
        y, end, after = series[count], whole - part, state
        _expand(rows, angles[cell], turn, part, known)
        _place(known, state, rubs, place, speed, rate, y)
        band = GUARD_ROUNDING * fastest
        if state != STUCK:
            _slipping(known, y, sign_of(state) * rate, guard)
            fall = first_descent(guard, band, end)
            if fall <= end:
                end, after = fall, STUCK
        elif rubs:
            for sign in (1.0, -1.0):
                for n in range(ORDER + 1):
                    guard[n] = (known[FRICTION, n] - sign * known[RELATIVE, n]) / rate
                fall = first_descent(guard, band, end)
                if fall <= end:
                    end, after = fall, FORWARD if sign > 0 else BACKWARD
        if end > 0:
            starts[count, 0], starts[count, 1], starts[count, 2] = cell, part, end
            states[count] = state
            count += 1
            place, speed = _advance(y, end, rate)
            fastest = max(fastest, abs(speed))
        if after == state:
            cell, part, events = cell + 1, 0.0, 0
        else:
            part, state, events = part + end, after, events + 1
            if events > most:
                return CROWDED, count
    return ENDED, count


@lent
def _expand(rows: Vector, angle: Vector, turn: Vector, part: float, known: Vector) -> None:
    """Fill known (4, ORDER + 1) with the series of the rows about a part of a cell."""
    known[:, :] = 0.0
    for r in range(4):
        known[r, 0] = rows[r, 0]
    for i in range(len(turn)):
        now, size = angle[i] + turn[i] * part, 1.0
        sine, cosine = math.sin(now), math.cos(now)
        for n in range(ORDER + 1):
            value = size * (cosine if n % 2 else sine) * (-1.0 if n % 4 > 1 else 1.0)
            for r in range(4):
                known[r, n] += rows[r, 1 + i] * value
            size *= turn[i] / (n + 1)


@lent
def _place(
    known: Vector, state: int, rubs: bool, place: float, speed: float, rate: float, y: Vector
) -> None:
    """Fill y (ORDER + 1,), the series of the body's position [m], whether it slips or sticks."""
    y[0] = place
    if rubs and state == STUCK:
        for n in range(1, ORDER + 1):
            y[n] = known[BASE, n]
        return
    y[1] = speed / rate
    for n in range(ORDER - 1):
        pull = known[DRIVE, n] - sign_of(state) * known[FRICTION, n]
        y[n + 2] = pull / (rate * rate * (n + 1) * (n + 2))


@lent
def _slipping(known: Vector, y: Vector, scale: float, guard: Vector) -> None:
    """Fill guard (ORDER + 1,), the series of the velocity of slip [m/s] times its initial sign."""
    for n in range(ORDER):
        guard[n] = scale * (n + 1) * (y[n + 1] - known[BASE, n + 1])
    guard[ORDER] = 0.0


@lent
def _advance(y: Vector, x: float, rate: float) -> tuple[float, float]:
    """Position [m] and speed [m/s] at the part x of a piece."""
    place = moving = 0.0
    for n in range(ORDER, 0, -1):
        place = place * x + y[n]
        moving = moving * x + n * y[n]
    return y[0] + place * x, moving * rate
