"""Follows one unknown on one contact from event to event, whose times are closed forms."""

from __future__ import annotations

import math

from vv.engines.exact.guards import GUARD_ROUNDING
from vv.engines.exact.line.glide import falls, glided, stops
from vv.engines.exact.line.swing import rises, swung
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
    """The number p of pieces between events, or why there is none.

    x [m], v [m/s] at t = 0: a gap and its rate or, if it slides, the stretch of a shear spring.
    x'' + 2n x' + k^2 x = a while the contact holds, without k^2 x while it is open, and with
    k^2 limit against the slip while it slips. limit [m]: of the stretch or, of a gap, the depth at
    which centres meet. most: changes of state. Filled: pieces (room, 5), the time [s], the state,
    the way [m] since t = 0, x and v where a piece starts.
    """
    w, rest = math.sqrt(k * k - n * n), a / (k * k)
    state = STUCK if slides or x < 0.0 else OPEN
    t = way = scale = 0.0
    count = 0
    for _ in range(most):
        if count == len(pieces):
            return FULL
        piece = pieces[count]
        piece[0], piece[1], piece[2], piece[3], piece[4] = t, state, way, x, v
        scale = max(scale, abs(x), abs(v) / k, abs(rest))
        band, left = GUARD_ROUNDING * scale, duration - t
        span, after, reached, y = left, state, x, x - rest
        if state == OPEN:
            span, after, reached = falls(x, v, a, n, band, left), STUCK, 0.0
        elif state != STUCK:
            sign = sign_of(state)
            span, after = stops(sign * v, sign * a - k * k * limit, n), STUCK
        elif slides:
            up = rises(y, v, n, w, limit - rest, band)
            down = rises(-y, -v, n, w, limit + rest, band)
            span, after, reached = up, FORWARD, limit
            if down < up:
                span, after, reached = down, BACKWARD, -limit
        else:
            if abs(rest) + abs(y) + abs(v + n * y) / w >= limit:
                return MEETS
            span, after, reached = rises(y, v, n, w, -rest, band), OPEN, 0.0
        if not span < left:
            return count + 1
        if state == STUCK:
            v = swung(y, v, n, w, span)[1]
            way += reached - x
        elif state == OPEN:
            v = glided(v, a, n, span)[1]
            way += reached - x
        else:
            way += glided(v, a - sign_of(state) * k * k * limit, n, span)[0]
            v, reached = 0.0, sign_of(state) * limit
        count += span > 0.0
        t, state, x = t + span, after, reached
    return CROWDED
