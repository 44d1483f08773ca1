"""A body that cannot rotate slides over a spring contact and leaves it, in closed form.

It meets the contact at t = 0 with vn [m/s] towards the spring kn [N/m] and vt along the surface,
whose friction is mu. The shear spring ks is at the friction limit all the time: at first because
ks vt > mu kn vn, and up to the end. Until tc = pi/w, w = sqrt(kn/m), the overlap is vn/w sin(wt)
and the friction mu kn times that, so that the velocity along the surface is vt - mu vn (1 - cos
wt). The body leaves with -vn and vt - 2 mu vn (Coulomb: the tangential impulse is mu times the
normal one; Walton 1993). Every function raises ValueError for parameters outside their ranges.
"""

from math import pi, sqrt

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reference_solutions.parameters import require_positive, require_times

Array = NDArray[np.float64]


def motion(
    t: ArrayLike, *, m: float, kn: float, ks: float, mu: float, vn: float, vt: float
) -> tuple[Array, Array]:
    """Displacement [m] and velocity [m/s] (k, 2), normal and tangential, at times t (k,) [s]."""
    t = require_times(t)
    require_positive("in SI units", m=m, kn=kn, ks=ks, mu=mu, vn=vn, vt=vt)
    stretch = mu * kn / ks * vn  # rate of the friction limit over ks, at the start and the end
    if not (vt > stretch and vt + stretch > 2.0 * mu * vn):
        raise ValueError(f"vt = {vt} m/s; beside mu vn = {mu * vn:.6g} m/s the body would stick")
    w = sqrt(kn / m)
    touching, free = np.minimum(t, pi / w), np.maximum(t - pi / w, 0.0)
    sine, cosine = np.sin(w * touching) / w, np.cos(w * touching)
    across, along = -vn * cosine, vt - mu * vn * (1.0 - cosine)
    place = np.stack([-vn * sine, vt * touching - mu * vn * (touching - sine)], axis=1)
    speed = np.stack([across, along], axis=1)
    return place + free[:, None] * speed, speed
