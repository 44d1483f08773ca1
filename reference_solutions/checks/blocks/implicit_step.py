"""The implicit step of DDA, step by step: the second route to its properties.

The increment d of a step D is the numerical solution of (2/D^2) m (d - D v) = force at its end.
"""

import numpy as np


def one_step(x: float, v: float, dt: float, stiffness: float, a: float) -> tuple[float, float]:
    """Position [m] and velocity [m/s] after a step dt [s].

    stiffness: K/m [1/s2] of a spring about x = 0; a: acceleration [m/s2] by a constant force.
    """
    inertia = 2.0 / (dt * dt)
    moved = (inertia * dt * v + a - stiffness * x) / (inertia + stiffness)
    return x + moved, 2.0 / dt * moved - v


def roots(angle: float) -> np.ndarray[tuple[int], np.dtype[np.complex128]]:
    """The two roots of the step, as eigenvalues of its matrix from two unit states."""
    columns = [one_step(x, v, 1.0, angle * angle, 0.0) for x, v in ((1.0, 0.0), (0.0, 1.0))]
    return np.linalg.eigvals(np.array(columns).T).astype(complex)


def damping_ratio(angle: float) -> float:
    """The damping ratio of an oscillator whose motion, sampled once a step, has these roots."""
    rate = np.log(roots(angle)[0])
    return float(-rate.real / abs(rate))


def damped_drive(a: float, dt: float, steps: int, kept: float) -> float:
    """The displacement [m] under a [m/s2] if each step starts with `kept` times the velocity."""
    x = v = 0.0
    for _ in range(steps):
        x, v = one_step(x, kept * v, dt, 0.0, a)
    return x
