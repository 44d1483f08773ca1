"""A sphere of mass m on contact springs kn, ks that slides down a groove, in closed form.

The two sides of the groove enclose the angle xi. At first the sphere overlaps each side by N/kn, N
= W cos(i)/(2 sin(xi/2)), so that it does not sink. The shear springs are unloaded at first, and the
sphere oscillates on both, m s'' = m g sin(i) - 2 ks s, until the force of each is mu N. From then
on the friction is constant. Raises ValueError for parameters outside their ranges.
"""

from math import cos, radians, sin

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reference_solutions.hard.wedge import pressing
from reference_solutions.parameters import require_at_least_0, require_positive, require_times

Array = NDArray[np.float64]


def slid(t: ArrayLike, *, dip: float, xi: float, mu: float, g: float, m: float, ks: float) -> Array:
    """Displacement down the groove [m] at times t >= 0 [s] from rest; dip i [degrees]."""
    require_positive("in SI units", g=g, m=m, ks=ks)
    require_at_least_0("", mu=mu, dip=dip)
    at, i = require_times(t), radians(dip)
    pull, held = g * sin(i), pressing(xi) * mu * g * cos(i)  # per mass, of both sides together
    w = np.sqrt(2.0 * ks / m)
    swung = pull / w**2 * (1.0 - np.cos(w * at))
    if held >= 2.0 * pull:
        return np.asarray(swung)
    if held >= pull:
        raise ValueError(f"mu = {mu}; it slips and stops, for which there is no closed form here")
    slips = np.arccos(1.0 - held / pull) / w
    since = at - slips
    speed = pull / w * np.sin(w * slips)
    gone = held / w**2 + speed * since + (pull - held) * since**2 / 2.0
    return np.asarray(np.where(since < 0, swung, gone))
