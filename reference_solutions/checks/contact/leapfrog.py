"""A leapfrog's phase and energy from the matrix of its step: the second route."""

import numpy as np
from numpy.typing import NDArray


def _step(angle: float) -> NDArray[np.float64]:
    """The matrix of a step on (x, v-), in units of time 1/w; v- is half a step before x."""
    kick = np.array([[1.0, 0.0], [-angle, 1.0]])
    drift = np.array([[1.0, angle], [0.0, 1.0]])
    return np.asarray(drift @ kick)


def phase_per_step(angle: float) -> float:
    """The argument [rad] of the eigenvalues of a step; angle = w dt [rad]."""
    return float(np.abs(np.angle(np.linalg.eigvals(_step(angle)))).max())


def stiffness(angle: float) -> float:
    """The coefficient of x^2 over that of v^2 in the conserved form of x and the mean velocity v.

    The form Q follows from S^T Q S = Q, which is linear in the three components of a symmetric Q;
    the solutions are multiples of one. angle = w dt [rad].
    """
    s = _step(angle)
    forms = [np.array(q, float) for q in ([[1, 0], [0, 0]], [[0, 1], [1, 0]], [[0, 0], [0, 1]])]
    change = np.array([(s.T @ q @ s - q).ravel() for q in forms]).T
    kept = np.linalg.svd(change)[2][-1]
    form = sum(part * q for part, q in zip(kept, forms, strict=True))
    early = np.array([[1.0, 0.0], [angle / 2.0, 1.0]])  # (x, v-) from x and the mean velocity
    seen = early.T @ form @ early
    return float(seen[0, 0] / seen[1, 1])
