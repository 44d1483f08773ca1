"""A block that slips one way along a shaken wall, by numerical integration: the second route.

The equation of motion as it stands, by an explicit Runge-Kutta method of order 8; parameters are
those of `reference_solutions.laden_block`, whose code is not used here.
"""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Sine = tuple[float, float, float]  # amplitude, omega [rad/s], phase [rad]


def motion(
    t: Array,
    *,
    v: float,
    mu: float,
    constant: tuple[float, float],
    shaking: tuple[Sine, Sine],
    lifting: Sine,
) -> tuple[Array, Array]:
    """Displacement [m] and velocity [m/s] along the slip at increasing times t (n,) [s] from 0."""
    from scipy.integrate import solve_ivp

    def rates(now: float, state: Array) -> list[float]:
        pushes = [a * np.sin(w * now + phi) for a, w, phi in shaking]
        size, omega, phase = lifting
        press = -(omega**2) * size * np.sin(omega * now + phase) - constant[1] - pushes[1]
        return [state[1], constant[0] + pushes[0] - mu * press]

    found = solve_ivp(rates, (0.0, t[-1]), [0.0, v], "DOP853", t, rtol=1e-13, atol=1e-15)
    return found.y[0], found.y[1]
