"""A body that topples from rest about a fixed line below its centre, in closed form.

The body is an inverted pendulum: theta'' = lam^2 sin(theta), lam^2 = m g h/I, with theta [rad] from
the upright position, the distance h [m] from the line to the centre and the moment of inertia
I [kg m2] about the line. From rest at theta0 it follows

sin(theta/2) = sin(theta0/2)/dn(lam t), with the modulus k = cos(theta0/2)

(Jacobi; the pendulum's sin(phi/2) = k cd(lam t) with phi = pi - theta). Every function raises
ValueError for parameters outside their ranges.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reference_solutions.parameters import require_positive, require_times

Array = NDArray[np.float64]


def angle(t: ArrayLike, *, theta0: float, lam: float) -> Array:
    """theta [rad] at times t >= 0 [s] of any shape, until the body hangs down; lam [rad/s]."""
    from scipy.special import ellipj, ellipkm1

    t = require_times(t)
    require_positive("in SI units", theta0=theta0, lam=lam)
    last, hangs = float(t.max(initial=0.0)), float(ellipkm1(np.sin(theta0 / 2.0) ** 2)) / lam
    if not last < hangs:
        raise ValueError(f"t = {last} s; from {hangs:.6g} s on the body hangs below its line")
    _, _, delta, _ = ellipj(lam * t, np.cos(theta0 / 2.0) ** 2)
    return np.asarray(2.0 * np.arcsin(np.sin(theta0 / 2.0) / delta))
