"""Follows a slip that turns from piece to piece; a piece is a Taylor polynomial of the place."""

from __future__ import annotations

import math

import numpy as np

from vv.engines.exact.turn.rest import end_of_rest, slack
from vv.engines.exact.turn.series import (
    ORDER,
    OVER,
    REACH,
    SERIES,
    angle,
    expand_drive,
    expand_slip,
    expand_start,
)
from vv.engines.kernels.compiled import compiled, lent
from vv.scene import Vector

REST, SLIP = 0, 1
ENDED, FULL, TOUCHED = 0, 1, 2  # TOUCHED: |T| reaches F and does not rise above it in first order
LEFT = 0.1  # of the velocity, over a step
SHORTER = 0.85  # a step that leaves less is shortened by this
LONGEST = 30.0  # of a step in its unit of time: what drive and friction balance grows slowly
CELL = 1.5  # [rad] of the quickest sine: pieces of rest are no longer


@compiled
def follow_turning(
    rows: Vector,
    sines: Vector,
    w: Vector,
    tiny: float,
    band: float,
    duration: float,
    starts: Vector,
    states: Vector,
    series: Vector,
) -> tuple[int, int, float]:
    """The outcome, the number p of pieces and the time reached [s].

    rows (3, 1 + k) [m/s2]: the two parts of T and F as constants and amplitudes of k sines (k, 4),
    see `angle`. w: (2,) the slip's velocity at t = 0 [m/s], overwritten; below tiny [m/s] it is
    none. band [m2/s4]: the rounding of F^2 - |T|^2. Filled: starts (most, 3), when each piece
    starts [s], its unit of time h [s] and its end in that unit; states (most,); series (most, ORDER
    + 1, 2), of its place [m]. It is one function since each piece updates nearly all of its
    variables.
    """
    t, count, place = 0.0, 0, np.zeros(2)
    drive, work, looked = np.empty((3, ORDER + 1)), np.empty((SERIES, ORDER)), np.empty(3)
    velocity, turned, shape = np.empty((2, ORDER)), np.empty((3, ORDER + 1)), np.empty((2, ORDER))
    quickest = sines[:, 3].max() if len(sines) else 0.0
    rubs = np.abs(rows[2]).max() > 0
    moves = not rubs or math.hypot(w[0], w[1]) > tiny
    while t < duration:
        if count == len(starts):
            return FULL, count, t
        if moves:
            pace = _pace(rows, sines, t, drive)
            h = min(duration, 1 / quickest if quickest > 0 else duration)
            if rubs:
                h = min(h, math.hypot(w[0], w[1]) / pace)
            expand_drive(rows, sines, t, h, drive)
            velocity[:, 0] = w
            end = min(_step_of_slip(drive, h, velocity, work, rubs), (duration - t) / h)
        else:
            slack(rows, sines, t, looked)
            power = 1 if looked[0] < -band else 2
            if looked[0] > band or (power == 2 and looked[1] >= 0):
                last = end_of_rest(rows, sines, t, duration, band, looked)
                cell = CELL / quickest if quickest > 0 else duration
                while t < last and count < len(starts):
                    h = min(cell, last - t)
                    _keep(starts, states, series, count, t, h, 1.0, REST)
                    series[count, :, :] = 0.0
                    series[count, 0] = place
                    count += 1
                    t = last if h == last - t else t + h
                if t >= duration or count == len(starts):
                    continue
                power = 2
            h = 1 / quickest if quickest > 0 else duration
            expand_drive(rows, sines, t, h, drive)
            end = _step_of_start(drive, h, power, velocity, turned, shape, work)
            if not end > 0:
                return TOUCHED, count, t
            end, moves = min(end, (duration - t) / h), True
        then = duration if end >= (duration - t) / h else t + end * h
        end = (then - t) / h  # so that the piece ends where the next one starts, to rounding of h
        _keep(starts, states, series, count, t, h, end, SLIP)
        _integrate(velocity, h, place, series[count])
        _advance(velocity, series[count], end, w, place)
        count += 1
        t = then
        if rubs and math.hypot(w[0], w[1]) <= tiny:
            w[:], moves = 0.0, False
    return ENDED, count, t


@lent
def _keep(
    starts: Vector,
    states: Vector,
    series: Vector,
    count: int,
    t: float,
    h: float,
    end: float,
    state: int,
) -> None:
    starts[count, 0], starts[count, 1], starts[count, 2] = t, h, end
    states[count] = state


