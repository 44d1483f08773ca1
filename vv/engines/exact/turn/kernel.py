"""Computes a slip that changes direction, piece by piece, each a Taylor polynomial of its path.

The path gives position and time as functions of a parameter. The parameter is time where the body
rests, begins to slip or slips without friction; elsewhere it is tau, in which series have a larger
radius of convergence (see `slipping`).
"""

from __future__ import annotations

import math

import numpy as np

from vv.engines.exact.turn.rest import end_of_rest, friction_margin
from vv.engines.exact.turn.series import (
    ORDER,
    OVER,
    REACH,
    expand_drive,
    expand_start,
)
from vv.engines.exact.turn.slipping import FIRST, FURTHER, SPEED, expand_slip
from vv.engines.exact.turn.slipping import SLIP as WAY
from vv.engines.kernels.compiled import compiled_to_join, lent
from vv.scene import Vector

REST, SLIP = 0, 1
ENDED, FULL, TOUCHED = 0, 1, 2  # TOUCHED: |T| reaches F but does not exceed it in first order
LAST = 1e-16  # last term of a series over its first: less than rounding
RESOLVED = 1e-8  # relative error of a piece's duration: larger than rounding of the time, and small
# enough for one Newton step to make it less than rounding
LONGEST = 30.0  # longest step in its unit: a slip that grows slowly has a large radius
CELL = 1.5  # [rad] of the quickest sine: the longest piece of rest or without friction


@compiled_to_join
def follow_turning(
    rows: Vector,
    sines: Vector,
    initial: Vector,
    tiny: float,
    band: float,
    duration: float,
    starts: Vector,
    states: Vector,
    series: Vector,
) -> tuple[int, int, float]:
    """The outcome, the number p of pieces and the time reached [s].

    rows (3, 1 + k) [m/s2]: the two components of T, and F, as constants and amplitudes of k sines
    (k, 4), see `angle` and `expand_slip`. initial: (2,) velocity of slip at t = 0 [m/s], which is
    zero below tiny [m/s]. band [m2/s4]: rounding of F^2 - |T|^2. Filled: starts (most, 2), the time
    at which a piece starts [s] and the end of its parameter x, which starts at 0; states (most,);
    series (most, ORDER + 1, 3) in x, of position [m] and of time since the start of the piece [s].
    It is one function since each piece updates nearly all of its variables.
    """
    t, count, place, w = 0.0, 0, np.zeros(2), initial.copy()
    drive, work, margin = np.empty((3, ORDER + 1)), np.empty((2, ORDER)), np.empty(3)
    turned, shape = np.empty((3, ORDER + 1)), np.empty((2, ORDER))
    room = FURTHER + 2 * (len(sines) - FIRST)
    velocity, slip = np.zeros((ORDER + 1, room)), np.zeros((ORDER + 1, room))
    sums = np.zeros(room)
    quickest = sines[:, 3].max()
    unit = 1 / quickest if quickest > 0 else duration
    rubs = np.abs(rows[2]).max() > 0
    moves = not rubs or math.hypot(w[0], w[1]) > tiny
    while t < duration:
        if count == len(starts):
            return FULL, count, t
        rates = velocity
        if moves and rubs:
            slip[0, WAY], slip[0, WAY + 1] = w[0], w[1]
            expand_slip(rows, sines, t, min(duration, unit), slip, sums, series[count])
            end, rates = _step_of_slip(slip), slip
        elif moves:
            expand_drive(rows, sines, t, unit, drive)
            end = _step_without_friction(drive, unit, w, velocity)
        else:
            friction_margin(rows, sines, t, margin)
            power = 1 if margin[0] < -band else 2
            if margin[0] > band or (power == 2 and margin[1] >= 0):
                last = end_of_rest(rows, sines, t, duration, band, margin)
                count, t = _rest(t, last, CELL * unit, place, starts, states, series, count)
                if t >= duration or count == len(starts):
                    continue
                power = 2
            expand_drive(rows, sines, t, unit, drive)
            end = _step_of_start(drive, unit, power, velocity, turned, shape, work)
            if not end > 0:
                return TOUCHED, count, t
            moves = True
        if rates is velocity:
            _integrate(velocity, unit, series[count])
        starts[count, 0], states[count] = t, SLIP
        t, end = _end_of_piece(series[count], end, t, duration)
        starts[count, 1] = end
        _advance(rates, series[count], end, w, place)
        count += 1
        if rubs and math.hypot(w[0], w[1]) <= tiny:
            w[:], moves = 0.0, False
    return ENDED, count, t


