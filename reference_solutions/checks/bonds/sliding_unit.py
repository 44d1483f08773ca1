"""Second route to units that part: virtual work of the push and of friction, and a located end.

The push does the work of its potential V = 3 kn (d - L)^2/2, friction takes 3 mu N for each length
L da of slip, a being the angle of a contact with the axis; forces on a base are their derivatives
by its radius, taken as differences.
"""

from math import atan2, cos, hypot, sin

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
SMALL = 1e-6  # of a diameter: a difference


def separation_rates(
    *, kn: float, mu_p: float, d: float, m: float, eta: float, begin: tuple[float, float],
    fall: float, longest: float,
) -> tuple[float, float] | None:  # fmt: skip
    """The rates [m/s] at which contacts open and slide as they end; None if they have not by then.

    begin: length [m] and angle [rad] of a contact as it starts to slide, at rest; fall: speed of
    the top [m/s]; longest: time [s].
    """
    from scipy.integrate import solve_ivp

    length, angle = begin
    height, e = length * cos(angle), SMALL * d

    def pushed(r: float, z: float) -> float:
        held = [0.5 * kn * max(0.0, d - hypot(x, z)) ** 2 for x in (r - e, r + e)]
        slips = hypot(r, z) * (atan2(r + e, z) - atan2(r - e, z))
        rubbed = mu_p * kn * max(0.0, d - hypot(r, z)) * slips
        return (held[0] - held[1] - rubbed) / (2.0 * e)

    def rates(t: float, state: Array) -> list[float]:
        r, v = state
        return [v, (pushed(r, height - fall * t) - eta * v) / m]

    def ends(t: float, state: Array) -> float:
        return float(hypot(state[0], height - fall * t) - d)

    ends.terminal = True  # type: ignore[attr-defined]
    start = [length * sin(angle), 0.0]
    path = solve_ivp(rates, (0.0, longest), start, "LSODA", events=ends, rtol=1e-10, atol=1e-14 * d)
    if not len(path.t_events[0]):
        return None
    (r, v), z = path.y_events[0][0], height - fall * path.t_events[0][0]
    return (r * v - z * fall) / hypot(r, z), (z * v + r * fall) / hypot(r, z)
