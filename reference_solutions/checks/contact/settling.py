"""A sphere that drag brings to rest on a floor, by numerical integration: the second route.

An explicit Runge-Kutta method of order 8 is used from event to event. Parameters are those of the
first route, whose code is not used here. A flight shorter than a step, a fifth of sqrt(m/kn), can
be missed.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


def settling(
    t: ArrayLike, *, m: float, kn: float, eta: float, g: float, height: float
) -> tuple[Array, int]:
    """The upward displacement [m] at increasing times t (n,) [s], and the number of bounces."""
    from scipy.integrate import solve_ivp

    t = np.asarray(t, dtype=np.float64)
    moved, now, z, left = np.full(t.shape, np.nan), 0.0, np.array([height, 0.0]), 0
    flies = True
    size = np.array([g * m / kn, g * (m / kn) ** 0.5])

    def rate(_: float, y: Array, spring: float) -> Array:
        return np.array([y[1], -g - (eta * y[1] + spring * y[0]) / m])

    while True:

        def crossed(_: float, y: Array, spring: float) -> float:
            return float(y[0])

        crossed.terminal, crossed.direction = True, -1 if flies else 1  # type: ignore[attr-defined]
        end = float(t[-1])
        found = solve_ivp(
            rate, (now, end), z, "DOP853", dense_output=True, events=crossed,
            args=(0.0 if flies else kn,), rtol=1e-13, atol=1e-13 * size,
            max_step=0.2 * (m / kn) ** 0.5,
        )  # fmt: skip
        here = (now <= t) & (t <= found.t[-1])
        if here.any():
            moved[here] = found.sol(t[here])[0] - height
        if found.status != 1:
            return moved, left
        now, z = float(found.t[-1]), np.array([0.0, found.y[1, -1]])
        left += not flies
        flies = not flies
