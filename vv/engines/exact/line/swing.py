"""Closed forms of a mass on a spring with drag: its motion, and when it rises through a level."""

from __future__ import annotations

import math

from vv.engines.exact.roots import EPS
from vv.engines.kernels.compiled import lent

MOST_ITERATIONS = 60  # as many as bisection would need
FEW_ITERATIONS = 4  # of a step that needs no bracket; usually two
FAR, CLOSE = 0.5, 1e-4  # rad: the longest such step, and one of fourth order that leaves rounding
TURN = 2 * math.pi


@lent
def crossing_time(
    y: float, v: float, n: float, w: float, level: float, band: float
) -> tuple[float, float]:
    """The time [s] at which y'' + 2n y' + (n^2 + w^2) y = 0 first rises from y <= level through it.

    Beside it is the velocity then [m/s]. The time is infinite if y never exceeds the level by more
    than `band`. y = size e^(-nt) cos(wt - phase) has its highest peak first, so that later peaks
    need not be looked at.
    """
    k2, b = n * n + w * w, (v + n * y) / w
    if level >= 0.0 and k2 * y * y + v * v <= k2 * level * (level + band):
        return math.inf, 0.0  # it has too little energy, which spares the functions below
    if n == 0.0:
        return _undamped_crossing(y, b, v, w, level, band)
    t, speed = _early_crossing(y, b, v, n, w, level, band)
    if t > 0.0:
        return t, speed
    size, phase, lag = math.sqrt(y * y + b * b), math.atan2(b, y), math.atan2(n, w)
    turn = phase - lag
    if turn < 0.0:
        turn += TURN
    peak = turn / w
    if not size * math.exp(-n * peak) * w > (level + band) * math.sqrt(k2):
        return math.inf, 0.0
    if y >= level and (v > 0.0 or (v == 0.0 and y < 0.0)):
        return 0.0, v
    guess = peak + (lag - math.acos(min(max(level / size, -1.0), 1.0))) / w
    return _crossing_by_series(y, b, v, n, w, level, max(0.0, peak - math.pi / w), peak, guess)


@lent
def _undamped_crossing(
    y: float, b: float, v: float, w: float, level: float, band: float
) -> tuple[float, float]:
    """The time and velocity of a crossing without drag, or infinity."""
    size, phase = math.sqrt(y * y + b * b), math.atan2(b, y)
    if not size > level + band:
        return math.inf, 0.0
    if y >= level and (v > 0.0 or (v == 0.0 and y < 0.0)):
        return 0.0, v
    turn = phase - math.acos(max(level / size, -1.0))
    if turn < 0.0:
        turn = 0.0 if v > 0.0 else turn + TURN
    return turn / w, v * math.cos(turn) - w * y * math.sin(turn)


@lent
def _early_crossing(
    y: float, b: float, v: float, n: float, w: float, level: float, band: float
) -> tuple[float, float]:
    """The time and velocity of a crossing far ahead of the first peak, else 0.

    Speeds have their zeros pi/w apart, so that there is no peak before a time below pi/w at which
    the speed is positive as it is at t = 0.
    """
    t, place, speed, k2 = 0.0, y, v, n * n + w * w
    if not y < level:
        return 0.0, 0.0
    for _ in range(FEW_ITERATIONS):
        if not speed > 0.0:
            return 0.0, 0.0
        step, after, bent = _step_of_inverse(place, speed, n, w, level)
        if bent > FAR or speed * speed <= 4 * band * abs(2 * n * speed + k2 * place):
            return 0.0, 0.0
        t += step
        if bent <= CLOSE:
            return t, after
        place, speed = oscillation(y, b, v, n, w, t)
    return 0.0, 0.0


@lent
def _crossing_by_series(
    y: float,
    b: float,
    v: float,
    n: float,
    w: float,
    level: float,
    low: float,
    high: float,
    guess: float,
) -> tuple[float, float]:
    """The time and velocity at which y meets the level between `low` and its peak at `high`."""
    t, speed = min(max(guess, low), high), 0.0
    for _ in range(MOST_ITERATIONS):
        place, speed = oscillation(y, b, v, n, w, t)
        if place < level:
            low = t
        else:
            high = t
        step, after, bent = math.nan, speed, math.inf
        if speed > 0.0:
            step, after, bent = _step_of_inverse(place, speed, n, w, level)
        if not low <= t + step <= high:
            if abs(step) <= 2 * EPS * high:
                break
            step, bent = 0.5 * (low + high) - t, math.inf
            after = speed
        t, speed = t + step, after
        if bent <= CLOSE or abs(step) <= EPS * high:
            break
    return t, speed


@lent
def _step_of_inverse(
    place: float, speed: float, n: float, w: float, level: float
) -> tuple[float, float, float]:
    """The step [s] to the level, the velocity after it, and the part of a radian that it is.

    The step is Newton's with two further terms of the series of the inverse function, which need no
    exponentials and sines, since the equation of motion gives the higher derivatives.
    """
    k2 = n * n + w * w
    over = 1.0 / speed
    pull = -2 * n * speed - k2 * place
    jerk = -2 * n * pull - k2 * speed
    fourth = -2 * n * jerk - k2 * pull
    bend, part = pull * over, (level - place) * over
    step = part * (1.0 - part * (0.5 * bend - part * (0.5 * bend * bend - jerk * over / 6)))
    after = speed + step * (pull + step * (0.5 * jerk + step * fourth / 6))
    return step, after, abs(step) * max(w, abs(bend))


@lent
def oscillation(y: float, b: float, v: float, n: float, w: float, t: float) -> tuple[float, float]:
    """Displacement y [m] and velocity [m/s] after a time t [s]; b = (v + n y)/w."""
    fade, sine, cosine = math.exp(-n * t), math.sin(w * t), math.cos(w * t)
    return fade * (y * cosine + b * sine), fade * (v * cosine - (w * y + n * b) * sine)
