"""A body that skids over a spring, by numerical integration: the second route.

The force of the shear spring is part of the state. It follows the motion and is limited to mu kn
times the overlap after every step of an explicit midpoint method, so that nothing is assumed about
where the contact slips. Parameters are those of `reference_solutions.contact.skid`, whose code is
not used here.
"""

from math import pi, sqrt

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def contact(
    *, m: float, kn: float, ks: float, mu: float, vn: float, vt: float, steps: int
) -> tuple[Array, Array]:
    """Times (steps + 1,) [s] up to pi/w, and displacement and velocity (steps + 1, 4) at them.

    Columns: normal and tangential displacement [m], normal and tangential velocity [m/s].
    """
    dt = pi / sqrt(kn / m) / steps
    deep, into, way, along, shear = 0.0, vn, 0.0, vt, 0.0
    rows = [(0.0, 0.0, -vn, vt)]
    for _ in range(steps):
        middle = deep + 0.5 * dt * into
        cap = mu * kn * max(middle, 0.0)
        shear = min(max(shear + ks * along * dt, -cap), cap)
        way += dt * along - 0.5 * dt**2 * shear / m
        along -= dt * shear / m
        slowed = into - dt * kn * middle / m
        deep += 0.5 * dt * (into + slowed)
        into = slowed
        rows.append((-deep, way, -into, along))
    return np.linspace(0.0, dt * steps, steps + 1), np.array(rows, np.float64)
