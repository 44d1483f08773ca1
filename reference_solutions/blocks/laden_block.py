"""A block that slips in one direction along a wall while both are shaken, in closed form.

The subscripts s and n stand for the direction of slip and the normal of the wall, in this order in
all pairs. The block is driven by constant accelerations a [m/s2], which are weight and dead load
over mass, and by shaking, a sine of amplitude A [m/s2] in each direction. The wall moves by
D (sin(w t + phi) - sin phi) along its normal. While the block slips, its displacement s follows

s'' = a_s + A_s sin(w_s t + phi_s) - mu p,  p = D'' - a_n - A_n sin(w_n t + phi_n) > 0,

where mu p is the friction per mass (Coulomb) and D'' the acceleration of the wall. Along the normal
the block moves with the wall. The motion of the wall in its own plane does not matter as long as
the block moves faster. Every function raises ValueError for parameters outside their ranges.
"""

from typing import TypedDict

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reference_solutions.contact.shaken_spring import Sine
from reference_solutions.parameters import require_at_least_0, require_times

Array = NDArray[np.float64]


class Drives(TypedDict):
    """Accelerations along the slip and the normal, and the motion of the wall along its normal."""

    constant: tuple[float, float]
    shaking: tuple[Sine, Sine]
    lifting: Sine


def motion(
    t: ArrayLike,
    *,
    v: float,
    mu: float,
    constant: tuple[float, float],
    shaking: tuple[Sine, Sine],
    lifting: Sine,
) -> tuple[Array, Array]:
    """Displacement [m] and velocity [m/s], (k, 2), along the slip and the normal at times (k,) [s].

    v [m/s] is the velocity along the slip at t = 0; along the normal it is that of the wall.
    """
    t = require_times(t)
    require_at_least_0("[-]", mu=mu)
    size, omega, phase = lifting
    rise = size * (np.sin(omega * t + phase) - np.sin(phase))
    rising = size * omega * np.cos(omega * t + phase)
    from_start = size * omega * np.cos(phase)
    steady = constant[0] + mu * constant[1]
    (place, speed), (lean, leaning) = (_integrals(t, sine) for sine in shaking)
    slip = v * t + steady * t**2 / 2.0 + place + mu * (lean - rise + from_start * t)
    slipping = v + steady * t + speed + mu * (leaning - rising + from_start)
    return np.stack([slip, rise], axis=1), np.stack([slipping, rising], axis=1)


def pressure(
    t: ArrayLike, *, constant: tuple[float, float], shaking: tuple[Sine, Sine], lifting: Sine
) -> Array:
    """The normal force per mass p [m/s2] at times t [s]; the block stays on the wall if p > 0."""
    t = require_times(t)
    return np.asarray(-(lifting.omega**2) * _at(t, lifting) - constant[1] - _at(t, shaking[1]))


def wall_speed(t: ArrayLike, sliding: Sine) -> Array:
    """The velocity [m/s] of the wall in its plane, which a slipping block must exceed."""
    turned = sliding.omega * require_times(t) + sliding.phase
    return np.asarray(sliding.amplitude * sliding.omega * np.cos(turned))


def _at(t: Array, sine: Sine) -> Array:
    return np.asarray(sine.amplitude * np.sin(sine.omega * t + sine.phase))


def _integrals(t: Array, sine: Sine) -> tuple[Array, Array]:
    """The double and the single integral of a sine, both zero at t = 0."""
    size, omega, phase = sine
    turned = omega * t + phase
    swung = np.sin(phase) + omega * t * np.cos(phase) - np.sin(turned)
    return size / omega**2 * swung, size / omega * (np.cos(phase) - np.cos(turned))
