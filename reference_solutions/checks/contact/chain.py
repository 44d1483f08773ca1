"""A chain of springs on a base, from its equations of motion: the second route.

Modes are roots of a recurrence along the chain. The reflection of a wave follows from two linear
equations at the change of mass, and the motion from a Taylor series in time, without modes. The
leapfrog is stepped.
"""

from math import asin, sin, sqrt

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

TERMS, STEP = 40, 1.0  # terms of the series; step times sqrt(K/m)


def residual(w: float, N: int, m: float, K: float) -> float:
    """The residual at the free end of the recurrence from the base at w [1/s]; it is 0 for a mode.

    It is relative to the largest displacement in the chain.
    """
    x = [0.0, 1.0]
    for _ in range(N):
        x.append((2.0 - w * w * m / K) * x[-1] - x[-2])
    return (x[-1] - x[-2]) / max(map(abs, x))  # free end: no spring beyond


def reflected(q: float, m: float, M: float) -> float:
    """|R|^2 from the equations of the last light and the first heavy mass, solved for R and T."""
    Q = 2.0 * asin(sqrt(M / m) * sin(q / 2.0))
    light = [np.exp(-1j * q), -np.exp(1j * Q)]  # u_1 of each wave: e^{iq} + R e^{-iq} = T e^{iQ}
    heavy = [1.0, -1.0]  # u_0 of each wave: 1 + R = T
    R, _ = np.linalg.solve(np.array([light, heavy]), -np.array([np.exp(1j * q), 1.0]))
    return float(abs(R) ** 2)


def motion(t: ArrayLike, thrown: ArrayLike, masses: ArrayLike, K: float) -> tuple[Array, Array]:
    """Displacements and velocities (k, N) at times (k,) [s] from 0 on, by a series in time."""
    times, m = np.asarray(t, float), np.asarray(masses, float)
    u, v = np.zeros_like(m), np.array(thrown, float)
    found = [(u, v)]
    for span in np.diff(times):
        steps = max(1, int(np.ceil(span * sqrt(K / m.min()) / STEP)))
        for _ in range(steps):
            u, v = _advanced(u, v, m, K, span / steps)
        found.append((u, v))
    return np.array([u for u, _ in found]), np.array([v for _, v in found])


def leapfrog(steps: int, thrown: ArrayLike, masses: ArrayLike, K: float, dt: float) -> Array:
    """Velocities (steps + 1, N) at whole steps, each the mean of those half a step off."""
    m, u, v = np.asarray(masses, float), np.zeros(np.shape(thrown)), np.array(thrown, float)
    found = [v]
    for _ in range(steps):
        v = v + _pulled(u, m, K) * dt / 2
        u = u + v * dt
        v = v + _pulled(u, m, K) * dt / 2
        found.append(v)
    return np.array(found)


def _advanced(u: Array, v: Array, m: Array, K: float, h: float) -> tuple[Array, Array]:
    """u and v after h [s], by a series: u'' is linear in u, which gives all higher derivatives."""
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
    """The accelerations (N,) due to the springs."""
    stretch = np.diff(np.concatenate([[0.0], u]))
    force = np.append(stretch[1:], 0.0) - stretch
    return np.asarray(K * force / m)
