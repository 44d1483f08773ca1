"""Second route to units that separate: virtual work of normal forces and friction until the end.

Normal forces have the potential V = 3 kn (d - L)^2/2, and friction dissipates 3 mu N L da at the
slip L da, with the angle a of a contact with the axis. The forces on a base element are derivatives
of this work by the radius, taken as finite differences. The end of contact is located as an event.
"""

from math import atan2, cos, hypot, sin

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
SMALL = 1e-6  # finite difference of the radius, over a diameter


def separation_rates(
    *, kn: float, mu_p: float, d: float, m: float, eta: float, begin: tuple[float, float],
    fall: float, longest: float,
) -> tuple[float, float] | None:  # fmt: skip
    """The rates [m/s] at which contacts open and slide as they end; None if they do not end.

    begin: length [m] and angle [rad] of a contact as it starts to slide, from rest; fall: speed of
    the top [m/s]; longest: the time [s] within which contacts must end.
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
