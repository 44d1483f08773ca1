"""A spring and a dashpot that cannot pull, by numerical integration: the second route.

An explicit Runge-Kutta method of order 8 is used up to the event at which the force falls to zero.
Parameters are those of `reference_solutions.contact.dashpot`, whose code is not used here.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


def collision(
    t: ArrayLike, *, m: float, kn: float, z: float, v: float
) -> tuple[Array, float, float]:
    """Overlap [m] at increasing times t (n,) [s], restitution, and duration of the contact [s]."""
    from scipy.integrate import solve_ivp

    t = np.asarray(t, dtype=np.float64)
    c, unit = 2.0 * z * (kn * m) ** 0.5, (m / kn) ** 0.5

    def push(_: float, y: Array) -> float:
        return float(kn * y[0] + c * y[1])

    def rate(at: float, y: Array) -> Array:
        return np.array([y[1], -push(at, y) / m])

    push.terminal, push.direction = True, -1  # type: ignore[attr-defined]
    found = solve_ivp(
        rate, (0.0, 4.0 * unit), np.array([0.0, v]), "DOP853", dense_output=True, events=push,
        rtol=1e-13, atol=1e-13 * np.array([v * unit, v]), max_step=0.05 * unit,
    )  # fmt: skip
    end, (last, speed) = float(found.t[-1]), found.y[:, -1]
    pressed = found.sol(np.minimum(t, end))[0]
    return np.where(t <= end, pressed, last + speed * (t - end)), float(-speed / v), end
