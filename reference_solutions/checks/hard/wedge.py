"""A wedge in a groove, from its equations of motion in space: the second route."""

from math import cos, radians, sin

import numpy as np


def acceleration(*, dip: float, xi: float, mu: float, g: float) -> float:
    """The acceleration down the groove [m/s2]; dip [degrees], xi [rad].

    x is horizontal along the groove in plan, y across it, z up. The unknowns are the acceleration
    and the normal forces of both sides, whose friction acts uphill.
    """
    i, h = radians(dip), xi / 2.0
    down = np.array([cos(i), 0.0, -sin(i)])
    out = np.array([sin(i), 0.0, cos(i)])
    across = np.array([0.0, 1.0, 0.0])
    sides = [sign * cos(h) * across + sin(h) * out for sign in (1.0, -1.0)]
    columns = [down, *(mu * down - n for n in sides)]
    found = np.linalg.solve(np.stack(columns, axis=1), np.array([0.0, 0.0, -g]))
    if (found[1:] < 0.0).any():
        raise ValueError(f"pushes {found[1:]} m/s2; sides cannot pull")
    return float(found[0])
