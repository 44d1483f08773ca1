"""Finds when a body at rest on a wall begins to slip: when |T| exceeds the friction limit F."""

from __future__ import annotations

import math

from vv.engines.exact.roots import safe_step
from vv.engines.exact.turn.series import angle
from vv.engines.kernels.compiled import lent
from vv.scene import Vector


@lent
def friction_margin(rows: Vector, sines: Vector, t: float, out: Vector) -> None:
    """Fill out (3,) with F^2 - |T|^2 at time t [m2/s4] and its first two time derivatives."""
    out[:] = 0.0
    for r in range(3):
        value, rate, curve = rows[r, 0], 0.0, 0.0
        for i in range(len(sines)):
            now, row = angle(sines, i, t), rows[r, 1 + i]
            value += row * math.sin(now)
            rate += row * sines[i, 3] * math.cos(now)
            curve -= row * sines[i, 3] ** 2 * math.sin(now)
        sign = 1.0 if r == 2 else -1.0
        out[0] += sign * value * value
        out[1] += sign * 2 * value * rate
        out[2] += sign * 2 * (rate * rate + value * curve)


@lent
def third_derivative_bound(rows: Vector, sines: Vector) -> float:
    """An upper bound on the third time derivative of F^2 - |T|^2 [m2/s7]."""
    bound = 0.0
    for r in range(3):
        size, rate, curve, jerk = abs(rows[r, 0]), 0.0, 0.0, 0.0
        for i in range(len(sines)):
            row = abs(rows[r, 1 + i])
            size += row
            rate += row * sines[i, 3]
            curve += row * sines[i, 3] ** 2
            jerk += row * sines[i, 3] ** 3
        bound += 2 * (size * jerk + 3 * rate * curve)
    return bound


@lent
def end_of_rest(
    rows: Vector, sines: Vector, t: float, last: float, band: float, out: Vector
) -> float:
    """The time [s] after which F^2 - |T|^2 first falls below -band, or `last`; out: (3,) for work.

    The search takes steps that cannot skip it: see
    `vv.engines.exact.roots.first_descent_below_zero`. They end less than the rounding `band` below
    zero, from where one step of Newton's method leads back.
    """
    jerk, held, ahead = third_derivative_bound(rows, sines), t, last - t
    while t < last:
        friction_margin(rows, sines, t, out)
        if out[0] > 0:
            held = t
        elif out[0] <= -band / 2:
            return max(t - out[0] / out[1], held) if out[1] < 0 else t
        bend = max(jerk * ahead - out[2], 0.0)
        step = min(safe_step(out[0] + band, out[1], bend), ahead)
        t += max(step, 4e-16 * t)
        ahead = min(4 * step, last - t)
    return last
