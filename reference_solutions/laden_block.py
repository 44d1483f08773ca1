"""A block that slips one way along a wall while both are shaken, in closed form.

Along the slip and along the wall's normal, by rows: the block is driven by constant accelerations
(weight and dead load over mass), a [m/s2], and by shaking, a sine of amplitude A [m/s2] in each;
the wall moves by D (sin(w t + phi) - sin phi) along its normal. While the block slips it has

s'' = a_s + A_s sin(w_s t + phi_s) - mu p,  p = D'' - a_n - A_n sin(w_n t + phi_n) > 0,

where mu p is friction per mass (Coulomb), D'' the acceleration of the wall, and along the normal
the block is where the wall is. How the wall moves along itself does not enter. Every function
raises ValueError for parameters outside their ranges.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reference_solutions.parameters import require_at_least_0, require_times

Array = NDArray[np.float64]


class Sine(NamedTuple):
    """amplitude [m or m/s2], omega [rad/s], phase [rad]."""

    amplitude: float
    omega: float
    phase: float


def along(
    t: ArrayLike,
    *,
    v: float,
    mu: float,
    constant: tuple[float, float],
    shaking: tuple[Sine, Sine],
    lifting: Sine,
) -> Array:
    """Displacement [m] along the slip at times t >= 0 [s] of any shape; v [m/s] at t = 0."""
    t = require_times(t)
    require_at_least_0("[-]", mu=mu)
    steady = constant[0] + mu * constant[1]
    shaken = _twice(t, shaking[0]) + mu * _twice(t, shaking[1])
    lifted = rise(t, lifting) - t * lifting.amplitude * lifting.omega * np.cos(lifting.phase)
    return np.asarray(v * t + steady * t**2 / 2.0 + shaken - mu * lifted)


def rise(t: ArrayLike, lifting: Sine) -> Array:
    """Displacement [m] of the wall and the block along its normal."""
    size, omega, phase = lifting
    return np.asarray(size * (np.sin(omega * require_times(t) + phase) - np.sin(phase)))


def _twice(t: Array, sine: Sine) -> Array:
    """A sine, integrated twice from nothing."""
    size, omega, phase = sine
    swung = np.sin(phase) + omega * t * np.cos(phase) - np.sin(omega * t + phase)
    return np.asarray(size / omega**2 * swung)
