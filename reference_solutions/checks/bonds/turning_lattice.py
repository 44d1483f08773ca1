"""Second route to lattices with rotation: least squares of the separation of touching points.

Every element is a rigid sphere. A bond joins the touching points of two spheres, each of which
follows the displacement and rotation of its sphere. No stiffness matrix is formed. Lengths are in
diameters.
"""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def static(x: Array, gamma: float) -> tuple[float, Array]:
    """The force on the platens over kn and the displacements of spheres at the axial strain 1."""
    N = len(x)
    low, high = (np.abs(x[:, 2] - edge) < 1e-6 for edge in (x[:, 2].min(), x[:, 2].max()))
    known = np.zeros((N, 6), bool)
    known[low | high, 2] = True
    q = np.where(known & high[:, None], np.ptp(x[:, 2]), 0.0).ravel()
    rows = np.concatenate([_parting(x, i, j, gamma) for i, j in _touching(x)])
    free = ~known.ravel()
    q[free] = np.linalg.lstsq(rows[:, free], -rows @ q, rcond=1e-10)[0]
    force = (rows.T @ (rows @ q)).reshape(N, 6)[high, 2].sum()
    return float(force), q.reshape(N, 6)[:, :3]


def _touching(x: Array) -> list[tuple[int, int]]:
    apart = np.linalg.norm(x[:, None] - x[None], axis=2)
    return [(int(i), int(j)) for i, j in np.argwhere(np.triu(np.abs(apart - 1.0) < 1e-6))]


def _parting(x: Array, i: int, j: int, gamma: float) -> Array:
    """The coefficients (4, 6N) of the separation of two points along a bond, and across it.

    The component across is multiplied by sqrt(gamma).
    """
    place = (x[i] + x[j]) / 2.0
    told = np.zeros((3, len(x), 6))
    for ball, sign in ((i, -1.0), (j, 1.0)):
        for axis in range(3):
            unit = np.eye(3)[axis]
            told[:, ball, axis] = sign * unit
            told[:, ball, 3 + axis] = sign * np.cross(unit, place - x[ball])
    n = x[j] - x[i]
    across = np.sqrt(gamma) * (np.eye(3) - np.outer(n, n))
    return np.asarray(np.vstack([n[None], across]) @ told.reshape(3, -1))
