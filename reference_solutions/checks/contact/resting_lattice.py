"""A close-packed sheet at rest, by minimisation of energy: the second route.

The energy of the springs and of the weight is minimised by a quasi-Newton method (BFGS). This is
less accurate than Newton's method on the forces: the error is about 1e-8 of an overlap. Parameters
are those of `reference_solutions.contact.resting_lattice`, whose code is not used here.
"""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def moved(x: Array, *, r: float, m: float, kn: float, g: float, width: float) -> Array:
    """The positions at rest (k, 2) [m] from initial centres x (k, 2) [m]."""
    from scipy.optimize import minimize

    size, still = m * g / kn, m * g * m * g / kn  # overlap due to one weight; its energy

    def energy(q: Array) -> tuple[float, Array]:
        at = x + size * q.reshape(-1, 2)
        force, held = np.zeros_like(at), 0.0
        for k in range(len(at)):
            apart = at - at[k]
            length = np.hypot(apart[:, 0], apart[:, 1])
            length[k] = np.inf
            overlap = np.maximum(2.0 * r - length, 0.0)
            held += 0.25 * kn * float(overlap @ overlap)
            force[k] -= kn * (overlap / length) @ np.where(np.isinf(length)[:, None], 0.0, apart)
        left, right = np.maximum(r - at[:, 0], 0.0), np.maximum(at[:, 0] + r - width, 0.0)
        floor = np.maximum(r - at[:, 1], 0.0)
        held += 0.5 * kn * float(left @ left + right @ right + floor @ floor)
        held += m * g * size * float(q[1::2].sum())
        force += kn * np.stack([left - right, floor], axis=1)
        force[:, 1] -= m * g
        return held / still, -force.ravel() * size / still

    start = np.zeros(x.size)
    found = minimize(
        energy, start, jac=True, method="BFGS", options={"gtol": 1e-9, "maxiter": 5000}
    )
    return np.asarray(x + size * found.x.reshape(-1, 2))
