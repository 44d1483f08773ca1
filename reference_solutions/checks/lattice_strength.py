"""Second route to the first bond that opens: the block cut from the crystal, by least squares."""

import numpy as np
from numpy.typing import NDArray

from reference_solutions.checks.close_packed_lattice import centres

Array = NDArray[np.float64]


def first_opening(n: int, p: int, q: int, gamma: float) -> float:
    """The stress over kn/d at which a bond is first stretched by a diameter, all being linear.

    Unknowns are the coordinates that no platen holds; what is least is the sum of squares of
    elongations and of slips along two directions across each bond.
    """
    x = centres(n, p, q)
    apart = np.linalg.norm(x[:, None] - x[None], axis=2)
    i, j = np.argwhere(np.triu(np.abs(apart - 1.0) < 1e-6)).T
    frames = (
        np.array([_frame(line) for line in x[j] - x[i]]) * np.sqrt([1.0, gamma, gamma])[:, None]
    )
    told = np.zeros((len(i), 3, len(x), 3))
    for k in range(len(i)):
        told[k, :, j[k]], told[k, :, i[k]] = frames[k], -frames[k]
    rows = told.reshape(3 * len(i), x.size)
    height, z = x[:, 2].max(), np.zeros_like(x)
    z[:, 2] = x[:, 2]
    free = np.ones_like(x, bool)
    free[:, 2] = (x[:, 2] > 1e-9) & (x[:, 2] < height - 1e-9)
    u = z.ravel()  # at the strain 1, with what is free still to move
    u[free.ravel()] -= np.linalg.lstsq(rows[:, free.ravel()], rows @ u, rcond=1e-10)[0]
    moved = (rows @ u).reshape(-1, 3)
    modulus = (moved**2).sum() / ((n - 1) * p * np.sqrt(3.0) * height)
    return float(modulus / moved[:, 0].max())


def _frame(line: Array) -> Array:
    """(3, 3) rows: a unit vector and two across it."""
    other = np.eye(3)[np.abs(line).argmin()]
    first = np.cross(line, other) / np.linalg.norm(np.cross(line, other))
    return np.array([line, first, np.cross(line, first)])
