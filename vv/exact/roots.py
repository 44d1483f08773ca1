"""Finds where a polynomial first falls below zero, and not where it only touches zero."""

from __future__ import annotations

import math
from collections.abc import Sequence

EPS = 2.0**-52


def first_fall(c: Sequence[float], band: float, end: float) -> float | None:
    """The last zero before c[0] + c[1] x + ... first leaves [-band, inf) in [0, end], or None.

    It is 0 if the polynomial leaves at once. band > 0 must exceed the rounding of the values: a
    minimum that is negative by less is a grazing contact, and no event.

    The search marches: with |p''| <= M everywhere, p + band stays positive for the step s that
    solves p + band + p' s - M s^2/2 = 0. No root is skipped, however close to the next.
    """
    bend = sum(k * (k - 1) * abs(ck) * end ** (k - 2) for k, ck in enumerate(c) if k > 1)
    x, positive = 0.0, 0.0
    while True:
        p, slope = _value(c, x)
        if p > 0:
            positive = x
        elif p <= -band / 2:
            return _zero(c, positive, x)
        left = p + band
        root = math.sqrt(slope * slope + 2 * bend * left)
        if slope > 0:
            step = (slope + root) / bend if bend > 0 else math.inf
        else:
            step = 2 * left / (root - slope) if root - slope > 0 else math.inf
        if x + step >= end:
            return None
        x += max(step, EPS * x)


def _zero(c: Sequence[float], low: float, high: float) -> float:
    """The zero on the falling branch that ends at `high`, where p < 0; `low` if there is none."""
    x = high
    for _ in range(60):
        p, slope = _value(c, x)
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


def _value(c: Sequence[float], x: float) -> tuple[float, float]:
    """A polynomial and its derivative at x, by Horner's rule."""
    p = slope = 0.0
    for ck in reversed(c):
        slope = slope * x + p
        p = p * x + ck
    return p, slope
