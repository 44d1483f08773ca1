"""The rod of Painleve's paradox by time steps, an impulse and energy: the second route.

The accelerations of middle and angle and the normal force follow at each time from the linear
equations of motion and of the contact. An impulse stops the end where the rod jams; the rotation
about the resting end follows from energy.
"""

from math import cos, sin, sqrt

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def forces(theta: float, w: float, mu: float, half: float, g: float) -> Array:
    """x'', z'', theta'' and N/m while the end slides towards -x, by four linear equations."""
    s, c = sin(theta), cos(theta)
    matrix = np.array([
        [1.0, 0.0, 0.0, -mu],
        [0.0, 1.0, 0.0, -1.0],
        [0.0, 0.0, half**2 / 3.0, half * c - half * s * mu],
        [0.0, 1.0, -half * c, 0.0],  # the end stays on the floor
    ])  # fmt: skip
    return np.linalg.solve(matrix, np.array([0.0, -g, 0.0, -half * s * w * w]))


def slide(
    end: float, steps: int, *, mu: float, theta: float, half: float, V: float, g: float
) -> Array:
    """Displacement (2,) [m] of the middle and velocity [m/s] of the end at the time `end` [s]."""
    y = np.array([0.0, 0.0, theta, -V, 0.0, 0.0])
    h = end / steps

    def rate(y: Array) -> Array:
        return np.concatenate([y[3:], forces(y[2], y[5], mu, half, g)[:3]])

    for _ in range(steps):
        a = rate(y)
        b = rate(y + h / 2.0 * a)
        c = rate(y + h / 2.0 * b)
        d = rate(y + h * c)
        y = y + h / 6.0 * (a + 2.0 * b + 2.0 * c + d)
    return np.array([y[0], y[1], y[3] + half * sin(y[2]) * y[5]])


def jam(*, mu: float, theta: float, half: float, V: float) -> tuple[float, float]:
    """The spin [1/s] after the impulse that stops the end, and its normal part over m [m/s].

    The impulse grows on the boundary of the friction cone until the end stops sliding, and then
    keeps it at rest. Its components along and normal to the floor follow from the end at rest.
    """
    s, c = half * sin(theta), half * cos(theta)
    gain = 3.0 / half**2
    # changes of the velocity of the end (x, z) by the components of an impulse over m
    pull = np.array([[1.0 + gain * s * s, -gain * s * c], [-gain * s * c, 1.0 + gain * c * c]])
    along, up = np.linalg.solve(pull, np.array([V, 0.0]))
    return gain * (s * along - c * up), up


def turning_time(theta: float, swing: float, spin: float, half: float, g: float) -> float:
    """The time [s] of the rotation from theta by `swing` about the resting end, by energy."""
    from scipy.integrate import quad

    def slow(angle: float) -> float:
        fallen = 1.5 * g / half * (sin(theta) - sin(angle))
        return 1.0 / sqrt(spin**2 + fallen)

    return float(quad(slow, theta, theta + swing, epsabs=1e-14, epsrel=1e-13)[0])
