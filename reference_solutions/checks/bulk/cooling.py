"""Event-driven motion of hard spheres in a box: the second route to the cooling of a gas."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Flight(NamedTuple):
    """The numbers of collisions of two and with walls; all times [s], and sum m v v/2 [J] then."""

    pairs: int
    walls: int
    times: Array
    energy: Array


def flight(x: Array, v: Array, side: float, e: tuple[float, float], collisions: int) -> Flight:
    """Follow spheres (n, 3) of unit diameter and mass; e: restitution of two, and at a wall."""
    x, v, n = x.copy(), v.copy(), len(x)
    when = np.full((n, n + 3), np.inf)  # of collisions with spheres, then with walls
    now, pairs = 0.0, 0
    times, energy = np.zeros(collisions), np.zeros(collisions)
    changed = list(range(n))
    for k in range(collisions):
        for a in changed:
            when[a, :n] = when[:, a][:n] = now + _meeting(x - x[a], v - v[a])
            when[a, n:] = now + _facing(x[a], v[a], side)
        a, b = map(int, np.unravel_index(when.argmin(), when.shape))
        x += (when[a, b] - now) * v
        now = float(when[a, b])
        changed = [a] if b >= n else [a, b]
        if b >= n:
            v[a, b - n] *= -e[1]
        else:
            apart = x[b] - x[a]
            push = 0.5 * (1.0 + e[0]) * ((v[b] - v[a]) @ apart) / (apart @ apart) * apart
            v[a] += push
            v[b] -= push
            pairs += 1
        times[k], energy[k] = now, 0.5 * float((v**2).sum())
    return Flight(pairs, collisions - pairs, times, energy)


def _meeting(d: Array, u: Array) -> Array:
    """The times at which spheres at offsets d (n, 3) with velocities u come to a distance of 1."""
    closing, fast, far = (d * u).sum(1), (u * u).sum(1), (d * d).sum(1) - 1.0
    root = closing**2 - fast * far
    hit = (closing < 0.0) & (root > 0.0)
    found = np.full(len(d), np.inf)
    found[hit] = -(closing[hit] + np.sqrt(root[hit])) / fast[hit]
    return found


def _facing(x: Array, v: Array, side: float) -> Array:
    """The times (3,) at which a sphere reaches the wall ahead of it along each axis."""
    return np.asarray(np.where(v > 0.0, side - 0.5 - x, x - 0.5) / np.abs(v))
