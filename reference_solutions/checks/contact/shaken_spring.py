"""A damped mass on a spring under sinusoidal drives, by numerical integration: the second route."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Sine = tuple[float, float, float]  # amplitude, omega [rad/s], phase [rad]


def displacement(
    t: Array,
    *,
    m: float,
    k: float,
    c: float,
    v: float,
    force: float = 0.0,
    shaking: Sequence[Sine] = (),
    base: Sequence[Sine] = (),
) -> Array:
    """The displacement q [m] at rising times t >= 0 (n,) [s]; see the first route."""
    from scipy.integrate import solve_ivp

    def rates(now: float, state: Array) -> list[float]:
        q, speed = state
        end = sum(a * (np.sin(w * now + phi) - np.sin(phi)) for a, w, phi in base)
        shaken = sum(a * np.sin(w * now + phi) for a, w, phi in shaking)
        return [speed, (force - c * speed - k * (q - end)) / m + shaken]

    found = solve_ivp(
        rates, (0.0, float(t[-1])), [0.0, v], "DOP853", t, rtol=1e-13, atol=1e-16 * abs(v)
    )
    return np.asarray(found.y[0], dtype=np.float64)
