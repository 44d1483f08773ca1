"""Two spinning bodies whose impact takes all their spin, in closed form.

Bodies of masses m1, m2 [kg] meet without friction and restitution; the second comes at V [m/s]
along -n. With P = V/(1/m1 + 1/m2) and spins w1 = P I1^-1 (r1 x n), w2 = -P I2^-1 (r2 x n) before,
r the arms from their centres to the point of contact [m], the impulse P along n takes their spins
and leaves one velocity to both: they go on together. Every function raises ValueError for
parameters outside their ranges.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reference_solutions.parameters import require_positive

Array = NDArray[np.float64]


def impulse(*, m1: float, m2: float, V: float) -> float:
    """P [N s]."""
    require_positive("in SI units", m1=m1, m2=m2, V=V)
    return V / (1.0 / m1 + 1.0 / m2)


def spins(
    arms: ArrayLike, inertias: ArrayLike, n: ArrayLike, *, m1: float, m2: float, V: float
) -> Array:
    """The spins [1/s] before, (2, 3): arms (2, 3) [m], inertias (2, 3, 3) [kg m2], n (3,)."""
    turning = np.cross(np.asarray(arms), np.asarray(n)) * impulse(m1=m1, m2=m2, V=V)
    first, second = np.linalg.solve(np.asarray(inertias), turning[..., None])[..., 0]
    return np.stack([first, -second])


def together(*, m1: float, m2: float, V: float) -> float:
    """The velocity [m/s] of both after the impact, along n."""
    return -impulse(m1=m1, m2=m2, V=V) / m1