@lent
def _pace(rows: Vector, sines: Vector, t: float, work: Vector) -> float:
    """What |w'| does not exceed at time t [m/s2]."""
    for r in range(3):
        work[r, 0] = rows[r, 0]
    for i in range(len(sines)):
        sine = math.sin(angle(sines, i, t))
        for r in range(3):
            work[r, 0] += rows[r, 1 + i] * sine
    pull, press = math.hypot(work[0, 0], work[1, 0]), abs(work[2, 0])
    return float(pull + press)


@lent
def _step_of_slip(drive: Vector, h: float, w: Vector, work: Vector, rubs: bool) -> float:
    """The step in units of h that the series of w, (2, ORDER), bears; fills the series."""
    if not rubs:
        for n in range(ORDER - 1):
            w[0, n + 1] = h * drive[0, n] / (n + 1)
            w[1, n + 1] = h * drive[1, n] / (n + 1)
        return CELL
    expand_slip(drive, h, w, work)
    speed = math.hypot(w[0, 0], w[1, 0])
    end = LONGEST
    for n in range(ORDER - 2, ORDER):
        size = math.hypot(w[0, n], w[1, n])
        if size > 0:
            end = min(end, REACH * (speed / size) ** (1.0 / n))
    return _kept_from_rest(w, speed, end)


@lent
def _kept_from_rest(w: Vector, speed: float, end: float) -> float:
    """The part of a step in which the velocity w surely keeps a share LEFT of itself.

    w/|w| is singular at rest, which the series of a slip along a line does not show.
    """
    x, y = w[0, 0] / speed, w[1, 0] / speed
    while True:
        least = speed + min(0.0, x * w[0, 1] + y * w[1, 1]) * end
        power = end
        for n in range(2, ORDER):
            power *= end
            least -= abs(x * w[0, n] + y * w[1, n]) * power
        if least >= LEFT * speed:
            return end
        end *= SHORTER


@lent
def _step_of_start(
    drive: Vector,
    h: float,
    power: int,
    w: Vector,
    turned: Vector,
    shape: Vector,
    work: Vector,
) -> float:
    """The step in units of h that the series of a start from rest bears; 0 if there is none.

    w: (2, ORDER) filled; turned: (3, ORDER + 1), shape: (2, ORDER) and work: for work.
    """
    pull = math.hypot(drive[0, 0], drive[1, 0])
    x, y = drive[0, 0] / pull, drive[1, 0] / pull
    for n in range(ORDER + 1):
        turned[0, n] = x * drive[0, n] + y * drive[1, n]
        turned[1, n] = x * drive[1, n] - y * drive[0, n]
        turned[2, n] = drive[2, n]
    turned[1, 0] = 0.0
    v, z = shape[0], shape[1]
    expand_start(turned, h, power, v, z, work)
    if not v[0] > 0:
        return 0.0
    end = CELL
    for n in range(ORDER - 4, ORDER - 1):
        if v[n] != 0:
            end = min(end, REACH * abs(v[0] / v[n]) ** (1.0 / n))
        if z[n] != 0:
            end = min(end, REACH * abs(1 / z[n]) ** (1.0 / n))
    w[:, :] = 0.0
    for n in range(ORDER - power):
        across = 0.0
        for i in range(n + 1):
            across += v[i] * z[n - i]
        w[0, n + power] = x * v[n] - y * across
        w[1, n + power] = y * v[n] + x * across
    return end


@lent
def _integrate(w: Vector, h: float, place: Vector, out: Vector) -> None:
    """The series (ORDER + 1, 2) of the place [m] from that of its rate [m/s]."""
    for a in range(2):
        out[0, a] = place[a]
        for n in range(ORDER):
            out[n + 1, a] = h * OVER[n] * w[a, n]


@lent
def _advance(velocity: Vector, series: Vector, x: float, w: Vector, place: Vector) -> None:
    """The slip's velocity and place after the part x of a piece."""
    for a in range(2):
        rate, travel = 0.0, 0.0
        for n in range(ORDER - 1, -1, -1):
            rate = rate * x + velocity[a, n]
            travel = travel * x + series[n + 1, a]
        w[a] = rate
        place[a] += travel * x
