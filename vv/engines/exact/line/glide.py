"""Closed forms of a mass under constant force and drag: its motion, and when it stops or falls."""

from __future__ import annotations

import math

import numpy as np

from vv.engines.exact.roots import EPS
from vv.engines.kernels.compiled import lent

MOST_ITERATIONS = 60  # each of which at least halves the error
SHORT = 0.5  # largest 2nt for the series, which loses no digits where the closed form would
TERMS = 14  # of the series: SHORT^14/16! is 3e-18
OVER = 1.0 / np.array([float(math.factorial(k + 2)) for k in range(TERMS)])


@lent
def forced_motion(v: float, a: float, n: float, t: float) -> tuple[float, float]:
    """Displacement [m] and velocity [m/s] of x'' + 2n x' = a after t [s] from a velocity v."""
    if n == 0.0:
        return t * (v + 0.5 * a * t), v + a * t
    z = 2 * n * t
    part = -math.expm1(-z) / (2 * n)
    if z > SHORT:
        second = (t - part) / (2 * n)
    else:
        second = 0.0
        for k in range(TERMS - 1, -1, -1):
            second = OVER[k] - z * second
        second *= t * t
    return v * part + a * second, v - 2 * n * part * v + a * part


@lent
def glide_to_stop(v: float, a: float, n: float) -> tuple[float, float]:
    """The time [s] at which x'' + 2n x' = a stops from v >= 0, and the way [m], or infinity.

    With z = 2nt the way is -a (e^z - 1 - z)/4n^2, where e^z is 1 - 2nv/a.
    """
    if not a < 0.0:
        return math.inf, math.inf
    if n == 0.0:
        return v / -a, 0.5 * v * v / -a
    grown = 2 * n * v / -a
    z = math.log1p(grown)
    t = z / (2 * n)
    if z > SHORT:
        return t, -a * (grown - z) / (4 * n * n)
    second = 0.0
    for k in range(TERMS - 1, -1, -1):
        second = OVER[k] + z * second
    return t, -a * t * t * second


@lent
def fall_time(x: float, v: float, a: float, n: float, band: float, end: float) -> float:
    """The time [s] at which x'' + 2n x' = a first falls from x >= 0 through 0, or infinity.

    A minimum between -band and 0 does not count, nor does a fall after the time `end`.
    """
    if x <= 0.0 and (v < 0.0 or (v == 0.0 and a < 0.0)):
        return 0.0
    if a >= 0.0:
        if v >= 0.0:
            return math.inf
        way = glide_to_stop(-v, -a, n)[1] if a > 0.0 else -forced_motion(v, a, n, end)[0]
        if x - way >= -band:
            return math.inf
    if n == 0.0:
        root = math.sqrt(max(v * v - 2 * a * x, 0.0))
        return 2 * x / (root - v) if v < 0.0 else (v + root) / -a
    return _fall_by_newton(x, v, a, n, end)


@lent
def _fall_by_newton(x: float, v: float, a: float, n: float, end: float) -> float:
    """The zero by Newton's method, from the side from which it cannot overshoot.

    The acceleration a - 2nv keeps its sign: iterations on a convex path start at t = 0, those on a
    concave path at `end`.
    """
    t = 0.0 if a > 2 * n * v else end
    for _ in range(MOST_ITERATIONS):
        moved, speed = forced_motion(v, a, n, t)
        if t == end and x + moved >= 0.0:
            return math.inf
        after = min(max(t - (x + moved) / speed, 0.0), end)
        if abs(after - t) <= EPS * t:
            return after
        t = after
    return t
