"""A sphere with drag that bounces on a floor until it no longer leaves it, stage by stage.

It is released from rest at a height above the floor. Its height z over the floor follows z'' = -g -
c z' in flight and z'' = -g - c z' - k^2 z while z < 0, with c = eta/m, k^2 = kn/m. Both are solved
in closed form, and the times at which z = 0 are located between turning points, which are known.
The sphere remains in contact once the highest point of its oscillation is below z = 0. Every
function raises ValueError for parameters outside their ranges.
"""

from collections.abc import Callable
from functools import lru_cache
from math import atan2, cos, exp, inf, log1p, pi, sin, sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reference_solutions.parameters import require_positive, require_times

Array = NDArray[np.float64]

_MOST = 10_000  # stages, at most


class Stage(NamedTuple):
    """A flight or a contact that begins at `begin` [s] at height z [m] with velocity v [m/s]."""

    begin: float
    flies: bool
    z: float
    v: float


def settling(t: ArrayLike, *, m: float, kn: float, eta: float, g: float, height: float) -> Array:
    """The upward displacement [m] at times t >= 0 [s] of any shape."""
    t = require_times(t)
    found = stages(m=m, kn=kn, eta=eta, g=g, height=height)
    which = np.searchsorted([stage.begin for stage in found], t, side="right") - 1
    moved = np.empty(t.shape)
    for i, stage in enumerate(found):
        here = which == i
        path = _flown if stage.flies else _pressed
        moved[here] = path(t[here] - stage.begin, stage, m, kn, eta, g)[0] - height
    return moved


@lru_cache(maxsize=16)
def stages(*, m: float, kn: float, eta: float, g: float, height: float) -> tuple[Stage, ...]:
    """Flights and contacts in turn, up to the contact that does not end."""
    require_positive("in SI units", m=m, kn=kn, eta=eta, g=g, height=height)
    critical = 2.0 * sqrt(kn * m)
    if eta >= critical:
        raise ValueError(f"eta = {eta} N s/m; it must be below 2 sqrt(kn m) = {critical:.6g}")
    law, found = (m, kn, eta, g), [Stage(0.0, True, height, 0.0)]
    for _ in range(_MOST):
        last = found[-1]
        long = _lands(last, *law) if last.flies else _leaves(last, *law)
        if long == inf:
            return tuple(found)
        path = _flown if last.flies else _pressed
        v = float(path(np.array(long), last, *law)[1])
        found.append(Stage(last.begin + long, not last.flies, 0.0, v))
    raise ValueError(f"eta = {eta} N s/m; it bounces more than {_MOST} times")


def _flown(
    s: Array, stage: Stage, m: float, kn: float, eta: float, g: float
) -> tuple[Array, Array]:
    """Height [m] and velocity [m/s] at the times s [s] after a flight began."""
    c = eta / m
    lost = -np.expm1(-c * s)
    fall = g / c
    return stage.z + (stage.v + fall) * lost / c - fall * s, stage.v - (stage.v + fall) * lost


def _pressed(
    s: Array, stage: Stage, m: float, kn: float, eta: float, g: float
) -> tuple[Array, Array]:
    """Height [m] and velocity [m/s] at the times s [s] after a contact began at z = 0."""
    n, square = eta / (2.0 * m), kn / m
    wd, sunk = sqrt(square - n * n), g / square
    b = (stage.v + n * sunk) / wd
    decay, c, sn = np.exp(-n * s), np.cos(wd * s), np.sin(wd * s)
    z = decay * (sunk * c + b * sn) - sunk
    v = decay * ((b * wd - n * sunk) * c - (sunk * wd + n * b) * sn)
    return z, v


def _lands(stage: Stage, m: float, kn: float, eta: float, g: float) -> float:
    """The duration of a flight [s]."""
    c = eta / m
    top = log1p(c * stage.v / g) / c
    most = 2.0 * top + sqrt(2.0 * stage.z / g) + stage.z * c / g
    while _flown(np.array(most), stage, m, kn, eta, g)[0] > 0.0:
        most *= 2.0
    return _root(lambda s: float(_flown(np.array(s), stage, m, kn, eta, g)[0]), top, most)


def _leaves(stage: Stage, m: float, kn: float, eta: float, g: float) -> float:
    """The duration of a contact [s], infinite if it does not end."""
    n, square = eta / (2.0 * m), kn / m
    wd, sunk = sqrt(square - n * n), g / square
    b = (stage.v + n * sunk) / wd
    bottom = (atan2(stage.v, n * b + sunk * wd) / wd) % (pi / wd)
    top = bottom + pi / wd

    def height(s: float) -> float:
        return exp(-n * s) * (b * sin(wd * s) + sunk * cos(wd * s)) - sunk

    return inf if height(top) <= 0.0 else _root(height, bottom, top)


def _root(f: Callable[[float], float], low: float, high: float) -> float:
    from scipy.optimize import brentq

    return float(brentq(f, low, high, xtol=1e-18, rtol=1e-15, maxiter=200))
