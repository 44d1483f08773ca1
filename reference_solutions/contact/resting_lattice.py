"""A close-packed sheet of spheres at rest under its weight in a box that is too narrow for it.

Rows of n and of n - 1 spheres of radius r and mass m alternate; each lies in the gaps of the row
below. The smooth walls are 2 n r (1 - squeeze) apart, less than the width 2 n r of the long rows.
Contacts are linear springs kn without tension. The equilibrium is found by Newton's method on the
forces, whose Jacobian includes the rotation of the normals. Raises ValueError for parameters
outside their ranges.
"""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from reference_solutions.parameters import require_few, require_positive

Array = NDArray[np.float64]
Pairs = list[tuple[int, int]]

_ROUNDS = 50
_MOST = 2000  # spheres: their equations fill a matrix of 128 MB
_STILL = 4e-16  # of kn times the width: the largest remaining force, due to rounding of centres


def packed(n: int, rows: int, r: float) -> Array:
    """The centres (k, 2) [m], across and up, of spheres that just touch in a box 2 n r wide."""
    if n < 2 or rows < 1:
        raise ValueError(f"n = {n}, rows = {rows}; at least 2 spheres and 1 row are needed")
    require_few("spheres", float(n) * float(rows), _MOST)
    require_positive("m", r=r)
    up = r * np.sqrt(3.0)
    return np.array([
        [(1 + row % 2 + 2 * i) * r, r + up * row]
        for row in range(rows)
        for i in range(n - row % 2)
    ])  # fmt: skip


def at_rest(
    *, n: int, rows: int, r: float, m: float, kn: float, g: float, squeeze: float
) -> tuple[Array, float]:
    """The centres (k, 2) [m] at rest, and the width [m] of the box."""
    require_positive("in SI units", m=m, kn=kn, g=g, squeeze=squeeze)
    x, width = packed(n, rows, r), 2.0 * r * n * (1.0 - squeeze)
    x *= 1.0 - squeeze  # vertically too: without contacts the Jacobian is singular
    pairs = list(_neighbours(x, r))
    for _ in range(_ROUNDS):
        force, slope = _forces(x, pairs, r, kn, width)
        force[1::2] -= m * g
        if np.abs(force).max() <= _STILL * kn * width:
            return x, width
        x = x - np.linalg.solve(slope, force).reshape(-1, 2)
    raise ValueError(f"kn = {kn} N/m; no rest was found in {_ROUNDS} rounds")


def _neighbours(x: Array, r: float) -> Iterator[tuple[int, int]]:
    """The pairs whose centres are less than 2.1 r apart, which touch or may come to touch."""
    for i in range(len(x)):
        for j in range(i + 1, len(x)):
            if np.hypot(*(x[j] - x[i])) < 2.1 * r:
                yield i, j


def _forces(x: Array, pairs: Pairs, r: float, kn: float, width: float) -> tuple[Array, Array]:
    """The contact forces (2 k,) [N] on the spheres and their Jacobian (2 k, 2 k) [N/m]."""
    force, slope = np.zeros(2 * len(x)), np.zeros((2 * len(x), 2 * len(x)))
    for i, j in pairs:
        d = x[j] - x[i]
        length = float(np.hypot(*d))
        overlap, along = 2.0 * r - length, d / length
        if overlap > 0.0:
            a, b = slice(2 * i, 2 * i + 2), slice(2 * j, 2 * j + 2)
            force[b] += kn * overlap * along
            force[a] -= kn * overlap * along
            turning = kn * overlap / length * (np.eye(2) - np.outer(along, along))
            block = turning - kn * np.outer(along, along)
            for one, other, sign in ((a, a, 1.0), (b, b, 1.0), (a, b, -1.0), (b, a, -1.0)):
                slope[one, other] += sign * block
    for axis, sense, place in ((0, 1.0, 0.0), (0, -1.0, width), (1, 1.0, 0.0)):
        pressed = r - sense * (x[:, axis] - place)
        touches = np.flatnonzero(pressed > 0.0)
        force[2 * touches + axis] += sense * kn * pressed[touches]
        slope[2 * touches + axis, 2 * touches + axis] -= kn
    return force, slope
