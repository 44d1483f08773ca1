"""Second route to the strength of blocks: repeated right-angled cells, by least squares."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Pairs = tuple[NDArray[np.int64], NDArray[np.int64]]

SIDES = np.array([1.0, np.sqrt(3.0), np.sqrt(8.0 / 3.0)])  # of a cell, in diameters
CELL = np.array(
    [[0, 0, 0], [1 / 2, 1 / 2, 0], [1 / 2, 1 / 6, 1 / 2], [0, 2 / 3, 1 / 2]]
)  # in sides


def first_opening(n: int, p: int, q: int, gamma: float) -> float:
    """The stress over kn/d at which a bond is first stretched by a diameter, in linear theory."""
    x = _centres(np.array([n - 1, p, q]))
    modulus, moved = _strained(x, _touching(x), gamma)
    return float(modulus / moved[:, 0].max())


def slidings(n: int, p: int, q: int, gamma: float, mu: float) -> Array:
    """(b,) the pressures over fs0/d^2 at which inclined bonds slide, in linear theory.

    There are no other bonds; one slides where what is across it is fs0 and mu of what pushes.
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
    """Of a block at the strain 1: stress over kn/d; (b, 3) stretches, slips times sqrt(gamma).

    Unknowns are the coordinates that no platen holds; what is least is the sum of the squares of
    these, along and in two directions across each bond.
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
    u = z.ravel()  # at the strain 1, with what is free still to move
    u[free.ravel()] -= np.linalg.lstsq(rows[:, free.ravel()], rows @ u, rcond=1e-10)[0]
    moved = (rows @ u).reshape(-1, 3)
    modulus = (moved**2).sum() / (np.ptp(x[:, 0]) * np.ptp(x[:, 1]) * height)
    return float(modulus), moved


def _centres(sides: Array) -> Array:
    """(N, 3) the elements of the cells in a box of so many sides, its faces included."""
    cells = np.stack(np.meshgrid(*(np.arange(k + 1) for k in sides)), axis=-1).reshape(-1, 1, 3)
    places = (cells + CELL).reshape(-1, 3)
    inside: Array = places[(places < sides + 1e-9).all(axis=1)] * SIDES
    return inside


def _frame(line: Array) -> Array:
    """(3, 3) rows: a unit vector and two across it."""
    other = np.eye(3)[np.abs(line).argmin()]
    first = np.cross(line, other) / np.linalg.norm(np.cross(line, other))
    return np.array([line, first, np.cross(line, first)])
