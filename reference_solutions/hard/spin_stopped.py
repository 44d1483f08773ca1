"""Two spinning bodies whose impact stops both spins, in closed form.

Bodies of masses m1, m2 [kg] collide without friction and restitution; the first centre is at rest,
and the second moves at V [m/s] along -n. With P = V/(1/m1 + 1/m2) and the spins w1 = P I1^-1 (r1 x
n), w2 = -P I2^-1 (r2 x n) before, r1 and r2 the arms [m] from the centres to the point of contact,
the impulse P along n stops the spins and gives both bodies the same velocity. Every function raises
ValueError for parameters outside their ranges.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reference_solutions.parameters import require_positive

Array = NDArray[np.float64]


def impulse(*, m1: float, m2: float, V: float) -> float:
    """The impulse P [N s]."""
    require_positive("in SI units", m1=m1, m2=m2, V=V)
    return V / (1.0 / m1 + 1.0 / m2)


def spins(
    arms: ArrayLike, inertias: ArrayLike, n: ArrayLike, *, m1: float, m2: float, V: float
) -> Array:
    """The spins before (2, 3) [1/s]; arms (2, 3) [m], inertias (2, 3, 3) [kg m2], n (3,)."""
    turning = np.cross(np.asarray(arms), np.asarray(n)) * impulse(m1=m1, m2=m2, V=V)
    first, second = np.linalg.solve(np.asarray(inertias), turning[..., None])[..., 0]
    return np.stack([first, -second])


def together(*, m1: float, m2: float, V: float) -> float:
    """The velocity [m/s] of both bodies along n after the impact."""
    return -impulse(m1=m1, m2=m2, V=V) / m1
