"""Computes the motion of one unknown on one contact; the times of events are closed forms."""

from __future__ import annotations

import math

from vv.engines.exact.guards import GUARD_ROUNDING
from vv.engines.exact.line.glide import fall_time, forced_motion, stop_time
from vv.engines.exact.line.swing import crossing_time, oscillation
from vv.engines.exact.modes import BACKWARD, FORWARD, OPEN, STUCK, sign_of
from vv.engines.kernels.compiled import compiled
from vv.scene import Vector

FULL, CROWDED, MEETS = -1, -2, -3  # in place of the number of pieces


@compiled
def follow_one(
    pieces: Vector,
    slides: bool,
    x: float,
    v: float,
    n: float,
    k: float,
    a: float,
    limit: float,
    duration: float,
    most: int,
) -> int:
    """The number p of pieces between events, or a negative number for the reason of a failure.

    x [m], v [m/s]: at t = 0, of a gap or, if it slides, of the stretch of a shear spring. The
    equation is x'' + 2n x' + k^2 x = a while the contact is closed and sticks; k^2 x is left out
    while it is open, and replaced by k^2 limit against the slip while it slips. limit [m]: of the
    stretch or, for a gap, the overlap at which centres meet. most: the number of changes of state
    that is allowed. Filled: pieces (room, 5), with the time [s], the state, the displacement [m]
    since t = 0, x and v at the start of a piece. It is one function since each piece updates nearly
    all of its variables.
    """
    w, rest = math.sqrt(k * k - n * n), a / (k * k)
    state = STUCK if slides or x < 0.0 else OPEN
    t = travel = scale = 0.0
    count = 0
    for _ in range(most):
        if count == len(pieces):
            return FULL
        piece = pieces[count]
        piece[0], piece[1], piece[2], piece[3], piece[4] = t, state, travel, x, v
        scale = max(scale, abs(x), abs(v) / k, abs(rest))
        band, left = GUARD_ROUNDING * scale, duration - t
        span, after, reached, y = left, state, x, x - rest
        if state == OPEN:
            span, after, reached = fall_time(x, v, a, n, band, left), STUCK, 0.0
        elif state != STUCK:
            sign = sign_of(state)
            span, after = stop_time(sign * v, sign * a - k * k * limit, n), STUCK
        elif slides:
            up = crossing_time(y, v, n, w, limit - rest, band)
            down = crossing_time(-y, -v, n, w, limit + rest, band)
            span, after, reached = up, FORWARD, limit
            if down < up:
                span, after, reached = down, BACKWARD, -limit
        else:
            if abs(rest) + abs(y) + abs(v + n * y) / w >= limit:
                return MEETS
            span, after, reached = crossing_time(y, v, n, w, -rest, band), OPEN, 0.0
        if not span < left:
            return count + 1
        if state == STUCK:
            v = oscillation(y, v, n, w, span)[1]
            travel += reached - x
        elif state == OPEN:
            v = forced_motion(v, a, n, span)[1]
            travel += reached - x
        else:
            travel += forced_motion(v, a - sign_of(state) * k * k * limit, n, span)[0]
            v, reached = 0.0, sign_of(state) * limit
        count += span > 0.0
        t, state, x = t + span, after, reached
    return CROWDED
