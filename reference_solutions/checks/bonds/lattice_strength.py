"""Second route to the strength of blocks: rectangular cells, repeated, and least squares."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Pairs = tuple[NDArray[np.int64], NDArray[np.int64]]

SIDES = np.array([1.0, np.sqrt(3.0), np.sqrt(8.0 / 3.0)])  # of a cell, in diameters
CELL = np.array(
    [[0, 0, 0], [1 / 2, 1 / 2, 0], [1 / 2, 1 / 6, 1 / 2], [0, 2 / 3, 1 / 2]]
)  # elements of a cell, in units of its sides


def first_opening(n: int, p: int, q: int, gamma: float) -> float:
    """The stress over kn/d at which a bond is first stretched by a diameter, in linear theory."""
    x = _centres(np.array([n - 1, p, q]))
    modulus, moved = _strained(x, _touching(x), gamma)
    return float(modulus / moved[:, 0].max())


def slidings(n: int, p: int, q: int, gamma: float, mu: float) -> Array:
    """The pressures (b,) over fs0/d^2 at which inclined bonds slide, in linear theory.

    There are no other bonds. A bond slides when its shear force is fs0 plus mu times its normal
    force, compression positive.
    """
    x = _centres(np.array([n - 1, p, q]))
    i, j = _touching(x)
    inclined = np.abs(x[j, 2] - x[i, 2]) > 1e-6
    modulus, moved = _strained(x, (i[inclined], j[inclined]), gamma)
    across = np.sqrt(gamma) * np.linalg.norm(moved[:, 1:], axis=1)
    slidings: Array = modulus / (across - mu * moved[:, 0])
    return slidings


def _touching(x: Array) -> Pairs:
    apart = np.linalg.norm(x[:, None] - x[None], axis=2)
    i, j = np.argwhere(np.triu(np.abs(apart - 1.0) < 1e-6)).T
    return i, j


def _strained(x: Array, bonds: Pairs, gamma: float) -> tuple[float, Array]:
    """The stress over kn/d of a block at the strain 1, and the displacements (b, 3) of its bonds.

    These are the stretch of each bond and sqrt(gamma) times its two slips. The coordinates that no
    platen prescribes minimise the sum of their squares.
    """
    i, j = bonds
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
    u = z.ravel()  # a uniform strain 1, before the free coordinates relax
    u[free.ravel()] -= np.linalg.lstsq(rows[:, free.ravel()], rows @ u, rcond=1e-10)[0]
    moved = (rows @ u).reshape(-1, 3)
    modulus = (moved**2).sum() / (np.ptp(x[:, 0]) * np.ptp(x[:, 1]) * height)
    return float(modulus), moved


def _centres(sides: Array) -> Array:
    """The elements (N, 3) in a box whose sides are these numbers of cells, its faces included."""
    cells = np.stack(np.meshgrid(*(np.arange(k + 1) for k in sides)), axis=-1).reshape(-1, 1, 3)
    places = (cells + CELL).reshape(-1, 3)
    inside: Array = places[(places < sides + 1e-9).all(axis=1)] * SIDES
    return inside


def _frame(line: Array) -> Array:
    """The rows (3, 3) are a unit vector and two unit vectors perpendicular to it."""
    other = np.eye(3)[np.abs(line).argmin()]
    first = np.cross(line, other) / np.linalg.norm(np.cross(line, other))
    return np.array([line, first, np.cross(line, first)])
