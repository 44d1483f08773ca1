"""Taylor series of a slip that turns: of its drive, of a step, and of its start from rest."""

from __future__ import annotations

import math

import numpy as np

from vv.engines.kernels.compiled import lent
from vv.scene import Vector

GRID = 2.0**20  # 1/s: what a time is more than a multiple of 1/GRID is kept apart
ORDER = 28  # of the series of the place; that of the velocity is one less
OVER = 1.0 / np.arange(1, ORDER + 2)  # over n + 1, which would be a division for each coefficient
SERIES = 8  # that `expand_slip` works with
REACH = 0.23  # (1e-17)^(1/27): of the radius of convergence, so that the last term is rounding


@lent
def angle(sines: Vector, i: int, t: float) -> float:
    """The phase [rad] of a sine at time t [s], whole turns left out, as sharp late as at first.

    sines (k, 4): frequency [Hz] in two parts of which the first has few digits, so that its
    product with a time on the grid is exact; phase [rad]; 2 pi times the frequency [rad/s].
    """
    whole = math.floor(t * GRID) / GRID
    turns = sines[i, 0] * whole
    turns -= math.floor(turns)
    turns += sines[i, 0] * (t - whole) + sines[i, 1] * t
    return float(2 * math.pi * turns + sines[i, 2])


@lent
def expand_drive(rows: Vector, sines: Vector, t: float, h: float, out: Vector) -> None:
    """Coefficients (3, ORDER + 1) at time t of rows[:, 0] + rows[:, 1:] @ sines, in units of h."""
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
def expand_slip(drive: Vector, h: float, w: Vector, work: Vector) -> None:
    """Coefficients (2, ORDER) of w' = T - F w/|w| from those at its start, w[:, 0] [m/s].

    drive: (3, ORDER + 1) those of T and F [m/s2]; work: (SERIES, ORDER). A coefficient is added to
    all that it is a factor of as soon as it is known: such sums need not wait for one another, as
    the terms of one product would. For this reason it is one loop in one function.
    """
    x, y, last = w[0], w[1], w.shape[1] - 1
    square, inverse, pull = work[0], work[1], work[2]  # |w|^2, 1/|w| and F/|w|
    risen, fallen, whole = work[3], work[4], work[5]  # n/2 of the first, n and sums of the second
    along, across = work[6], work[7]
    for n in range(last):
        square[n] = whole[n] = pull[n] = 0.0
        along[n], across[n] = drive[0, n], drive[1, n]
    inverse[0] = 1 / math.sqrt(x[0] * x[0] + y[0] * y[0])
    scale = inverse[0] * inverse[0]
    for n in range(last):
        both = min(n, last - n)  # so many coefficients before this one make a product that counts
        a, b = 2 * x[n], 2 * y[n]
        for i in range(both):
            square[n + i] += a * x[i] + b * y[i]
        if 2 * n < last:
            square[2 * n] += x[n] * x[n] + y[n] * y[n]
        s = square[n]
        risen[n] = 0.5 * n * s
        for i in range(both):  # q = s^(-1/2) obeys 2 s q' = -s' q
            whole[n + i] += risen[n] * inverse[i] + s * fallen[i]
        if n > 0:
            inverse[n] = -scale * OVER[n - 1] * whole[n]
        q = inverse[n]
        fallen[n] = n * q
        for i in range(1, min(n + 1, last - n)):
            whole[n + i] += q * risen[i] + fallen[n] * square[i]
        for i in range(last - n):
            pull[n + i] += q * drive[2, i]
        p, u, v = pull[n], x[n], y[n]
        for i in range(both):
            along[n + i] -= p * x[i] + u * pull[i]
            across[n + i] -= p * y[i] + v * pull[i]
        if 2 * n < last:
            along[2 * n] -= p * u
            across[2 * n] -= p * v
        x[n + 1], y[n + 1] = h * OVER[n] * along[n], h * OVER[n] * across[n]


@lent
def expand_start(drive: Vector, h: float, power: int, v: Vector, z: Vector, work: Vector) -> None:
    """Coefficients (ORDER,) of a slip from rest at x = 0: x^power v along T(0), z v x^power across.

    power 2 where |T| rises above F, 1 where it is above at once. drive: as in `expand_slip`, in
    the frame whose first axis is along T(0); work: (2, ORDER), of 1/sqrt(1 + z^2) and z over
    that root. With power 2 the series of the direction is asymptotic, since the slip is drawn to
    this solution ever faster as x falls to 0.
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
    """The coefficient j of (1 + z^2)^(-1/2) from those before it; z[0] = 0."""
    total = 0.0
    for i in range(2, j + 1):
        square = 0.0
        for k in range(1, i):
            square += z[k] * z[i - k]
        total += (0.5 * i - j) * square * root[j - i] / j
    return total
