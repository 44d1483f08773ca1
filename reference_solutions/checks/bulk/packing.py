"""Frictionless spheres at rest by minimisation of their energy: the second route."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Index = NDArray[np.intp]
MOST = 20_000  # largest number of steps


def overlaps(x: Array, radius: Array, width: float) -> tuple[Index, Index, Array, Array]:
    """Indices i < j and overlaps of all pairs, and the overlaps (n, 5) with the five walls."""
    i, j = np.triu_indices(len(x), 1)
    reach = radius[i] + radius[j]
    pairs = np.maximum(reach - np.linalg.norm(x[j] - x[i], axis=1), 0.0)
    low, high = x, width - x[:, :2]
    walls = np.maximum(radius[:, None] - np.concatenate([low, high], axis=1), 0.0)
    return i, j, pairs, walls


def energy(
    flat: Array, radius: Array, weight: Array, kn: float, width: float
) -> tuple[float, Array]:
    """The energy of springs and gravity [J], and its gradient (3 n,) [N]."""
    x = flat.reshape(-1, 3)
    i, j, pairs, walls = overlaps(x, radius, width)
    total = 0.5 * kn * float((pairs**2).sum() + (walls**2).sum()) + float(weight @ x[:, 2])
    slope = -kn * walls[:, :3]
    slope[:, :2] += kn * walls[:, 3:]
    slope[:, 2] += weight
    closed = pairs > 0
    d = x[j[closed]] - x[i[closed]]
    push = kn * (pairs[closed] / np.linalg.norm(d, axis=1))[:, None] * d
    np.add.at(slope, i[closed], push)
    np.add.at(slope, j[closed], -push)
    return total, slope.ravel()


def settled(x: Array, radius: Array, weight: Array, kn: float, width: float) -> tuple[float, float]:
    """Contacts per sphere, and the force on the floor [N], once all spheres are at rest.

    The spheres descend the gradient with inertia and drag, so that they do not stop at a saddle
    point.
    """
    found, v = x.ravel(), np.zeros(x.size)
    dt = 0.5 / np.sqrt(kn)  # step for unit masses with about ten springs each
    fall = 8.0 * np.sqrt(weight.max() / (x.max() * 30.0))  # rate of drag [1/s]
    for _ in range(MOST):
        slope = energy(found, radius, weight, kn, width)[1]
        v = (v - dt * slope) / (1.0 + fall * dt)
        found = found + dt * v
        if np.abs(slope).max() < 1e-6 * weight.max():
            break
    _, _, pairs, walls = overlaps(found.reshape(-1, 3), radius, width)
    count = np.count_nonzero(pairs) + np.count_nonzero(walls)
    return count / len(x), kn * float(walls[:, 2].sum())
