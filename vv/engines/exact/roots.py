"""Finds the first zero at which a polynomial becomes negative, and not one where it touches 0."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from vv.engines.kernels.compiled import compiled, inlined, lent
from vv.scene import Vector

EPS = 2.0**-52


def first_descent_below_zero(c: Sequence[float], band: float, end: float) -> float | None:
    """The zero after which p(x) = c[0] + c[1] x + ... first falls below -band in [0, end].

    None if it never does, 0 if it does so immediately. band > 0 must exceed the rounding error of
    p: a minimum between -band and 0 is a grazing contact and no event.
    """
    found = _first_descent(np.array(c, float), band, end)
    return found if found <= end else None


@compiled
def _first_descent(c: Vector, band: float, end: float) -> float:
    return first_descent(c, band, end)


@lent
def first_descent(c: Vector, band: float, end: float) -> float:
    """The same as `first_descent_below_zero`, for kernels; infinite if p never falls.

    The search takes steps along x that cannot skip a zero. With |p'''| <= J, p'' >= p''(x) - J r on
    [x, x + r]; hence p + band > 0 up to the step s <= r that solves
    p + band + p' s - M s^2/2 = 0, M = J r - p''(x). Each look-ahead r is four times the last step.
    """
    third, power = 0.0, 1.0
    for k in range(3, len(c)):
        third += k * (k - 1) * (k - 2) * abs(c[k]) * power
        power *= end
    x, positive, look_ahead = 0.0, 0.0, end
    while True:
        p, slope, curve = _value(c, x)
        if p > 0:
            positive = x
        elif p <= -band / 2:
            return _zero_of_descent(c, positive, x)
        ahead = safe_step(p + band, slope, max(third * look_ahead - curve, 0.0))
        ahead = min(ahead, look_ahead)
        if x + ahead >= end:
            return math.inf
        x += max(ahead, EPS * x)
        look_ahead = 4 * ahead


@lent
def safe_step(height: float, slope: float, bend: float) -> float:
    """The s > 0 at which height + slope s - bend s^2/2 = 0, or infinity."""
    root = math.sqrt(slope * slope + 2 * bend * height)
    if slope > 0:
        return (slope + root) / bend if bend > 0 else math.inf
    return 2 * height / (root - slope) if root > slope else math.inf


@lent
def _zero_of_descent(c: Vector, low: float, high: float) -> float:
    """The zero in [low, high] after which p stays negative to `high`; `low` if there is none."""
    x = high
    for _ in range(60):
        p, slope, _ = _value(c, x)
        low, high, guess = narrowed(low, high, x, p, slope)
        if abs(guess - x) <= EPS * high:
            return guess
        x = guess
    return x


@inlined
def narrowed(
    low: float, high: float, x: float, p: float, slope: float
) -> tuple[float, float, float]:
    """The bracket [low, high] of a descent through 0 after p at x, and Newton's next x in it."""
    if p < 0:
        high = x
    else:
        low = x
    guess = x - p / slope if slope < 0 else math.nan
    if not guess <= high:
        guess = (low + high) / 2
    return low, high, max(guess, low)


@lent
def _value(c: Vector, x: float) -> tuple[float, float, float]:
    """A polynomial and its first two derivatives at x, by Horner's rule."""
    p = slope = half = 0.0
    for k in range(len(c) - 1, -1, -1):
        half = half * x + slope
        slope = slope * x + p
        p = p * x + c[k]
    return p, slope, 2 * half
