"""A wedge that slides in a symmetric groove under gravity and a sine, along it or horizontal.

The sides of the groove enclose the angle xi, and it dips by i; the normal forces of both sides add
up to K = 1/sin(xi/2) times that of one plane (see `wedge`). With the force per mass a = A sin(2 pi
f t),

along the groove   s'' = g (sin i - K mu cos i) + a                     as it slides down,
level              s'' = g sin i + a cos i - K mu (g cos i - a sin i)   likewise,

with the opposite sign of K as it slides up; it is at rest while friction can hold it. Under the
level (horizontal) sine it moves like a block on an incline with the coefficient of friction K mu.
The text of Yagoda-Biran and Hatzor (2016, Sec. 4.4) states a sine along the groove; their Fig. 16
has a level one. Every function raises ValueError for a parameter out of range.
"""

from math import atan, cos, degrees, pi, radians, sin

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reference_solutions.blocks import harmonic_slip, incline
from reference_solutions.blocks.harmonic_slip import Drive, Law
from reference_solutions.hard.wedge import pressing
from reference_solutions.parameters import (
    require_acute,
    require_at_least_0,
    require_positive,
    require_times,
)

Array = NDArray[np.float64]


def along(t: ArrayLike, *, dip: float, xi: float, mu: float, A: float, f: float, g: float) -> Array:
    """The displacement s [m] down the groove at times t >= 0 [s] from rest, sine along it."""
    t = require_times(t)
    require_acute(dip=dip)
    require_at_least_0("in SI units", mu=mu, A=A)
    require_positive("in SI units", f=f, g=g)
    i, held = radians(dip), pressing(xi) * mu
    down, up = (g * (sin(i) + side * held * cos(i)) for side in (-1.0, 1.0))
    drive = Drive(2.0 * pi * f, 0.0, Law(down, A), Law(up, A))
    phases = harmonic_slip.phases(drive, 0.0, float(t.max(initial=0.0)))
    return harmonic_slip.displacement(t, drive, phases)


def level(t: ArrayLike, *, dip: float, xi: float, mu: float, A: float, f: float, g: float) -> Array:
    """The displacement s [m] down the groove at times t >= 0 [s] from rest, horizontal sine."""
    require_at_least_0("", mu=mu)
    phi = degrees(atan(pressing(xi) * mu))
    return incline.newmark(t, alpha=dip, phi=phi, A=A, f=f, g=g, v0=0.0)
