"""Taylor series in time of a slip that changes direction: of its driving force and its start."""

from __future__ import annotations

import math

import numpy as np

from vv.engines.kernels.compiled import lent
from vv.scene import Vector

GRID = 2.0**20  # 1/s: a time is a multiple of 1/GRID plus a remainder
ORDER = 28  # of the series of position; that of the velocity is one less
OVER = 1.0 / np.arange(1, ORDER + 2)  # 1/(n + 1), which saves a division for each coefficient
REACH = (
    0.23  # (1e-17)^(1/27): step over the radius of convergence, so that the last term is rounding
)


@lent
def angle(sines: Vector, i: int, t: float) -> float:
    """The phase [rad] of a sine at time t [s] without whole turns, equally accurate at any time.

    sines (k, 4): frequency [Hz] in two parts, of which the first has so few digits that its product
    with a time on the grid is exact; phase [rad]; angular frequency [rad/s].
    """
    whole = math.floor(t * GRID) / GRID
    turns = sines[i, 0] * whole
    turns -= math.floor(turns)
    turns += sines[i, 0] * (t - whole) + sines[i, 1] * t
    return float(2 * math.pi * turns + sines[i, 2])


@lent
def expand_drive(rows: Vector, sines: Vector, t: float, h: float, out: Vector) -> None:
    """Fill out (3, ORDER + 1) with the series of rows[:, 0] + rows[:, 1:] @ sines about time t.

    Its variable is time in units of h [s].
    """
    out[:, :] = 0.0
    for r in range(3):
        out[r, 0] = rows[r, 0]
    for i in range(len(sines)):
        now, turn, size = angle(sines, i, t), sines[i, 3] * h, 1.0
        sine, cosine = math.sin(now), math.cos(now)
        for n in range(out.shape[1]):
            value = size * (cosine if n % 2 else sine) * (-1.0 if n % 4 > 1 else 1.0)
            for r in range(3):
                out[r, n] += rows[r, 1 + i] * value
            size *= turn * OVER[n]


@lent
def expand_start(drive: Vector, h: float, power: int, v: Vector, z: Vector, work: Vector) -> None:
    """The series (ORDER,) of a slip from rest: x^power v along T(0), and z v x^power across it.

    power: 2 if |T| rises above F, 1 if it is above F at once. drive (3, ORDER + 1): the series of T
    and F in the frame whose first axis is along T(0); work (2, ORDER): those of 1/sqrt(1 + z^2) and
    of z over that root. With power 2 the series of the direction is asymptotic: other slips
    approach this solution faster and faster as x decreases to 0.
    """
    root, across = work[0], work[1]
    for j in range(len(v)):
        v[j] = z[j] = across[j] = root[j] = 0.0
    root[0] = 1.0
    if power == 1:
        v[0] = h * (drive[0, 0] - drive[2, 0])
    for j in range(1, len(v)):
        root[j] = _inverse_root(root, z, j)
        force = drive[0, j]
        for i in range(j + 1):
            force -= drive[2, i] * root[j - i]
        v[j + 1 - power] = h * force / (j + 1)
        known = 0.0
        for i in range(1, j):
            known += z[i] * root[j - i]
        force = drive[1, j] - drive[2, 0] * known
        for i in range(1, j):
            force -= drive[2, i] * across[j - i]
        for i in range(2 - power, j):
            force -= (j + 1) / h * v[i] * z[j + 1 - power - i]
        z[j] = force / (drive[2, 0] + (2 - power) * (j + 1) / h * v[0])
        across[j] = known + z[j]


@lent
def _inverse_root(root: Vector, z: Vector, j: int) -> float:
    """Coefficient j of (1 + z^2)^(-1/2) from the coefficients before it; z[0] = 0."""
    total = 0.0
    for i in range(2, j + 1):
        square = 0.0
        for k in range(1, i):
            square += z[k] * z[i - k]
        total += (0.5 * i - j) * square * root[j - i] / j
    return total
