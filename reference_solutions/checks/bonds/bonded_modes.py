"""Second route to the fastest mode of bonded elements, by power iteration.

The fastest mode of an infinite lattice is found among its plane waves.
"""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
PULLS = 3000


def fastest_mode(
    position: Array, bonds: NDArray[np.int64], kn: float, ks: float, m: float
) -> float:
    """The highest w [1/s] by power iteration on the forces of the bonds."""
    i, j = bonds.T
    n = position[j] - position[i]
    n = n / np.linalg.norm(n, axis=1)[:, None]
    u = np.sin(1.0 + np.arange(3.0 * len(position))).reshape(len(position), 3)
    pull = 0.0
    for _ in range(PULLS):
        apart = u[j] - u[i]
        along = (apart * n).sum(axis=1)[:, None] * n
        force = np.zeros_like(u)
        np.add.at(force, i, kn * along + ks * (apart - along))
        np.add.at(force, j, -kn * along - ks * (apart - along))
        pull = float(np.linalg.norm(force))
        u = force / pull
    return float(np.sqrt(pull / m))


CELL = np.array([[1.0, 0.0, 0.0], [0.5, np.sqrt(3 / 4), 0.0], [0.0, 0.0, np.sqrt(8 / 3)]])
INSIDE = np.array([np.zeros(3), [0.5, np.sqrt(1 / 12), np.sqrt(2 / 3)]])
TURNS = 2 * np.pi * np.linalg.inv(CELL).T


def fastest_wave(gamma: float) -> float:
    """The largest m w^2/kn of plane waves in infinite hexagonal close packing; gamma = ks/kn."""
    best = max((np.array(k) / 8 for k in np.ndindex(9, 9, 5)), key=lambda k: square(k, gamma))
    size = 1 / 8
    for _ in range(40):
        near = [best + size * (np.array(k) - 1.0) for k in np.ndindex(3, 3, 3)]
        better = max(near, key=lambda k: square(k, gamma))
        size, best = (size if (better != best).any() else size / 2), better
    return square(best, gamma)


def square(wave: Array, gamma: float) -> float:
    """m w^2/kn of the fastest of the six waves with the wave vector `wave` [periods per cell]."""
    matrix = np.zeros((2, 3, 2, 3), complex)
    for s, t, reach in _contacts():
        spring = (1.0 - gamma) * np.outer(reach, reach) + gamma * np.eye(3)
        matrix[s, :, s] += spring
        matrix[s, :, t] -= spring * np.exp(1j * (wave @ TURNS @ reach))
    return float(np.linalg.eigvalsh(matrix.reshape(6, 6))[-1])


def _contacts() -> list[tuple[int, int, Array]]:
    """The twelve contacts of each element of a cell: element, neighbour, vector between them."""
    return [
        (s, t, reach)
        for s in range(2)
        for t in range(2)
        for shift in np.ndindex(3, 3, 3)
        for reach in [(np.array(shift) - 1) @ CELL + INSIDE[t] - INSIDE[s]]
        if abs(np.linalg.norm(reach) - 1.0) < 1e-9
    ]
