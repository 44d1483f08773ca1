"""Two bodies that collide at a point, by a linear system of all velocities: the second route.

The equations are the changes of momentum and angular momentum of both bodies by the impulse, and a
zero normal velocity at the contact after it. Parameters are those of
`reference_solutions.hard.spin_stopped`, whose code is not used here.
"""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def after(
    arms: Array, inertias: Array, n: Array, spins: Array, *, m1: float, m2: float, V: float
) -> Array:
    """The velocities of the first and the second body and their spins (12,) after the impact."""
    apart = np.concatenate([-n, n, -np.cross(arms[0], n), np.cross(arms[1], n)])
    mass = np.zeros((12, 12))
    mass[:3, :3], mass[3:6, 3:6] = m1 * np.eye(3), m2 * np.eye(3)
    mass[6:9, 6:9], mass[9:, 9:] = inertias
    before = np.concatenate([0 * n, -V * n, *spins])
    system = np.block([[mass, -apart[:, None]], [apart[None], np.zeros((1, 1))]])
    found = np.linalg.solve(system, np.append(mass @ before, 0.0))
    return np.asarray(found[:-1], dtype=np.float64)
