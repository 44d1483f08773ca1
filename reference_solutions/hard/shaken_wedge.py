"""A wedge in a symmetric groove under gravity and a sine, along the groove or level.

Its sides open by xi and fall by the dip i; friction acts on K = 1/sin(xi/2) times what one plane
would bear (see `wedge`). With a = A sin(2 pi f t) per mass,

along the groove   s'' = g (sin i - K mu cos i) + a                     as it slides down,
level              s'' = g sin i + a cos i - K mu (g cos i - a sin i)   likewise,

K with the other sign as it slides up, and at rest while friction can hold it: level, it moves like
a block on an incline whose tangent of friction is K mu (Yagoda-Biran and Hatzor 2016, Sec. 4.4,
says along the groove; its Fig. 16 is level).
Every function raises ValueError for a parameter out of range.
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
    """s [m] down the groove at times t >= 0 [s] from rest, under a sine along it."""
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
    """s [m] down the groove at times t >= 0 [s] from rest, under a level sine across its strike."""
    require_at_least_0("", mu=mu)
    phi = degrees(atan(pressing(xi) * mu))
    return incline.newmark(t, alpha=dip, phi=phi, A=A, f=f, g=g, v0=0.0)
