"""The fastest mode of equal elements that cannot rotate, on bonds with kn along and ks across them.

An explicit scheme is stable for steps up to 2/w. Every function raises ValueError for parameters
outside their ranges.
"""

from math import sqrt

import numpy as np
from numpy.typing import NDArray

from reference_solutions.parameters import require_at_least_0, require_positive

LATTICE = 8.98102
"""m w^2/kn of the fastest wave in an infinite hexagonal close packing, at ks/kn = 5/29.

A finite block lacks bonds at its faces, and removing springs makes no mode faster.
"""


def fastest_mode(
    position: NDArray[np.float64], bonds: NDArray[np.int64], kn: float, ks: float, m: float
) -> float:
    """The highest w [1/s] of masses m [kg] at positions (N, 3) on bonds (B, 2), to first order."""
    require_positive("N/m", kn=kn)
    require_at_least_0("N/m", ks=ks)
    require_positive("kg", m=m)
    i, j = bonds.T
    n = position[j] - position[i]
    n = n / np.linalg.norm(n, axis=1)[:, None]
    spring = (kn - ks) * n[:, :, None] * n[:, None, :] + ks * np.eye(3)
    whole = np.zeros((len(position), len(position), 3, 3))
    for k, (a, b) in enumerate(bonds):
        whole[[a, b], [a, b]] += spring[k]
        whole[[a, b], [b, a]] -= spring[k]
    square = whole.transpose(0, 2, 1, 3).reshape(3 * len(position), 3 * len(position)) / m
    return sqrt(float(np.linalg.eigvalsh(square)[-1]))
