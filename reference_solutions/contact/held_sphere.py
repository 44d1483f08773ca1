"""A sphere between two vertical walls whose friction alone bears its weight, in closed form.

The shear springs ks of both contacts are unloaded at first. The sphere sinks and oscillates on
them, m z'' = -m g - 2 ks z, as long as the force of each spring is at most mu N. Its peak in the
oscillation is m g. If mu N is less, the sphere slides under the constant friction 2 mu N: without
end if 2 mu N is at most the weight, otherwise until it stops and oscillates about a new position.
By symmetry it does not rotate.
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
    slips = np.arccos(1 - 2 * most / (m * g)) / w  # time at which the spring forces reach mu N
    gone, speed = -most / ks, -m * g / (2 * ks) * w * np.sin(w * slips)
    slowed = 2 * most / m - g  # upward acceleration while it slides down
    since = t - slips
    slid = gone + speed * since + slowed * since**2 / 2
    if slowed <= 0:
        return np.asarray(np.where(since < 0, swung, slid))
    stops = -speed / slowed
    lowest, rests = gone + speed * stops / 2, (most - m * g / 2) / ks  # rests: equilibrium above it
    again = lowest + rests * (1 - np.cos(w * (since - stops)))
    return np.asarray(np.where(since < 0, swung, np.where(since < stops, slid, again)))
