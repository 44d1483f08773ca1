"""Spheres dropped, pressed and set down sliding, by integration between events: second routes.

The parameters are those of `dropped`, `pressed_pair` and `slip_to_roll` in
`reference_solutions.impact`, whose code is not used here.
"""

from collections.abc import Callable
from math import copysign, sqrt

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Slope = Callable[[float, Array], list[float]]
Event = Callable[[float, Array], float]


def _until(
    slope: Slope, start: list[float], time: float, event: Event, sizes: list[float]
) -> Array:
    """The time and state at an event, or at `time` [s] from the start if none occurs."""
    from scipy.integrate import solve_ivp

    event.terminal, event.direction = True, -1  # type: ignore[attr-defined]
    found = solve_ivp(
        slope, (0.0, time), start, "DOP853", events=event, rtol=1e-13,
        atol=[1e-14 * size for size in sizes],
    )  # fmt: skip
    return np.array([found.t[-1], *found.y[:, -1]])


def tops(
    height: float, bounces: int, *, m: float, kn: float, z: float, g: float, pulls: bool
) -> list[float]:
    """The greatest height [m] after each bounce of a dropped sphere."""
    c, seen = 2.0 * z * sqrt(kn * m), []
    for _ in range(bounces):
        speed = -sqrt(2.0 * g * height)

        def slope(t: float, y: Array) -> list[float]:
            return [y[1], -g - (kn * y[0] + c * y[1]) / m]

        def ends(t: float, y: Array) -> float:
            if t == 0.0:
                return 1.0
            return float(-y[0] if pulls else -(kn * y[0] + c * y[1]))

        size = -speed * sqrt(m / kn)
        _, left, rate = _until(slope, [0.0, speed], 6.0 * sqrt(m / kn), ends, [size, -speed])
        height = float(left + rate**2 / (2.0 * g))
        seen.append(height)
    return seen


def pressed(
    t: float, start: tuple[float, float], *, masses: tuple[float, float], k: float,
    R: float, H: float, g: float,
) -> Array:  # fmt: skip
    """y1 and y2 [m] of two pressed spheres, by the matrix exponential of the system."""
    from scipy.linalg import expm

    first, second = masses
    system = np.zeros((5, 5))
    system[0, 2] = system[1, 3] = 1.0
    system[2] = [-2.0 * k / first, k / first, 0.0, 0.0, -g - k * R / first]
    system[3] = [k / second, -2.0 * k / second, 0.0, 0.0, -g + k * (R + H) / second]
    return np.asarray((expm(system * t) @ [*start, 0.0, 0.0, 1.0])[:2])


def sliding(
    t: float, *, m: float, ks: float, mu: float, g: float, v0: float, q: float
) -> tuple[float, float]:
    """v [m/s] at t [s] of a sphere set down sliding, and the time at which it began to roll [s]."""
    cap, past = mu * m * g, 0.0
    y, rolls, slips = [v0, v0, 0.0], 0.0, False
    for _ in range(3):

        def slope(_: float, y: Array, slips: bool = slips) -> list[float]:
            force = copysign(cap, float(y[2])) if slips else float(y[2])
            return [q * force / m, force / m, 0.0 if slips else -ks * float(y[0])]

        def changes(when: float, y: Array, slips: bool = slips) -> float:
            return float(y[0]) if slips else cap * (1.0 + 1e-15) - abs(float(y[2]))

        step = _until(slope, y, t - past, changes, [v0, v0, cap])
        past, y = past + float(step[0]), [float(part) for part in step[1:]]
        if past >= t:
            break
        slips, rolls = not slips, past if slips else rolls
        if rolls:
            y[0] = 0.0
            swing = _swing(y, t - past, m=m, ks=ks, q=q)
            return swing, rolls
    return y[1], rolls


def _swing(y: list[float], t: float, *, m: float, ks: float, q: float) -> float:
    """v after t [s] on the shear spring, by the matrix exponential of the system."""
    from scipy.linalg import expm

    system = np.array([[0.0, 0.0, q / m], [0.0, 0.0, 1.0 / m], [-ks, 0.0, 0.0]])
    return float((expm(system * t) @ y)[1])
