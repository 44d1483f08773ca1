"""The normal impact of a sphere on a wall or another sphere, elastic with viscous losses.

The force is that of Hertz with the damping of Tsuji, Tanaka and Ishida (1992), at the overlap u
[m]:

    m u'' = -F, F = max(0, K u^(3/2) + 2 z sqrt(1.5 m K) u^(1/4) u')

With y = u^(5/4) and ds = u^(1/4) dt this is a damped linear oscillator (Antypov and Elliott 2011):

    y_ss + 2 b w y_s + w^2 y = 0, w^2 = 5 K/(4 m), b = z sqrt(6/5), y_s = 5/4 u'

so that u' is known at every overlap, and the time is an integral. The contact ends where F would
become tensile, which is where u'_s = 0: w_d s = pi - 2 asin b, w_d = w sqrt(1 - b^2), as for a
linear spring with the damping ratio b (Schwager and Poeschel 2007). m [kg] is the reduced mass, v
[m/s] the speed of approach and K [N/m^1.5] the factor of Hertz. All functions raise ValueError for
parameters outside their ranges.
"""

from math import acos, asin, cos, exp, pi, sin, sqrt

from reference_solutions.contact import dashpot
from reference_solutions.impact import spring
from reference_solutions.parameters import require_positive

LARGEST = sqrt(5.0 / 6.0)  # upper bound of z, at which b = 1


def share(z: float) -> float:
    """The damping ratio b of the oscillator in s."""
    if not 0.0 <= z < LARGEST:
        raise ValueError(f"z = {z}; it must be zero or more, and less than sqrt(5/6)")
    return z * sqrt(1.2)


def restitution(z: float) -> float:
    """The restitution e, which depends on neither speed, mass nor stiffness."""
    return dashpot.restitution(share(z))


def damping(e: float) -> float:
    """The damping ratio z of a restitution e, the inverse of `restitution`."""
    return spring.damping(e) * LARGEST


class _Swing:
    """y, u' and u'_s as functions of the phase p = w_d s."""

    def __init__(self, z: float, m: float, K: float, v: float) -> None:
        require_positive("in SI units", m=m, K=K, v=v)
        self.b, self.m, self.v = share(z), m, v
        self.w = sqrt(1.25 * K / m)
        self.root = sqrt(1.0 - self.b**2)
        self.over = pi - 2.0 * asin(self.b)  # the phase at which the contact ends

    def fading(self, p: float) -> float:
        return exp(-self.b * p / self.root)

    def y(self, p: float) -> float:
        return 1.25 * self.v / (self.w * self.root) * self.fading(p) * sin(p)

    def rate(self, p: float) -> float:
        """u' [m/s]."""
        return self.v * self.fading(p) * (cos(p) - self.b / self.root * sin(p))

    def slowing(self, p: float) -> float:
        """-u'_s."""
        b, c = self.b, self.root
        return self.v * self.w * self.fading(p) * (2.0 * b * cos(p) + (c - b * b / c) * sin(p))

    def bend(self, p: float) -> float:
        """-u'_ss, from the equation of motion."""
        return self.w**2 * self.rate(p) - 2.0 * self.b * self.w * self.slowing(p)

    def force(self, p: float) -> float:
        """F [N] = m u^(1/4) (-u'_s)."""
        return float(self.m * max(self.y(p), 0.0) ** 0.2 * self.slowing(p))

    def time(self, p: float) -> float:
        """t [s], the integral of u^(-1/4) ds; over x with the phase p x^5 it has no singularity."""
        from scipy.integrate import quad

        def part(x: float) -> float:
            at = p * x**5
            grown = self.y(at) / at if at > 0.0 else 1.25 * self.v / (self.w * self.root)
            return float(5.0 * x**3 / (grown * p) ** 0.2)

        found, _ = quad(part, 0.0, 1.0, epsabs=1e-15, epsrel=1e-13)
        return float(found) * p / (self.w * self.root)


def deepest(z: float, *, m: float, K: float, v: float) -> float:
    """The largest overlap [m]."""
    swing = _Swing(z, m, K, v)
    return float(swing.y(acos(swing.b)) ** 0.8)


def largest_force(z: float, *, m: float, K: float, v: float) -> float:
    """The largest force [N], which occurs before the largest overlap."""
    from scipy.optimize import brentq

    swing = _Swing(z, m, K, v)

    def steepness(p: float) -> float:
        """The derivative of log F, multiplied by y and the deceleration."""
        grows = 0.25 * swing.rate(p) * swing.slowing(p)
        return grows + swing.y(p) * swing.bend(p)

    return swing.force(brentq(steepness, 1e-9, acos(swing.b) + 1e-9, xtol=1e-15))


def contact_time(z: float, *, m: float, K: float, v: float) -> float:
    """The duration of the force [s]."""
    swing = _Swing(z, m, K, v)
    return swing.time(swing.over)


def cleared(z: float, *, m: float, K: float, v: float) -> float:
    """The time [s] at which the overlap ends; after the force ends, the speed is constant."""
    swing = _Swing(z, m, K, v)
    left = max(swing.y(swing.over), 0.0) ** 0.8
    return swing.time(swing.over) - float(left) / swing.rate(swing.over)