@lent
def _rest(
    t: float,
    last: float,
    cell: float,
    place: Vector,
    starts: Vector,
    states: Vector,
    series: Vector,
    count: int,
) -> tuple[int, float]:
    """Fill pieces of rest from t to `last`, each at most `cell` [s] long; return count and time."""
    while t < last and count < len(starts):
        h = min(cell, last - t)
        starts[count, 0], starts[count, 1], states[count] = t, 1.0, REST
        series[count, :, :] = 0.0
        series[count, 0, 0], series[count, 0, 1], series[count, 1, 2] = place[0], place[1], h
        count += 1
        t = last if h == last - t else t + h
    return count, t


@lent
def _end_of_piece(piece: Vector, end: float, t: float, duration: float) -> tuple[float, float]:
    """The time [s] at which a piece ends that starts at t, and its parameter there, at most `end`.

    The time is that at which the next piece starts, to rounding of the piece's duration, unless a
    time near t cannot resolve that.
    """
    then, low, high, x = duration, 0.0, end, end
    for _ in range(60):
        elapsed, rate = 0.0, 0.0
        for n in range(ORDER, -1, -1):
            rate = rate * x + elapsed
            elapsed = elapsed * x + piece[n, 2]
        if x == end:
            then = min(t + elapsed, duration)
        late = elapsed - (then - t)
        if abs(late) <= RESOLVED * elapsed:
            return then, x - late / rate
        if then < duration:
            return then, end
        if late > 0:
            high = x
        else:
            low = x
        guess = x - late / rate
        x = guess if low < guess < high else (low + high) / 2
    return then, x


@lent
def _step_of_slip(q: Vector) -> float:
    """The step in the unit of tau for which the series of `expand_slip` has converged."""
    end = LONGEST
    for n in range(ORDER - 2, ORDER):
        size = max(abs(q[n, SPEED]), math.hypot(q[n, WAY], q[n, WAY + 1]))
        if size > 0:
            end = min(end, (LAST * q[0, SPEED] / size) ** (1.0 / n))
    return end


@lent
def _step_without_friction(drive: Vector, unit: float, w: Vector, rates: Vector) -> float:
    """The step in the unit of time for which the series of w has converged; fills that in rates."""
    for a in range(2):
        rates[0, WAY + a] = w[a]
        for n in range(ORDER - 1):
            rates[n + 1, WAY + a] = unit * OVER[n] * drive[a, n]
    return CELL


@lent
def _step_of_start(
    drive: Vector,
    h: float,
    power: int,
    rates: Vector,
    turned: Vector,
    shape: Vector,
    work: Vector,
) -> float:
    """The step in units of h for which the series of a start from rest has converged, or 0.

    It is 0 if the body does not start. Filled: rates, of the velocity. turned (3, ORDER + 1), shape
    (2, ORDER), work: overwritten.
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
    rates[:, :] = 0.0
    for n in range(ORDER - power):
        across = 0.0
        for i in range(n + 1):
            across += v[i] * z[n - i]
        rates[n + power, WAY] = x * v[n] - y * across
        rates[n + power, WAY + 1] = y * v[n] + x * across
    return end


@lent
def _integrate(rates: Vector, h: float, out: Vector) -> None:
    """Fill the series out (ORDER + 1, 3) of position [m] and time [s] from that of the velocity.

    Its variable is time in units of h [s].
    """
    out[0, 2] = 0.0
    for n in range(ORDER):
        out[n + 1, 0], out[n + 1, 1] = h * OVER[n] * rates[n, WAY], h * OVER[n] * rates[n, WAY + 1]
        out[n + 1, 2] = h if n == 0 else 0.0


@lent
def _advance(rates: Vector, piece: Vector, x: float, w: Vector, place: Vector) -> None:
    """Move velocity w and place to the part x of a piece, in which the old place is stored."""
    u, v, way_x, way_y = 0.0, 0.0, 0.0, 0.0
    for n in range(ORDER - 1, -1, -1):
        u = u * x + rates[n, WAY]
        v = v * x + rates[n, WAY + 1]
        way_x = way_x * x + piece[n + 1, 0]
        way_y = way_y * x + piece[n + 1, 1]
    w[0], w[1] = u, v
    piece[0, 0], piece[0, 1] = place[0], place[1]
    place[0] += way_x * x
    place[1] += way_y * x
