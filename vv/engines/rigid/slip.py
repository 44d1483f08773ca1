"""The direction of friction over a step in which slip turns, for kernels."""

from __future__ import annotations

import numpy as np

from vv.engines.kernels.arrays import larger, smaller, square_of
from vv.engines.kernels.compiled import inlined, lent
from vv.engines.kernels.triples import Triple, add_scaled, cross, dot
from vv.engines.rigid.limits import STILL

STRAIGHT = 1e-14  # sine, squared, of an angle by which slip does not turn
SLOW = 2.0  # times the pull of friction in a step: a slower slip has its direction from friction


@inlined
def slow(span: float, pull: float, tolerance: float) -> float:
    """A speed [m/s] that a contact solved to a tolerance has without slip, after a step [s].

    pull: see `vv.engines.rigid.scales`.
    """
    return larger(STILL * pull * span, 10.0 * tolerance)


@lent
def heading(before: Triple, after: Triple) -> Triple:
    """The mean of u/|u| as u goes straight, at a constant rate, from `before` to `after`.

    With e along the way, x = u . e, and r the vector from zero to the way, it is
    e (|u1| - |u0|)/(x1 - x0) + r/|r| (asinh(x1/|r|) - asinh(x0/|r|))/(x1 - x0).
    """
    nil = (0.0, 0.0, 0.0)
    first, last = np.sqrt(dot(before, before)), np.sqrt(dot(after, after))
    across = cross(before, after)
    if not dot(across, across) > STRAIGHT * square_of(first * last):
        return add_scaled(add_scaled(nil, 0.5 / first, before), 0.5 / last, after)
    way = add_scaled(after, -1.0, before)
    length = np.sqrt(dot(way, way))
    e = add_scaled(nil, 1.0 / length, way)
    x0, x1 = dot(before, e), dot(after, e)
    out = add_scaled(before, -x0, e)
    far = np.sqrt(dot(out, out))
    mean = add_scaled(nil, (x0 + x1) / (first + last), e)
    return add_scaled(mean, (np.arcsinh(x1 / far) - np.arcsinh(x0 / far)) / length, out)


@lent
def bend(before: Triple, sag: Triple, after: Triple, pull: float) -> Triple:
    """The mean direction of slip over a step less the mean of its first and last directions.

    before, after: slip velocities, not nil; sag: how far the drives take the slip halfway from
    the mean of both; pull: how much friction changes it in the step [m/s]. The slip goes straight
    to halfway and on from there. Nil where it is so slow that friction could turn it about.
    """
    nil = (0.0, 0.0, 0.0)
    straight = add_scaled(add_scaled(nil, 0.5, before), 0.5, after)
    halfway = add_scaled(straight, 1.0, sag)
    first, last = dot(before, before), dot(after, after)
    one, two = cross(before, after), cross(before, halfway)
    slowest = smaller(smaller(first, dot(halfway, halfway)), last)
    if not slowest > square_of(SLOW * pull):
        return nil
    if not (dot(one, one) > STRAIGHT * first * last or dot(two, two) > STRAIGHT * first * first):
        return nil
    early, late = heading(before, halfway), heading(halfway, after)
    halfway = add_scaled(add_scaled(halfway, -0.25 * pull, early), 0.25 * pull, late)
    early, late = heading(before, halfway), heading(halfway, after)
    mean = add_scaled(add_scaled(nil, 0.5, early), 0.5, late)
    return add_scaled(add_scaled(mean, -0.5 / np.sqrt(first), before), -0.5 / np.sqrt(last), after)


@lent
def first_root(a: float, b: float, c: float) -> float:
    """The first s >= 0 from which on a + b s + c s^2, which begins at a >= 0, is negative."""
    square = b * b - 4.0 * a * c
    if b < 0.0:
        return 2.0 * a / (np.sqrt(square) - b) if square >= 0.0 else np.inf
    return (b + np.sqrt(square)) / (-2.0 * c) if c < 0.0 else np.inf
