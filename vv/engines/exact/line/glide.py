"""Closed forms of a mass under a constant force with drag: when it falls, stops, and where."""

from __future__ import annotations

import math

from vv.engines.exact.roots import EPS
from vv.engines.kernels.compiled import lent

MOST_TRIES = 60  # each of which halves what is left at least
SHORT = 0.5  # 2nt up to which a series has no loss
TERMS = 14  # of it: SHORT^14/16! is 3e-18


@lent
def glided(v: float, a: float, n: float, t: float) -> tuple[float, float]:
    """The way of x'' + 2n x' = a after t [s], and the velocity then."""
    if n == 0.0:
        return t * (v + 0.5 * a * t), v + a * t
    z = 2 * n * t
    part = -math.expm1(-z) / (2 * n)
    if z > SHORT:
        second = (t - part) / (2 * n)
    else:
        second, term = 0.0, 0.5 * t * t
        for k in range(TERMS):
            second += term
            term *= -z / (k + 3)
    return v * part + a * second, v - 2 * n * part * v + a * part


@lent
def stops(v: float, a: float, n: float) -> float:
    """When a velocity v >= 0 has come to nil [s], or infinity."""
    if not a < 0.0:
        return math.inf
    return math.log1p(2 * n * v / -a) / (2 * n) if n > 0.0 else v / -a


@lent
def falls(x: float, v: float, a: float, n: float, band: float, end: float) -> float:
    """When x'' + 2n x' = a first falls from x >= 0 through 0 [s], or infinity.

    A lowest point between -band and 0 is no fall, nor is one after `end`.
    """
    if x <= 0.0 and (v < 0.0 or (v == 0.0 and a < 0.0)):
        return 0.0
    if a >= 0.0:
        if v >= 0.0:
            return math.inf
        if x + glided(v, a, n, stops(-v, -a, n) if a > 0.0 else end)[0] >= -band:
            return math.inf
    if n == 0.0:
        root = math.sqrt(max(v * v - 2 * a * x, 0.0))
        return 2 * x / (root - v) if v < 0.0 else (v + root) / -a
    return _falling(x, v, a, n, end)


@lent
def _falling(x: float, v: float, a: float, n: float, end: float) -> float:
    """The zero by Newton's rule, from the side on which it cannot go too far.

    The acceleration a - 2nv keeps its sign: a path that bends up is met from the start, one that
    bends down from the end.
    """
    t = 0.0 if a > 2 * n * v else end
    for _ in range(MOST_TRIES):
        moved, speed = glided(v, a, n, t)
        if t == end and x + moved >= 0.0:
            return math.inf
        after = min(max(t - (x + moved) / speed, 0.0), end)
        if abs(after - t) <= EPS * t:
            return after
        t = after
    return t
