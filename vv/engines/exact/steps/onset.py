"""The start of a slip from rest within a step, where forces change linearly in time."""

from __future__ import annotations

import math

from vv.engines.kernels.compiled import lent
from vv.scene import Vector


@lent
def started(
    rows: Vector, sines: Vector, now: Vector, x: float, y: float, friction: float, h: float
) -> tuple[float, float, float, float, float]:
    """Velocity (2,) [m/s] of a body at rest after h [s], and how it began to slip.

    The mean forces (x, y) and friction [m/s2] would start it late by up to h/2, with a speed that
    is too small in every cycle. Here what T exceeds F by grows linearly over the step, and moves
    the body from the moment at which it is zero. The third number is the time [s] that the velocity
    takes, of which half counts for the displacement, and the last two are the acceleration at the
    start of slip. rows, sines, now: those of `follow_steps`, a step later.
    """
    if len(sines) == 0:
        return _pushed(x, y, math.hypot(x, y) - friction, h)
    x0, y0, f0 = _forces(rows, sines, now, 7)
    x1, y1, f1 = _forces(rows, sines, now, 5)
    low, high = math.sqrt(x0 * x0 + y0 * y0) - f0, math.sqrt(x1 * x1 + y1 * y1) - f1
    if low >= 0.0:
        return _pushed(x, y, math.hypot(x, y) - friction, h)
    if high <= 0.0:
        return 0.0, 0.0, h, 0.0, 0.0
    left = h * high / (high - low)
    share = 0.5 * high * left / (high + f1)
    return share * x1, share * y1, left * 2 / 3, 0.0, 0.0


@lent
def _pushed(x: float, y: float, grows: float, h: float) -> tuple[float, float, float, float, float]:
    """The same where T exceeds F, by `grows` [m/s2], from the start of the step."""
    if grows <= 0.0:
        return 0.0, 0.0, h, 0.0, 0.0
    over = grows / math.hypot(x, y)
    return over * h * x, over * h * y, h, over * x, over * y


@lent
def _forces(rows: Vector, sines: Vector, now: Vector, at: int) -> tuple[float, float, float]:
    """T (2,) and F [m/s2] before the middle of the next step, by the phase in column `at`."""
    x, y, friction = rows[0, 0], rows[1, 0], rows[2, 0]
    for i in range(len(sines)):
        sine = now[i, 0] * sines[i, at] - now[i, 1] * sines[i, at + 1]
        x += rows[0, 1 + i] * sine
        y += rows[1, 1 + i] * sine
        friction += rows[2, 1 + i] * sine
    return x, y, friction
