"""A sphere set down sliding on a level wall slips until it rolls, on a shear spring.

The normal force is m g throughout. With the rate of slip s, the lever arm a and q = 1 + m a^2/I:

    s' = q T/m, m v' = T, T' = -ks s until |T| = mu m g

The sphere first loads the spring, T = -ks v0/w sin(w t) with w^2 = q ks/m. Then it slips, s' = -q
mu g, and finally it sticks and oscillates about rolling, T = -mu m g cos(w t). In rigid contact
(infinite ks) it slips until v0/(q mu g), which is 2/7 v0/(mu g) for a solid sphere, and rolls at (1
- 1/q) v0, which is 5/7 v0.
"""

from math import asin, cos, sin, sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reference_solutions.parameters import require_positive, require_times

Array = NDArray[np.float64]


class Sliding(NamedTuple):
    """m [kg], ks [N/m], mu, g [m/s2], v0 [m/s] and q."""

    m: float
    ks: float
    mu: float
    g: float
    v0: float
    q: float = 3.5

    def checked(self) -> "Sliding":
        """The parameters; raises ValueError if they are impossible or the sphere never slips."""
        require_positive("in SI units", **self._asdict())
        if not self.most < 1.0:
            raise ValueError(f"mu = {self.mu}; the spring holds the sphere, which never slips")
        return self

    @property
    def w(self) -> float:
        """The angular frequency of the oscillation on the shear spring [1/s]."""
        return sqrt(self.q * self.ks / self.m)

    @property
    def most(self) -> float:
        """The ratio of mu m g to the largest force that the spring would reach without slip."""
        return self.mu * self.m * self.g * self.w / (self.ks * self.v0)

    @property
    def slips(self) -> float:
        """The time at which slip begins [s]."""
        return asin(self.most) / self.w

    @property
    def rolls(self) -> float:
        """The time at which slip ends [s]."""
        left = self.v0 * cos(self.w * self.slips)
        return self.slips + left / (self.q * self.mu * self.g)

    def speed(self, t: float) -> float:
        """v [m/s] at a time [s]: m (v - v0) is the impulse of friction, and s - v0 = q (v - v0)."""
        if t < self.slips:
            return self.v0 * (1.0 - (1.0 - cos(self.w * t)) / self.q)
        if t < self.rolls:
            return self.speed_at_cap - self.mu * self.g * (t - self.slips)
        past = self.w * (t - self.rolls)
        return self.v0 * (1.0 - 1.0 / self.q) - self.mu * self.g / self.w * sin(past)

    @property
    def speed_at_cap(self) -> float:
        """v [m/s] at the onset of slip."""
        return self.v0 * (1.0 - (1.0 - cos(self.w * self.slips)) / self.q)


def speed(t: ArrayLike, sliding: Sliding) -> Array:
    """v [m/s] at times t >= 0 [s] of any shape."""
    t, sliding = require_times(t), sliding.checked()
    return np.array([sliding.speed(float(when)) for when in t.flat]).reshape(np.shape(t))
