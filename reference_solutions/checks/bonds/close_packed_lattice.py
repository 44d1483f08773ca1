"""Second routes to close-packed lattices, for small blocks cut from the crystal and for a cell.

Centres are the points of two hexagonal Bravais lattices inside a box. The static response of a
small block minimises the sum of squares of all elongations and slips of its bonds, without a
stiffness matrix. That of the infinite lattice follows from the energy of a cell of two elements as
a function of the displacement gradient, minimised over the relative displacement of the elements.
"""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

A1 = np.array([1.0, 0.0, 0.0])
A2 = np.array([0.5, np.sqrt(0.75), 0.0])
C = np.array([0.0, 0.0, 2.0 * np.sqrt(2.0 / 3.0)])
SECOND = (A1 + A2) / 3.0 + C / 2.0


def centres(n: int, p: int, q: int) -> Array:
    """All points (N, 3) of the crystal in the box of n - 1, p sqrt3, 2q sqrt(2/3) diameters."""
    reach = range(-n - 2 * p - 2, n + 2 * p + 3)
    points = [
        i * A1 + j * A2 + k * C + basis
        for i in reach
        for j in range(-1, 2 * p + 2)
        for k in range(-1, q + 2)
        for basis in (np.zeros(3), SECOND)
    ]
    box = np.array([n - 1, p * np.sqrt(3.0), 2 * q * np.sqrt(2.0 / 3.0)])
    inside = [x for x in points if (x > -1e-9).all() and (x < box + 1e-9).all()]
    return np.array(inside)


def static(n: int, p: int, q: int, gamma: float) -> tuple[float, float, float]:
    """E d/kn on the area of the hull, nu_x and nu_y of a block between smooth platens."""
    x = centres(n, p, q)
    rows = _slips(x, gamma).reshape(-1, x.size)
    top = x[:, 2] > x[:, 2].max() - 1e-9
    held = np.zeros_like(x, bool)
    held[:, 2] = top | (x[:, 2] < 1e-9)
    u = np.where(held & top[:, None], x[:, 2].max(), 0.0).ravel()
    inner = rows[:, ~held.ravel()]
    u[~held.ravel()] = np.linalg.lstsq(inner, -rows @ u, rcond=1e-10)[0]
    energy = float(((rows @ u) ** 2).sum() / 2.0)
    volume = (n - 1) * p * np.sqrt(3.0) * x[:, 2].max()
    return 2.0 * energy / volume, _width(x, u, 0), _width(x, u, 1)


def compliance(gamma: float) -> Array:
    """The compliance (9, 9) [d/kn] of the infinite lattice, stress to displacement gradient."""
    cell = [i * A1 + j * A2 + k * C for i in (-1, 0, 1) for j in (-1, 0, 1) for k in (-1, 0, 1)]
    rows = []
    for own, other, inner in (
        (np.zeros(3), np.zeros(3), 0.0),
        (SECOND, SECOND, 0.0),
        (np.zeros(3), SECOND, 1.0),
        (SECOND, np.zeros(3), -1.0),
    ):
        for n in (shift + other - own for shift in cell):
            if abs(n @ n - 1.0) < 1e-9:
                whole = np.hstack([np.kron(np.eye(3), n), inner * np.eye(3)])
                rows += [n[None] @ whole, np.sqrt(gamma) * (np.eye(3) - np.outer(n, n)) @ whole]
    B = np.vstack(rows) / np.sqrt(2.0)  # each bond is counted from both its ends
    energy = B.T @ B / (A1[0] * A2[1] * C[2])
    relaxed = energy[:9, :9] - energy[:9, 9:] @ np.linalg.solve(energy[9:, 9:], energy[9:, :9])
    inverse: Array = np.linalg.inv(relaxed)
    return inverse


def pulled(gamma: float, along: Array) -> Array:
    """The displacement gradient (3, 3) of the infinite lattice under the tension kn/d on a line."""
    unit = np.asarray(along) / np.linalg.norm(along)
    gradient: Array = (compliance(gamma) @ np.outer(unit, unit).ravel()).reshape(3, 3)
    return gradient


def _slips(x: Array, gamma: float) -> Array:
    """The coefficients (B, 4, N, 3) in u of each elongation and of sqrt(gamma) times each slip."""
    apart = np.linalg.norm(x[:, None] - x[None], axis=2)
    pairs = np.argwhere(np.triu(np.abs(apart - 1.0) < 1e-6))
    told = np.zeros((len(pairs), 4, len(x), 3))
    for row, (i, j) in zip(told, pairs, strict=True):
        n = x[j] - x[i]
        part = np.vstack([n, np.sqrt(gamma) * (np.eye(3) - np.outer(n, n))])
        row[:, j], row[:, i] = part, -part
    return told


def _width(x: Array, u: Array, axis: int) -> float:
    moved = u.reshape(-1, 3)[:, axis]
    low, high = x[:, axis] < 1e-6, x[:, axis] > x[:, axis].max() - 1e-6
    return float((moved[low].mean() - moved[high].mean()) / x[:, axis].max())
