"""A wedge that slides down a symmetric groove with friction on both sides, in closed form.

The sides enclose the angle xi, and the groove dips by i. The normal force of each side is N = W
cos(i)/(2 sin(xi/2)), so that the displacement follows s'' = g (sin i - K mu cos i),
K = 1/sin(xi/2) (Goodman and Shi 1985, Block theory, ch. 9; Yagoda-Biran and Hatzor 2016, Sec. 4.2).
Every function raises ValueError for parameters outside their ranges.
"""

from math import cos, pi, radians, sin

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reference_solutions.parameters import require_at_least_0, require_positive, require_times

Array = NDArray[np.float64]


def pressing(xi: float) -> float:
    """K, the normal forces of both sides over that of one plane; xi: angle [rad], at most pi."""
    require_positive("rad", xi=xi)
    if xi > pi:
        raise ValueError(f"xi = {xi} rad; a groove opens by at most pi")
    return 1.0 / sin(xi / 2.0)


def slid(t: ArrayLike, *, dip: float, xi: float, mu: float, g: float) -> Array:
    """Displacement down the groove [m] at times t >= 0 [s] from rest; dip i [degrees]."""
    require_positive("m/s2", g=g)
    require_at_least_0("", mu=mu, dip=dip)
    drive = sin(radians(dip)) - pressing(xi) * mu * cos(radians(dip))
    return np.asarray(max(drive, 0.0) * g * require_times(t) ** 2 / 2.0)
