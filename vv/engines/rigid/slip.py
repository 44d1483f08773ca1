"""The direction of friction over a step in which slip turns, for kernels."""

from __future__ import annotations

import numpy as np

from vv.engines.kernels.arrays import larger, smaller, square_of
from vv.engines.kernels.compiled import inlined, lent
from vv.engines.kernels.triples import Triple, add_scaled, cross, dot
from vv.engines.rigid.limits import STILL

STRAIGHT = 1e-14  # squared sine of an angle below which slip keeps its direction
SLOW = 2.0  # over the velocity change by friction in a step: slower slip could be reversed by it


@inlined
def least_slip_speed(span: float, braking: float, tolerance: float) -> float:
    """The speed [m/s] below which a contact does not slip, after a step of `span` [s].

    It is due to the tolerance [m/s] of the solution. braking: see `vv.engines.rigid.scales`.
    """
    return larger(STILL * braking * span, 10.0 * tolerance)


@lent
def mean_direction(before: Triple, after: Triple) -> Triple:
    """The mean direction u/|u| of a slip velocity u that changes linearly from u0 to u1.

    u0, u1: `before`, `after`. With e the unit vector of u1 - u0, x = u . e and r the part of u0
    perpendicular to e, it is
    e (|u1| - |u0|)/(x1 - x0) + r/|r| (asinh(x1/|r|) - asinh(x0/|r|))/(x1 - x0).
    """
    zero = (0.0, 0.0, 0.0)
    first, last = np.sqrt(dot(before, before)), np.sqrt(dot(after, after))
    across = cross(before, after)
    if not dot(across, across) > STRAIGHT * square_of(first * last):
        return add_scaled(add_scaled(zero, 0.5 / first, before), 0.5 / last, after)
    change = add_scaled(after, -1.0, before)
    length = np.sqrt(dot(change, change))
    e = add_scaled(zero, 1.0 / length, change)
    x0, x1 = dot(before, e), dot(after, e)
    out = add_scaled(before, -x0, e)
    far = np.sqrt(dot(out, out))
    mean = add_scaled(zero, (x0 + x1) / (first + last), e)
    return add_scaled(mean, (np.arcsinh(x1 / far) - np.arcsinh(x0 / far)) / length, out)


@lent
def bend(before: Triple, sag: Triple, after: Triple, pull: float) -> Triple:
    """The mean direction of slip over a step minus the mean of its first and last directions.

    before, after: slip velocities, not zero; sag: the velocity at mid-step minus the mean of both,
    by prescribed motions alone; pull: the velocity change by friction in the step [m/s]. The slip
    velocity changes linearly in each half of the step. Zero if it is so slow that friction could
    reverse it.
    """
    zero = (0.0, 0.0, 0.0)
    straight = add_scaled(add_scaled(zero, 0.5, before), 0.5, after)
    halfway = add_scaled(straight, 1.0, sag)
    first, last = dot(before, before), dot(after, after)
    one, two = cross(before, after), cross(before, halfway)
    slowest = smaller(smaller(first, dot(halfway, halfway)), last)
    if not slowest > square_of(SLOW * pull):
        return zero
    if not (dot(one, one) > STRAIGHT * first * last or dot(two, two) > STRAIGHT * first * first):
        return zero
    early, late = mean_direction(before, halfway), mean_direction(halfway, after)
    halfway = add_scaled(add_scaled(halfway, -0.25 * pull, early), 0.25 * pull, late)
    early, late = mean_direction(before, halfway), mean_direction(halfway, after)
    mean = add_scaled(add_scaled(zero, 0.5, early), 0.5, late)
    return add_scaled(add_scaled(mean, -0.5 / np.sqrt(first), before), -0.5 / np.sqrt(last), after)


@lent
def first_root(a: float, b: float, c: float) -> float:
    """The first s >= 0 at which a + b s + c s^2, with a >= 0, becomes negative, or infinity."""
    square = b * b - 4.0 * a * c
    if b < 0.0:
        return 2.0 * a / (np.sqrt(square) - b) if square >= 0.0 else np.inf
    return (b + np.sqrt(square)) / (-2.0 * c) if c < 0.0 else np.inf


@lent
def zero_after(t0: float, f0: float, t1: float, f1: float, t2: float, f2: float) -> float:
    """The first zero after t2 of the parabola through three points, t0 <= t1 < t2, or infinity.

    f2 >= 0. If t0 is t1, it is the zero of the line through the last two.
    """
    slope, bend = (f2 - f1) / (t2 - t1), 0.0
    if t1 > t0:
        bend = (slope - (f1 - f0) / (t1 - t0)) / (t2 - t0)
    return t2 + first_root(f2, slope + bend * (t2 - t1), bend)
