"""A damped mass on a spring under sines of acceleration and of support motion, in closed form.

m q'' + c q' + k (q - Q(t)) = F + m a(t) from q(0) = 0, q'(0) = v: q [m] is a displacement along one
axis, c [N s/m] the drag on the mass, F [N] a constant force. The drives are sums of sines of w
[rad/s]: the mass is driven by a = sum of A sin(w t + phi) [m/s2], and the far end of the spring is
displaced by Q = sum of A (sin(w t + phi) - sin phi) [m]. The solution is the steady motion under
each sine and a decaying oscillation that satisfies the initial state (Rao, Mechanical Vibrations,
harmonically excited vibration). It is for under-damped masses only. Every function raises
ValueError for parameters outside their ranges.
"""

from collections.abc import Sequence
from math import sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reference_solutions.parameters import require_at_least_0, require_positive, require_times

Array = NDArray[np.float64]


class Sine(NamedTuple):
    """A sine of the amplitude [m or m/s2], omega [rad/s] and the phase [rad]."""

    amplitude: float
    omega: float
    phase: float


def displacement(
    t: ArrayLike,
    *,
    m: float,
    k: float,
    c: float,
    v: float,
    force: float = 0.0,
    shaking: Sequence[Sine] = (),
    base: Sequence[Sine] = (),
) -> Array:
    """q [m] at times t >= 0 [s] of any shape."""
    t = require_times(t)
    require_positive("in SI units", m=m, k=k)
    require_at_least_0("N s/m", c=c)
    decay, square = c / (2.0 * m), k / m - (c / (2.0 * m)) ** 2
    if not square > 0.0:
        raise ValueError(f"c = {c} N s/m; only below 2 sqrt(k m) = {2 * sqrt(k * m):.6g} it swings")
    pushes = [Sine(m * one.amplitude, one.omega, one.phase) for one in shaking]
    pushes += [Sine(k * one.amplitude, one.omega, one.phase) for one in base]
    rest = force / k - sum(one.amplitude * float(np.sin(one.phase)) for one in base)
    steady, place, speed = np.full(t.shape, rest), rest, 0.0
    for push in pushes:
        answer = push.amplitude * np.exp(1j * push.phase)
        answer /= k - m * push.omega**2 + 1j * c * push.omega
        steady += (answer * np.exp(1j * push.omega * t)).imag
        place, speed = place + answer.imag, speed + (1j * push.omega * answer).imag
    swing = sqrt(square)
    sine = (v - speed - decay * place) / swing
    free = np.exp(-decay * t) * (-place * np.cos(swing * t) + sine * np.sin(swing * t))
    return np.asarray(steady + free, dtype=np.float64)
