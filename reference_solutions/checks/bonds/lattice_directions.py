"""Energy of a strained hexagonal close-packed lattice in a box that repeats: the second route.

The box has four elements; their bonds are found by distance among the images, and all four are
free to move until the energy is least.
"""

from itertools import product
from math import sqrt

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
BOX = np.array([1.0, sqrt(3.0), sqrt(8.0 / 3.0)])
PLACES = BOX * np.array([[0, 0, 0], [0.5, 0.5, 0], [0.5, 1 / 6, 0.5], [0, 2 / 3, 0.5]])


def energy(strain: Array, *, kn: float, ks: float, d: float) -> float:
    """Joules per cubic metre under a symmetric strain (3, 3), to second order."""
    rows, right, weight = [], [], []
    for i, j in product(range(4), repeat=2):
        for image in product((-1, 0, 1), repeat=3):
            r = PLACES[j] + BOX * image - PLACES[i]
            length = np.linalg.norm(r)
            if not 0.9 < length < 1.1:
                continue
            basis = np.linalg.svd(r[None])[2]  # along the bond, then across it
            for axis, k in zip(basis, (kn, ks, ks), strict=True):
                row = np.zeros(12)
                row[3 * j : 3 * j + 3] += axis
                row[3 * i : 3 * i + 3] -= axis
                rows.append(row)
                right.append(axis @ strain @ r)
                weight.append(sqrt(k))
    matrix, moved, root = np.array(rows), np.array(right), np.array(weight)
    shift = np.linalg.lstsq(root[:, None] * matrix, -root * moved)[0]
    stretch = d * root * (moved + matrix @ shift)
    return float(0.25 * (stretch @ stretch) / (BOX.prod() * d**3))  # each bond is met twice
