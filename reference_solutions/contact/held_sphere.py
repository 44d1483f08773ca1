"""A sphere between two vertical walls whose friction alone carries its weight: closed form.

The shear springs ks of both contacts start slack. The sphere sinks and oscillates on them, m z'' =
-m g - 2 ks z, while each bears at most mu N. If that is less than m g, the peak of the oscillation,
the sphere slides under the constant friction 2 mu N: for ever if that is less than the weight,
otherwise until it stops, from where it oscillates. By symmetry it does not rotate.
"""

import numpy as np
from numpy.typing import NDArray

from reference_solutions.parameters import require_positive

Array = NDArray[np.float64]


def height(t: Array, *, m: float, ks: float, mu: float, pressed: float, g: float) -> Array:
    """Displacement upwards [m] at times t [s]; pressed: the normal force N of each wall [N].

    Raises ValueError for a mass, stiffness or weight that is not positive.
    """
    require_positive("in SI units", m=m, ks=ks, g=g)
    w, most = np.sqrt(2 * ks / m), mu * pressed
    swung = -m * g / (2 * ks) * (1 - np.cos(w * t))
    if most >= m * g:
        return np.asarray(swung)
    slips = np.arccos(1 - 2 * most / (m * g)) / w  # when a spring first bears mu N
    gone, speed = -most / ks, -m * g / (2 * ks) * w * np.sin(w * slips)
    slowed = 2 * most / m - g  # upwards, of what slides down
    since = t - slips
    slid = gone + speed * since + slowed * since**2 / 2
    if slowed <= 0:
        return np.asarray(np.where(since < 0, swung, slid))
    stops = -speed / slowed
    lowest, rests = gone + speed * stops / 2, (most - m * g / 2) / ks  # above the lowest
    again = lowest + rests * (1 - np.cos(w * (since - stops)))
    return np.asarray(np.where(since < 0, swung, np.where(since < stops, slid, again)))
