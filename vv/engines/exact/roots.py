"""Finds where a polynomial first falls below zero, and not where it only touches zero."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from vv.scene import Vector

EPS = 2.0**-52


def bernstein(order: int) -> Vector:
    """The matrix (k, i) from coefficients of x^k to those of the Bernstein polynomials.

    On [0, 1] a polynomial stays between the least and the greatest of the latter.
    """
    ranks = range(order + 1)
    rows = [[math.comb(i, k) / math.comb(order, k) for i in ranks] for k in ranks]
    return np.array(rows)


def first_fall(c: Sequence[float], band: float, end: float) -> float | None:
    """The last zero before c[0] + c[1] x + ... first leaves [-band, inf) in [0, end], or None.

    It is 0 if the polynomial leaves at once. band > 0 must exceed the rounding of the values: a
    minimum that is negative by less is a grazing contact, and no event.

    The search marches. Where |p'''| <= J, p'' >= p''(x) - J r as far as x + r; so p + band stays
    positive for a step s <= r with p + band + p' s - M s^2/2 = 0, M = J r - p''(x). No zero is
    skipped, however close to the next. Each r is a few times the step before.
    """
    jolt = sum(k * (k - 1) * (k - 2) * abs(ck) * end ** (k - 3) for k, ck in enumerate(c) if k > 2)
    x, positive, reach = 0.0, 0.0, end
    while True:
        p, slope, curve = _value(c, x)
        if p > 0:
            positive = x
        elif p <= -band / 2:
            return _zero(c, positive, x)
        step = min(_safe_step(p + band, slope, max(jolt * reach - curve, 0.0)), reach)
        if x + step >= end:
            return None
        x += max(step, EPS * x)
        reach = 4 * step


def _safe_step(height: float, slope: float, bend: float) -> float:
    """The s > 0 at which height + slope s - bend s^2/2 = 0, or infinity."""
    root = math.sqrt(slope * slope + 2 * bend * height)
    if slope > 0:
        return (slope + root) / bend if bend > 0 else math.inf
    return 2 * height / (root - slope) if root > slope else math.inf


def _zero(c: Sequence[float], low: float, high: float) -> float:
    """The zero on the falling branch that ends at `high`, where p < 0; `low` if there is none."""
    x = high
    for _ in range(60):
        p, slope, _ = _value(c, x)
        if p < 0:
            high = x
        else:
            low = x
        guess = x - p / slope if slope < 0 else math.nan
        if not guess <= high:
            guess = (low + high) / 2
        guess = max(guess, low)
        if abs(guess - x) <= EPS * high:
            return guess
        x = guess
    return x


def _value(c: Sequence[float], x: float) -> tuple[float, float, float]:
    """A polynomial and its first two derivatives at x, by Horner's rule."""
    p = slope = half = 0.0
    for ck in reversed(c):
        half = half * x + slope
        slope = slope * x + p
        p = p * x + ck
    return p, slope, 2 * half
