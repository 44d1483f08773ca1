"""The fall of an arch too thin to stand, from its energy: the second route.

Half of a symmetric arch of n voussoirs with straight edges consists of two bodies. The lower
rotates about the outer edge of the springing. The upper is hinged to it at the inner edge of the
joint between them, and its outer edge at the crown stays in the plane of symmetry (the mechanism of
Heyman 1969). All positions are closed forms of one degree of freedom q, the rotation of the lower
body, and the conservation of energy gives t(q) as an integral. Lengths except `size` are in mean
radii. Parameters are those of `reference_solutions.hard.falling_arch`, whose code is not used here.
Each time takes half a second of computation.
"""

from collections.abc import Sequence
from math import pi

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(40)
_LEAST = 1e-6  # rad; below it, q grows as t^2
_X, _W = 0.5 * (_NODES + 1.0), 0.5 * _WEIGHTS


def crown_drop(t: ArrayLike, *, n: int, thick: float, size: float, g: float) -> Array:
    """The drop [m] of the voussoir beside the crown at times t >= 0 (k,) [s]."""
    t, rate = np.asarray(t, dtype=np.float64), np.sqrt(g / size)
    joint = _joint(n, thick)
    q = np.array([_turn(float(s) * rate, n, thick, joint) for s in t])
    heights = np.array([_places(one, n, thick, joint)[-1, 1] for one in (0.0, *q)])
    return np.asarray(size * (heights[0] - heights[1:]))  # fmt: skip


def _joint(n: int, thick: float) -> int:
    """The hinge joint, counted from the springing: that with the largest initial loss of energy."""
    starts = [_drop(_LEAST, n, thick, j) for j in range(1, n // 2)]
    return 1 + int(np.argmax(starts))


def _turn(time: float, n: int, thick: float, joint: int) -> float:
    """The q [rad] at which t(q) = time, in units of sqrt(size/g)."""
    from scipy.optimize import brentq

    low, first = _LEAST, _time(_LEAST, n, thick, joint)
    if time <= first:
        return low * (time / first) ** 2
    while _time(2.0 * low, n, thick, joint) < time:
        low *= 2.0
    return float(brentq(lambda q: _time(q, n, thick, joint) - time, low, 2.0 * low, xtol=1e-16))


def _time(q: float, n: int, thick: float, joint: int) -> float:
    """The time of the fall to q: the integral of sqrt(M/(2 dV)) over q.

    The substitution q x^2 removes the singularity at 0.
    """
    ways = q * _X**2
    pace = [
        np.sqrt(_inertia(way, n, thick, joint) / (2.0 * _drop(way, n, thick, joint)))
        for way in ways
    ]
    return float(_W @ (2.0 * q * _X * np.array(pace)))


def _drop(q: float, n: int, thick: float, joint: int) -> float:
    """The loss dV of potential energy, for unit density and g."""
    areas = np.array([area for area, _, _ in _voussoirs(n, thick)])
    before, after = (_places(one, n, thick, joint)[:, 1] for one in (0.0, q))
    return float(areas @ (before - after))


def _inertia(q: float, n: int, thick: float, joint: int) -> float:
    """The generalised mass M of the kinetic energy M q'^2/2, for unit density."""
    h = 1e-5
    moved = (_places(q + h, n, thick, joint) - _places(q - h, n, thick, joint)) / (2.0 * h)
    turned = (_turns(q + h, n, thick, joint) - _turns(q - h, n, thick, joint)) / (2.0 * h)
    return float(sum(
        area * (move @ move + square * turned[int(k >= joint)] ** 2)
        for k, ((area, _, square), move) in enumerate(zip(_voussoirs(n, thick), moved, strict=True))
    ))  # fmt: skip


def _hinges(n: int, thick: float, joint: int) -> tuple[Array, Array, Array]:
    """The hinges at the springing, the joint and the crown, (2,) each."""
    inner, outer = 1.0 - 0.5 * thick, 1.0 + 0.5 * thick
    angle = pi * joint / n
    return (
        np.array([outer, 0.0]), inner * np.array([np.cos(angle), np.sin(angle)]),
        np.array([0.0, outer]),
    )  # fmt: skip


def _turns(q: float, n: int, thick: float, joint: int) -> Array:
    """The rotations (2,) [rad] of the lower and the upper body; the arch falls as q grows."""
    foot, middle, crown = _hinges(n, thick, joint)
    arm, reach = middle - foot, crown - middle
    across = foot[0] + np.cos(q) * arm[0] + np.sin(q) * arm[1]
    start = np.arctan2(reach[1], reach[0])
    return np.array([-q, np.arccos(-across / np.hypot(*reach)) - start])


def _places(q: float, n: int, thick: float, joint: int) -> Array:
    """The centroids (n/2, 2) of the voussoirs, from the springing to the crown."""
    foot, middle, _ = _hinges(n, thick, joint)
    lower, upper = (_rotation(turn) for turn in _turns(q, n, thick, joint))
    moved = foot + lower @ (middle - foot)
    return np.array([
        foot + lower @ (place - foot) if k < joint else moved + upper @ (place - middle)
        for k, (_, place, _) in enumerate(_voussoirs(n, thick))
    ])  # fmt: skip


def _rotation(angle: float) -> Array:
    return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])


def _voussoirs(n: int, thick: float) -> Sequence[tuple[float, Array, float]]:
    """Area, centroid (2,) and squared radius of gyration of each voussoir of half the arch."""
    opening, inner, outer = pi / n, 1.0 - 0.5 * thick, 1.0 + 0.5 * thick
    a, b = (edge * np.sin(0.5 * opening) for edge in (inner, outer))  # half of the edges
    low, height = inner * np.cos(0.5 * opening), thick * np.cos(0.5 * opening)
    area, out = (a + b) * height, low + height * (a + 2.0 * b) / (3.0 * (a + b))
    along = height**2 * (a * a + 4.0 * a * b + b * b) / (18.0 * (a + b) ** 2)
    across = (a * a + b * b) / 6.0
    middles = opening * (np.arange(n // 2) + 0.5)
    return [(area, out * np.array([np.cos(m), np.sin(m)]), along + across) for m in middles]
