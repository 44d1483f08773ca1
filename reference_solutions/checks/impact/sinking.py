"""A sphere that sinks in a fluid, by an explicit method of order 8 in time: the second route."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def motion(
    times: Array, *, d: float, rho: float, rho_f: float, mu: float, g: float, v0: float
) -> tuple[Array, Array]:
    """Depth [m] and speed [m/s], as in `reference_solutions.impact.sinking`."""
    from scipy.integrate import solve_ivp

    mass, weight = rho * np.pi * d**3 / 6.0, (rho - rho_f) * np.pi * d**3 / 6.0 * g

    def slope(t: float, y: Array) -> Array:
        reynolds = rho_f * abs(y[1]) * d / mu
        coefficient = 24.0 / reynolds * (1.0 + 0.15 * reynolds**0.687) if reynolds else 0.0
        drag = 0.125 * rho_f * np.pi * d**2 * coefficient * y[1] ** 2
        return np.array([y[1], (weight - drag) / mass])

    found = solve_ivp(
        slope, (0.0, float(times[-1])), [0.0, v0], "DOP853", t_eval=times, rtol=1e-13,
        atol=1e-18,
    )  # fmt: skip
    return np.asarray(found.y[0]), np.asarray(found.y[1])
