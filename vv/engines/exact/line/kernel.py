"""Computes the motion of one unknown on one contact; the times of events are closed forms."""

from __future__ import annotations

import math

from vv.engines.exact.guards import GUARD_ROUNDING
from vv.engines.exact.line.glide import fall_time, forced_motion, glide_to_stop
from vv.engines.exact.line.swing import crossing_time
from vv.engines.exact.modes import BACKWARD, FORWARD, OPEN, STUCK, sign_of
from vv.engines.kernels.compiled import compiled
from vv.scene import Vector

FULL, CROWDED, MEETS = -1, -2, -3  # in place of the number of pieces


@compiled
def follow_one(pieces: Vector, given: Vector) -> int:
    """The number p of pieces between events, or a negative number for the reason of a failure.

    given (9,): slides, x, v, n, k, a, limit, duration [s] and the number of changes of state that
    is allowed, in one array, since each argument of its own costs as much as a square root. x [m],
    v [m/s]: at t = 0, of a gap or, if it slides, of the stretch of a shear spring. The equation is
    x'' + 2n x' + k^2 x = a while the contact is closed and sticks; k^2 x is left out while it is
    open, and replaced by k^2 limit against the slip while it slips. limit [m]: of the stretch or,
    for a gap, the overlap at which centres meet. Filled: pieces (room, 5), with the time [s], the
    state, the displacement [m] since t = 0, x and v at the start of a piece. It is one function
    since each piece updates nearly all of its variables.
    """
    slides, x, v, n, k = given[0] != 0.0, given[1], given[2], given[3], given[4]
    a, limit, duration, most = given[5], given[6], given[7], int(given[8])
    w, rest = math.sqrt(k * k - n * n), a / (k * k)
    state = STUCK if slides or x < 0.0 else OPEN
    t = travel = scale = way = pace = 0.0
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
            span, way = glide_to_stop(sign * v, sign * a - k * k * limit, n)
            after = STUCK
        elif slides:
            sign = 1.0 if v > 0.0 or (v == 0.0 and y < 0.0) else -1.0
            span, pace = crossing_time(sign * y, sign * v, n, w, limit - sign * rest, band)
            if span == math.inf:  # the limit that it first moves towards is not reached
                sign = -sign
                span, pace = crossing_time(sign * y, sign * v, n, w, limit - sign * rest, band)
            pace *= sign
            after, reached = FORWARD if sign > 0.0 else BACKWARD, sign * limit
        else:
            if abs(rest) + abs(y) + abs(v + n * y) / w >= limit:
                return MEETS
            span, pace = crossing_time(y, v, n, w, -rest, band)
            after, reached = OPEN, 0.0
        if not span < left:
            return count + 1
        if state == STUCK:
            v = pace
            travel += reached - x
        elif state == OPEN:
            v = forced_motion(v, a, n, span)[1]
            travel += reached - x
        else:
            travel += sign_of(state) * way
            v, reached = 0.0, sign_of(state) * limit
        count += span > 0.0
        t, state, x = t + span, after, reached
    return CROWDED
