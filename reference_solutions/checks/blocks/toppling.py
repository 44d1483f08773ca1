"""A body that topples about a fixed line, by numerical integration: the second route.

The equation of motion is integrated by an explicit Runge-Kutta method of order 8; parameters are
those of the first route, whose code is not used here.
"""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def angle(t: Array, *, theta0: float, lam: float) -> Array:
    """theta [rad] at increasing times t (n,) [s] from 0."""
    from scipy.integrate import solve_ivp

    def rates(_: float, state: Array) -> list[float]:
        return [state[1], lam**2 * np.sin(state[0])]

    found = solve_ivp(rates, (0.0, t[-1]), [theta0, 0.0], "DOP853", t, rtol=1e-13, atol=1e-15)
    return np.asarray(found.y[0], dtype=np.float64)
