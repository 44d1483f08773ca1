"""A wedge under a sine, by time steps of its equations of motion in space: the second route."""

from math import cos, radians, sin

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


# The case passes its parameters by name, one for one.
def slid(
    t: float, *, dip: float, xi: float, mu: float, A: float, f: float, g: float, level: bool,
    steps: int = 100_000,
) -> float:  # fmt: skip
    """The displacement s [m] down the groove at the time t [s]; its error falls as steps**-2."""
    dt, s, v = t / steps, 0.0, 0.0
    pushed = A * np.sin(2 * np.pi * f * dt * np.arange(steps + 1))
    down, up = (_drives(pushed, dip, xi, side * mu, g, level) for side in (1.0, -1.0))
    for n in range(steps):
        way = np.sign(v) or int(down[n + 1] > 0.0) - int(up[n + 1] < 0.0)
        drive = down if way > 0 else up
        after = v + 0.5 * dt * (drive[n] + drive[n + 1]) if way else 0.0
        after = after if after * way > 0.0 else 0.0
        s, v = s + 0.5 * dt * (v + after), after
    return float(s)


def _drives(pushed: Array, dip: float, xi: float, mu: float, g: float, level: bool) -> Array:
    """The acceleration down the groove (k,) [m/s2] under forces per mass `pushed`, friction uphill.

    x is horizontal along the groove in plan, y across it, z up. The unknowns are the acceleration
    and the normal forces N of both sides, whose friction is mu N.
    """
    i, h = radians(dip), xi / 2.0
    down, out = np.array([cos(i), 0.0, -sin(i)]), np.array([sin(i), 0.0, cos(i)])
    across = np.array([0.0, 1.0, 0.0])
    sides = [sign * cos(h) * across + sin(h) * out for sign in (1.0, -1.0)]
    columns = np.stack([down, *(mu * down - n for n in sides)], axis=1)
    push = np.array([1.0, 0.0, 0.0]) if level else down
    forces = pushed[:, None] * push - g * np.array([0.0, 0.0, 1.0])
    return np.asarray(np.linalg.solve(columns, forces.T)[0])
