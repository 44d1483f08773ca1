"""Sines over a part of a cell, and falls of guards that are sums of them, without lost digits."""

from __future__ import annotations

import math

import numpy as np

from vv.engines.exact.roots import EPS, narrowed, safe_step
from vv.engines.kernels.compiled import inlined, lent
from vv.scene import Vector

TERMS = 10  # of series in an angle of at most pi/2, whose next term is (pi/2)^20/22! = 7e-18
EVEN, ODD = (
    np.array([(-1.0) ** n / math.factorial(2 * n + first) for n in range(TERMS)])
    for first in (2, 3)
)
SIXTH = 1 / 6  # kernels would divide
MOST_LOOKS = 100  # of which a fall usually needs two
WIDER = 1.5  # times an estimated step: how far ahead bounds must hold


@inlined
def arc(angle: float) -> tuple[float, float]:
    """(1 - cos a)/a^2 and (a - sin a)/a^3 of an angle a from 0 to pi/2 [rad]."""
    square = angle * angle
    return _even_sum(EVEN, square), _even_sum(ODD, square)


@inlined
def _even_sum(c: Vector, x: float) -> float:
    """The polynomial of ten terms, in pairs, which takes half the time of one after another."""
    y = x * x
    low = (c[0] + x * c[1]) + y * (c[2] + x * c[3])
    high = (c[4] + x * c[5]) + y * ((c[6] + x * c[7]) + y * (c[8] + x * c[9]))
    return float(low + y * y * high)


@inlined
def look(
    slips: bool, start: float, row: Vector, turn: Vector, wave: Vector, x: float
) -> tuple[float, float, float, float]:
    """A guard at the part x of a cell after its start, and its first three derivatives.

    The guard is row[0] + row[1:] @ sines, or if the body slips `start` plus the integral of that.
    turn (k,): change of the phases in a cell [rad]; wave (2, k): sines and cosines at the start.
    """
    p, slope = (start + row[0] * x, row[0]) if slips else (row[0], 0.0)
    curve, third = 0.0, 0.0
    for i in range(len(turn)):
        size, rate, sine, cosine = row[1 + i], turn[i], wave[0, i], wave[1, i]
        if x > 0.0:
            angle = rate * x
            even, odd = arc(angle)
            risen, fallen = angle - angle * angle * angle * odd, angle * angle * even
            if slips:
                p += size * x * (sine * (1.0 - angle * angle * odd) + cosine * angle * even)
            sine, cosine = (
                sine - sine * fallen + cosine * risen,
                cosine - cosine * fallen - sine * risen,
            )
        if slips:
            slope += size * sine
            curve += size * rate * cosine
            third -= size * rate * rate * sine
        else:
            p += size * sine
            slope += size * rate * cosine
            curve -= size * rate * rate * sine
            third -= size * rate * rate * rate * cosine
    return p, slope, curve, third


@inlined
def first_fall(
    slips: bool,
    start: float,
    row: Vector,
    bound: float,
    turn: Vector,
    wave: Vector,
    band: float,
    end: float,
) -> float:
    """Where the guard of `look` first falls through 0 below -band in [0, end], or a larger number.

    Its fourth derivative is at most `bound`, so that a step is known which cannot skip a fall.
    Where the guard falls throughout, the zero of its first terms is taken instead.
    """
    x, held = 0.0, 0.0
    p, slope, curve, third = look(slips, start, row, turn, wave, 0.0)
    for _ in range(MOST_LOOKS):
        left = end - x
        if p > -band and _least(p, slope, curve, third, bound, left) > -band:
            return math.inf
        held = x if p > 0.0 else held
        step, error = _to_zero(p, slope, curve, third, bound, band, left)
        if error <= EPS * end:
            return max(x + step, held)
        if p <= -0.5 * band and not (error < math.inf and x + step > held):
            return _bracketed(slips, start, row, turn, wave, held, x)
        if error == math.inf:
            step = _safe(p + band, slope, curve, third, bound, left)
            step = max(step, EPS * x)
            if step >= left:
                x = end
                break
        x = min(max(x + step, held), end)
        p, slope, curve, third = look(slips, start, row, turn, wave, x)
        if x == end and p > -0.5 * band:
            break
    return math.inf if x == end else held


@inlined
def _least(p: float, slope: float, curve: float, third: float, bound: float, left: float) -> float:
    """A lower bound on the guard up to `left` from here."""
    bend = 0.5 * curve + left * (SIXTH * min(third, 0.0) - 0.25 * SIXTH * bound * left)
    if bend > 0.0:
        return p - min(slope, 0.0) ** 2 / (4 * bend)
    return p + left * min(slope + bend * left, 0.0)


@inlined
def _to_zero(
    p: float,
    slope: float,
    curve: float,
    third: float,
    bound: float,
    band: float,
    left: float,
) -> tuple[float, float]:
    """The way to the zero of a guard that falls from here to -2 band, and the error of that way.

    The error is infinite where the guard might not fall throughout. Behind the zero the way is
    negative.
    """
    if slope * slope < 2 * curve * (p + 2 * band) or (p <= 0.0 and slope >= 0.0):
        return 0.0, math.inf
    s = safe_step(p + 2 * band, slope, -curve) if p > 0.0 else 2 * band / -slope
    reach = min(WIDER * s, left) if s < left else s
    rise = reach * (0.5 * max(third, 0.0) + SIXTH * bound * reach)
    falls = slope + (max(curve, 0.0) + rise) * reach < 0.0 or (slope <= 0.0 and curve + rise < 0.0)
    if not (0.0 < reach < math.inf and falls):
        return 0.0, math.inf
    if p <= 0.0:
        s = p / -slope
    over = 1.0 / (slope + s * (curve + 0.5 * s * third))
    s -= over * (p + s * (slope + s * (0.5 * curve + SIXTH * s * third)))
    s -= over * (p + s * (slope + s * (0.5 * curve + SIXTH * s * third)))
    if not (s <= reach and over < 0.0):
        return reach, 1.0
    return s, -0.25 * SIXTH * over * bound * s * s * s * s


@lent
def _bracketed(
    slips: bool, start: float, row: Vector, turn: Vector, wave: Vector, low: float, high: float
) -> float:
    """The zero in [low, high] by Newton's method and bisection; `low` if there is none."""
    x = high
    for _ in range(MOST_LOOKS if low < high else 0):
        p, slope, _, _ = look(slips, start, row, turn, wave, x)
        low, high, guess = narrowed(low, high, x, p, slope)
        if abs(guess - x) <= EPS * high:
            return guess
        x = guess
    return x


@inlined
def _safe(
    height: float, slope: float, curve: float, third: float, bound: float, left: float
) -> float:
    """A step that cannot skip the zero of a guard that is `height` above it."""
    s = safe_step(height, slope, max((abs(third) + bound * left) * left - curve, 0.0))
    if s >= left:
        return s
    wide = min(left, WIDER * s)
    again = safe_step(height, slope, max((abs(third) + bound * wide) * wide - curve, 0.0))
    return max(s, min(again, wide))
