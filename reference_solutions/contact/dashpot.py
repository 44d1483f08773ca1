"""A body that hits a spring and a dashpot, which cannot pull, in closed form.

m u'' = -(kn u + c u') from u = 0, u' = v at t = 0 as long as the force is repulsive; u [m] is the
overlap, and z = c/(2 sqrt(kn m)) lies in [0, 1). The force falls to zero at tc = (pi - 2 asin
z)/wd, wd = w sqrt(1 - z^2), w = sqrt(kn/m), while the overlap is still positive; from then on the
body is free (Schwager and Poeschel 2007, Granular Matter 9, 465-469). Every function raises
ValueError for parameters outside their ranges.
"""

from math import asin, exp, pi, sqrt

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reference_solutions.parameters import require_positive, require_times

Array = NDArray[np.float64]


def restitution(z: float) -> float:
    """The speed after the contact over that before, exp(-z (pi - 2 asin z)/sqrt(1 - z^2))."""
    return exp(-z * _phase(z) / sqrt(1.0 - z * z))


def contact_time(*, m: float, kn: float, z: float) -> float:
    """The time tc [s] for which the contact force acts."""
    require_positive("in SI units", m=m, kn=kn)
    return _phase(z) / sqrt(kn / m * (1.0 - z * z))


def overlap(t: ArrayLike, *, m: float, kn: float, z: float, v: float) -> Array:
    """The overlap u [m] at times t >= 0 [s] of any shape; it is negative after separation."""
    require_positive("m/s", v=v)
    t, end = require_times(t), contact_time(m=m, kn=kn, z=z)
    w = sqrt(kn / m)
    wd, pressed = w * sqrt(1.0 - z * z), np.minimum(t, end)
    pushed = v / wd * np.exp(-z * w * pressed) * np.sin(wd * pressed)
    return pushed - restitution(z) * v * (t - pressed)


def _phase(z: float) -> float:
    """The phase wd tc [rad] at which the force ends."""
    if not 0.0 <= z < 1.0:
        raise ValueError(f"z = {z}; it must lie in [0, 1)")
    return pi - 2.0 * asin(z)
