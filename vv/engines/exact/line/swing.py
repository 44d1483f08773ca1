"""Closed forms of a mass on a spring with drag: when it rises through a level, and where it is."""

from __future__ import annotations

import math

from vv.engines.exact.roots import EPS
from vv.engines.kernels.compiled import lent

MOST_TRIES = 60  # bisections would need no more
TURN = 2 * math.pi


@lent
def rises(y: float, v: float, n: float, w: float, level: float, band: float) -> float:
    """When y'' + 2n y' + (n^2 + w^2) y = 0 first rises from y <= level through it [s].

    Infinity if it never gets above it by more than `band`. y = size e^(-nt) cos(wt - phase) is
    highest at the first of its peaks, so that no later one decides.
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
    return _rising(y, b, v, n, w, level, max(0.0, peak - math.pi / w), peak, guess)


@lent
def _rising(
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
    """Where it meets the level as it rises from `low` to its peak at `high`, by Newton's rule."""
    t = min(max(guess, low), high)
    for _ in range(MOST_TRIES):
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
def swung(y: float, v: float, n: float, w: float, t: float) -> tuple[float, float]:
    """Place and velocity after a time t [s]."""
    b = (v + n * y) / w
    sine, cosine = math.sin(w * t), math.cos(w * t)
    fade = math.exp(-n * t) if n > 0.0 else 1.0
    return fade * (y * cosine + b * sine), fade * (v * cosine - (w * y + n * b) * sine)
