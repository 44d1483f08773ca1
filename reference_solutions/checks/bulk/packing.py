"""Frictionless spheres at rest in a minimum of their energy: the second route."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Index = NDArray[np.intp]
MOST = 20_000  # steps


def overlaps(x: Array, radius: Array, width: float) -> tuple[Index, Index, Array, Array]:
    """Of pairs i < j: i, j and overlaps; of spheres with five walls: overlaps (n, 5)."""
    i, j = np.triu_indices(len(x), 1)
    reach = radius[i] + radius[j]
    pairs = np.maximum(reach - np.linalg.norm(x[j] - x[i], axis=1), 0.0)
    low, high = x, width - x[:, :2]
    walls = np.maximum(radius[:, None] - np.concatenate([low, high], axis=1), 0.0)
    return i, j, pairs, walls


def energy(
    flat: Array, radius: Array, weight: Array, kn: float, width: float
) -> tuple[float, Array]:
    """Energy of springs and heights [J], and the gradient of both (3 n,) [N]."""
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
    """Contacts per sphere, and the force of the floor [N], when all have come to rest.

    They go down the slope as a body of mass does that drag slows, which balances on no summit.
    """
    found, v = x.ravel(), np.zeros(x.size)
    dt = 0.5 / np.sqrt(kn)  # of masses of one, and of some ten springs to each
    fall = 8.0 * np.sqrt(weight.max() / (x.max() * 30.0))  # 1/s: how fast a fall is slowed
    for _ in range(MOST):
        slope = energy(found, radius, weight, kn, width)[1]
        v = (v - dt * slope) / (1.0 + fall * dt)
        found = found + dt * v
        if np.abs(slope).max() < 1e-6 * weight.max():
            break
    _, _, pairs, walls = overlaps(found.reshape(-1, 3), radius, width)
    count = np.count_nonzero(pairs) + np.count_nonzero(walls)
    return count / len(x), kn * float(walls[:, 2].sum())
