"""The largest stable step of a leapfrog by bisection on its spectral radius: the second route.

The eigenvalues of the matrix of a step on (x, v dt) are found numerically.
"""

import numpy as np


def radius(w: float, n: float, lag: float, dt: float) -> float:
    """The spectral radius of a step; w, n [1/s]; lag: the fraction of the drag due to v-."""
    kept, held = 1.0 - 2.0 * n * dt * lag, 1.0 + 2.0 * n * dt * (1.0 - lag)
    pulled = (w * dt) ** 2
    pushed, driven = -pulled / held, kept / held  # v+ dt by x and v- dt
    step = np.array([[pushed + 1.0, driven], [pushed, driven]])
    return float(np.abs(np.linalg.eigvals(step)).max())


def largest_step(w: float, n: float, lag: float) -> float:
    """The step [s] below which the radius is at most 1, to rounding."""
    low, high = 0.0, 4.0 / w
    for _ in range(60):
        middle = (low + high) / 2.0
        stable = radius(w, n, lag, middle) <= 1.0 + 1e-12
        low, high = (middle, high) if stable else (low, middle)
    return low
