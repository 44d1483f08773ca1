"""A chain of springs on a base, from its equations of motion: the second route.

Modes are roots of a recurrence along the chain, a wave's reflection two linear equations at the
jump, and the motion a Taylor series in time, in which no mode is known.
"""

from math import asin, sin, sqrt

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

TERMS, STEP = 40, 1.0  # of the series, over a step of 1/w0


def residual(w: float, N: int, m: float, K: float) -> float:
    """The residual of the last mass's equation for a wave of w [1/s] that starts at the base.

    0: a mode. Over the largest displacement on the way.
    """
    x = [0.0, 1.0]
    for _ in range(N):
        x.append((2.0 - w * w * m / K) * x[-1] - x[-2])
    return (x[-1] - x[-2]) / max(map(abs, x))  # a free end: no spring beyond it


def reflected(q: float, m: float, M: float) -> float:
    """|R|^2 from the equations of the last light and the first heavy mass, solved for R and T."""
    Q = 2.0 * asin(sqrt(M / m) * sin(q / 2.0))
    light = [np.exp(-1j * q), -np.exp(1j * Q)]  # u_1 by either wave: e^{iq} + R e^{-iq} = T e^{iQ}
    heavy = [1.0, -1.0]  # u_0 by either wave: 1 + R = T
    R, _ = np.linalg.solve(np.array([light, heavy]), -np.array([np.exp(1j * q), 1.0]))
    return float(abs(R) ** 2)


def motion(t: ArrayLike, thrown: ArrayLike, masses: ArrayLike, K: float) -> tuple[Array, Array]:
    """Displacements and velocities (k, N) at times (k,) [s], the first 0, by a series in time."""
    times, m = np.asarray(t, float), np.asarray(masses, float)
    u, v = np.zeros_like(m), np.array(thrown, float)
    found = [(u, v)]
    for span in np.diff(times):
        steps = max(1, int(np.ceil(span * sqrt(K / m.min()) / STEP)))
        for _ in range(steps):
            u, v = _advanced(u, v, m, K, span / steps)
        found.append((u, v))
    return np.array([u for u, _ in found]), np.array([v for _, v in found])


def _advanced(u: Array, v: Array, m: Array, K: float, h: float) -> tuple[Array, Array]:
    """After h [s]: u'' = pull u, so that every second derivative follows from the one before."""
    moved, moving = np.zeros_like(u), np.zeros_like(v)
    even, odd, weight = u, v, 1.0
    for k in range(0, TERMS, 2):
        moved = moved + weight * (even + odd * h / (k + 1))
        moving = moving + weight * odd
        even, odd = _pulled(even, m, K), _pulled(odd, m, K)
        moving = moving + weight * even * h / (k + 1)
        weight *= h * h / ((k + 1) * (k + 2))
    return moved, moving


def _pulled(u: Array, m: Array, K: float) -> Array:
    """The accelerations by the springs."""
    stretch = np.diff(np.concatenate([[0.0], u]))
    force = np.append(stretch[1:], 0.0) - stretch
    return np.asarray(K * force / m)
