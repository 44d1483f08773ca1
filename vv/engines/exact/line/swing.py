"""Closed forms of a mass on a spring with drag: its motion, and when it rises through a level."""

from __future__ import annotations

import math

from vv.engines.exact.roots import EPS
from vv.engines.kernels.compiled import lent

MOST_ITERATIONS = 60  # as many as bisection would need
TURN = 2 * math.pi


@lent
def crossing_time(y: float, v: float, n: float, w: float, level: float, band: float) -> float:
    """The time [s] at which y'' + 2n y' + (n^2 + w^2) y = 0 first rises from y <= level through it.

    Infinity if y never exceeds the level by more than `band`. y = size e^(-nt) cos(wt - phase) has
    its highest peak first, so that later peaks need not be looked at.
    """
    b = (v + n * y) / w
    size, phase = math.sqrt(y * y + b * b), math.atan2(b, y)
    if n == 0.0:
        if not size > level + band:
            return math.inf
        if y >= level and (v > 0.0 or (v == 0.0 and y < 0.0)):
            return 0.0
        turn = phase - math.acos(max(level / size, -1.0))
        if turn < 0.0:
            turn = 0.0 if v > 0.0 else turn + TURN
        return turn / w
    lag = math.atan2(n, w)
    turn = phase - lag
    if turn < 0.0:
        turn += TURN
    peak = turn / w
    if not size * math.exp(-n * peak) * math.cos(lag) > level + band:
        return math.inf
    if y >= level and (v > 0.0 or (v == 0.0 and y < 0.0)):
        return 0.0
    guess = peak + (lag - math.acos(min(max(level / size, -1.0), 1.0))) / w
    return _crossing_by_newton(y, b, v, n, w, level, max(0.0, peak - math.pi / w), peak, guess)


@lent
def _crossing_by_newton(
    y: float,
    b: float,
    v: float,
    n: float,
    w: float,
    level: float,
    low: float,
    high: float,
    guess: float,
) -> float:
    """The time at which y meets the level between `low` and its peak at `high`, by Newton steps."""
    t = min(max(guess, low), high)
    for _ in range(MOST_ITERATIONS):
        fade, sine, cosine = math.exp(-n * t), math.sin(w * t), math.cos(w * t)
        beyond = fade * (y * cosine + b * sine) - level
        speed = fade * (v * cosine - (w * y + n * b) * sine)
        if beyond < 0.0:
            low = t
        else:
            high = t
        after = t - beyond / speed if speed > 0.0 else math.nan
        if not low <= after <= high:
            if abs(after - t) <= 2 * EPS * high:
                return t
            after = 0.5 * (low + high)
        if abs(after - t) <= EPS * high:
            return after
        t = after
    return t


@lent
def oscillation(y: float, v: float, n: float, w: float, t: float) -> tuple[float, float]:
    """Displacement y [m] and velocity [m/s] of the oscillation after a time t [s]."""
    b = (v + n * y) / w
    sine, cosine = math.sin(w * t), math.cos(w * t)
    fade = math.exp(-n * t) if n > 0.0 else 1.0
    return fade * (y * cosine + b * sine), fade * (v * cosine - (w * y + n * b) * sine)
