"""A tumbling body, by integration of Euler's equations and of the rotation: the second route."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def flight(t: Array, inertia: Array, axes: Array, w: Array) -> tuple[Array, Array]:
    """Spin in the body's axes (k, 3) and rotation into space (k, 3, 3) at times t (k,), from 0."""

    from scipy.integrate import solve_ivp

    def rate(_: float, state: Array) -> Array:
        spin, rotation = state[:3], state[3:].reshape(3, 3)
        x, y, z = spin
        turns = rotation @ np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
        return np.append(np.cross(inertia * spin, spin) / inertia, turns)

    start = np.append(w, axes.T)
    found = solve_ivp(rate, (0.0, max(t)), start, "DOP853", t, rtol=1e-12, atol=1e-13).y.T
    return found[:, :3], found[:, 3:].reshape(-1, 3, 3)


def after(
    mass: float, inertia: Array, arm: Array, n: Array, u: Array, w: Array
) -> tuple[Array, Array]:
    """Velocity and spin (3,) in space after the impact that stops a corner at `arm` along n.

    inertia: (3, 3) in space; u, w: velocity and spin before. One linear system gives those after
    and the impulse: changes of momentum and angular momentum, and a corner at rest along n.
    """
    rows = np.zeros((7, 7))
    rows[:3, :3], rows[:3, 6] = mass * np.eye(3), -n
    rows[3:6, 3:6], rows[3:6, 6] = inertia, -np.cross(arm, n)
    rows[6, :3], rows[6, 3:6] = n, np.cross(arm, n)
    found = np.linalg.solve(rows, np.concatenate([mass * u, inertia @ w, [0.0]]))
    return found[:3], found[3:6]
