"""A body that skids over a spring, by numerical integration: the second route.

The shear spring is a state of its own, charged by the motion and cut to mu kn times the overlap
after every short step of an explicit midpoint method, which so finds by itself where it slips;
parameters are those of `reference_solutions.contact.skid`, whose code is not used here.
"""

from math import pi, sqrt

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def contact(
    *, m: float, kn: float, ks: float, mu: float, vn: float, vt: float, steps: int
) -> tuple[Array, Array]:
    """Times (steps + 1,) up to pi/w; there (steps + 1, 4) place and velocity, across and along."""
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
