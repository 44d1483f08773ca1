"""A viscous impact along the normal, by integration in time: the second route.

With u = q^4 and dt = q^3 ds the equations are polynomials, also at the start of the contact.
"""

from collections.abc import Callable
from math import inf, sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Event = Callable[[float, Array], float]


class Impact(NamedTuple):
    """Restitution, largest overlap [m] and force [N], and the ends of force and of overlap [s]."""

    restitution: float
    deepest: float
    largest_force: float
    contact_time: float
    cleared: float


def impact(z: float, *, m: float, K: float, v: float) -> Impact:
    """The result of an impact with speed v; it ends where the force would become tensile."""
    from scipy.integrate import solve_ivp

    D = 2.0 * z * sqrt(1.5 * m * K)

    def force(y: Array) -> float:
        return float(K * y[0] ** 6 + D * y[0] * y[1])

    def slope(s: float, y: Array) -> list[float]:
        q, rate = y[0], y[1]
        return [0.25 * rate, -(K * q**9 + D * q**4 * rate) / m, q**3]

    def ends(s: float, y: Array) -> float:
        if z == 0.0:
            return float(y[0]) if s > 0.0 else 1.0
        return float(K * y[0] ** 5 + D * y[1])  # force divided by q

    def peak(s: float, y: Array) -> float:
        dq, drate, _ = slope(s, y)
        return 6.0 * K * y[0] ** 5 * dq + D * (dq * y[1] + y[0] * drate) if s > 0.0 else 1.0

    def turns(s: float, y: Array) -> float:
        return float(y[1])

    events = _falling(ends, peak, turns)
    size = (1.25 * m * v * v / K) ** 0.1
    found = solve_ivp(
        slope, (0.0, 100.0 * size / v), [0.0, v, 0.0], "DOP853", events=events,
        rtol=1e-13, atol=[1e-15 * size, 1e-15 * v, 1e-16 * size**4 / v],
        max_step=0.1 * size / v,
    )  # fmt: skip
    (end,), (high,), (low,) = (states[:1] for states in found.y_events)
    last = max(float(end[0]), 0.0) ** 4
    speed = float(end[1]) if end[1] < 0.0 else -inf
    return Impact(
        -float(end[1]) / v, float(low[0]) ** 4, force(high), float(end[2]),
        float(end[2]) - last / speed,
    )  # fmt: skip


def _falling(ends: Event, *others: Event) -> tuple[Event, ...]:
    """Events of solve_ivp at decreasing zeros; the first of them ends the integration."""
    ends.terminal = True  # type: ignore[attr-defined]
    for event in (ends, *others):
        event.direction = -1  # type: ignore[attr-defined]
    return ends, *others


def on_a_spring(z: float, *, m: float, kn: float, v: float) -> Impact:
    """The result of the same impact on a linear spring and dashpot, in dimensionless form."""
    from scipy.integrate import solve_ivp

    def slope(t: float, y: Array) -> list[float]:
        return [y[1], -y[0] - 2.0 * z * y[1]]

    def ends(t: float, y: Array) -> float:
        return float(y[0] + 2.0 * z * y[1]) if t > 0.0 else 1.0

    def peak(t: float, y: Array) -> float:
        return float(y[1] + 2.0 * z * slope(t, y)[1])

    def turns(t: float, y: Array) -> float:
        return float(y[1])

    events = _falling(ends, peak, turns)
    found = solve_ivp(
        slope, (0.0, 10.0), [0.0, 1.0], "DOP853", events=events,
        rtol=1e-13, atol=1e-15, max_step=0.05,
    )  # fmt: skip
    last, high, low = (states[:1] for states in found.y_events)
    pushes = [2.0 * z, *(float(y[0] + 2.0 * z * y[1]) for y in high)]
    unit, (left, speed) = sqrt(m / kn), (float(part) for part in last[0])
    over = float(found.t_events[0][0])
    return Impact(
        -speed, float(low[0][0]) * v * unit, max(pushes) * v * sqrt(m * kn), over * unit,
        (over - left / speed) * unit,
    )  # fmt: skip
