"""An oblique impact by collocation in a variable in which it is analytic: the second route.

With the overlap U = q^4 and dt = q^3 ds, all forces of linear springs, Hertz, Mindlin and Tsuji are
polynomials in q, also at the start and end of the contact. T is written as W U^(h (p - 1)), so that
the term h (p - 1) T U'/U of T' drops out, which is singular where the contact begins. The state, in
polar coordinates, is q, the velocities along and across the line of centres, both spins, W, the
angle of that line, and t.
The parameters are those of `reference_solutions.impact.rebound`, whose code is not used here.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import cos, hypot, inf, sin, sqrt

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray

Array = NDArray[np.float64]
NODES, PANELS = 14, 48
_X = legendre.leggauss(NODES)[0].astype(np.float64)
_FIT = np.linalg.inv(legendre.legvander(_X, NODES - 1))
_SUM = legendre.legint(np.eye(NODES), lbnd=-1.0, scl=0.5)
INSIDE: Array = legendre.legvander(_X, NODES) @ _SUM @ _FIT  # integrals up to each node
WHOLE: Array = (np.ones(NODES + 1) @ _SUM @ _FIT).astype(np.float64)


@dataclass(frozen=True)
class Strike:
    """The law (K, S [N/m^p], mu, p, z) and the bodies: radii [m], masses [kg], infinite for a wall.

    a, b and h are the parameters of `Law` in which codes differ.
    """

    K: float
    S: float
    mu: float
    p: float
    z: float
    radius: float
    mass: float
    partner_radius: float = inf
    partner_mass: float = inf
    a: float = 0.5
    b: float = 0.5
    h: float = 0.0

    @property
    def reduced(self) -> float:
        """The reduced mass [kg]."""
        return 1.0 / (1.0 / self.mass + 1.0 / self.partner_mass)

    def normal_force(self, q: Array, away: Array) -> Array:
        """The normal force Fn without the limit at zero."""
        damping = 2.0 * self.z * sqrt(self.reduced * self.p * self.K)
        return np.asarray(self.K * q ** (4 * self.p) - damping * q ** (2 * self.p - 2) * away)

    @property
    def power(self) -> float:
        """The power of q in T = W q^power."""
        return 4.0 * self.h * (self.p - 1.0)

    def slopes(self, y: Array, sign: float) -> Array:
        """dy/ds (8, k) of states (8, k); sign: the sign of T where the contact slips, else 0."""
        q, away, across, spin, other, W = y[:6]
        deep, fast = q**4, q**3
        push = self.normal_force(q, away)
        rub = sign * self.mu * push if sign else W * q**self.power
        arm, torque = self.radius - self.a * deep, self.radius - self.b * deep
        turned = 1.0 / (0.4 * self.mass * self.radius**2)
        slip, spun, angle = across - arm * spin, np.zeros_like(q), np.zeros_like(q)
        centre = pull = np.zeros_like(q)
        if self.partner_radius < inf:
            length = self.radius + self.partner_radius - deep
            angle, second = across / length, self.partner_radius - self.a * deep
            slip = slip - second * other
            lever = self.partner_radius - self.b * deep
            spun = -lever * rub / (0.4 * self.partner_mass * self.partner_radius**2)
            centre, pull = across * angle, away * angle
        left = 4.0 * self.p - 4.0 - self.power  # the power of q in W'
        charge = np.zeros_like(q) if sign else -self.S * q**left * slip
        one = np.ones_like(q)
        rates = [push / self.reduced + centre, rub / self.reduced - pull, -torque * rub * turned]
        return np.array([-away / 4, *(fast * r for r in (*rates, spun, charge, angle, one))])

    def panel(self, y: Array, length: float, sign: float) -> Array:
        """The states (8, nodes + 1) in a panel in s and at its end, by fixed-point iteration."""
        at = np.repeat(y[:, None], NODES, axis=1)
        for _ in range(100):
            slope = self.slopes(at, sign)
            new = y[:, None] + length * slope @ INSIDE.T
            done = bool((np.abs(new - at) <= 4e-16 * np.abs(new).max(axis=1)[:, None]).all())
            at = new
            if done:
                break
        end: Array = y + length * self.slopes(at, sign) @ WHOLE
        return np.column_stack([at, end])


def after(
    strike: Strike, *, vn: float, vt: float, spin: float = 0.0, partner_spin: float = 0.0
) -> tuple[float, ...]:
    """Both velocities, both spins, the duration and the end of the overlap, as in `rebound`."""
    p, m = strike.p, strike.reduced
    deep = ((p + 1.0) * m * vn**2 / (2.0 * strike.K)) ** (1.0 / (p + 1.0))
    length = 16.0 * deep**0.25 / vn / PANELS
    y = np.array([0.0, -vn, vt, spin, partner_spin, 0.0, 0.0, 0.0])
    sign = _first(strike, y)
    for _ in range(20 * PANELS):
        stops = [_pressing(strike), _sliding(strike, sign)]
        ahead = strike.panel(y, length, sign)
        within = [(_crossing(ahead, stop) * length, stop) for stop in stops]
        crossed = [(_share(strike, y, far, sign, stop), stop) for far, stop in within if far < inf]
        if crossed:
            reach, stop = min(crossed, key=lambda pair: pair[0])
            y = strike.panel(y, reach, sign)[:, -1]
            if stop is stops[0]:
                return _read(strike, y)
            y[5] = _limit(strike, y, sign) if sign else y[5]
            sign = 0.0 if sign else float(np.sign(y[5]))
        else:
            y = ahead[:, -1]
    raise RuntimeError("the contact did not end")


Test = Callable[[Array], float]


def _pressing(strike: Strike) -> Test:
    """A test that is negative once the contact is over; both kinds start at zero.

    It is q for a spring alone, else the normal force.
    """
    if strike.z == 0.0:
        return lambda y: float(y[0])
    return lambda y: float(strike.normal_force(y[0], y[1]))


def _sliding(strike: Strike, sign: float) -> Test:
    """A test that is negative where a contact that sticks should slip, or the other way round.

    sign: the sign of T where the contact slips, else 0.
    """
    if not sign:
        return lambda y: float(
            strike.mu * strike.normal_force(y[0], y[1]) - abs(y[5]) * y[0] ** strike.power
        )

    smallest = (strike.reduced / strike.K) ** 0.25

    def margin(y: Array) -> float:
        held = y.copy()
        held[5] = _limit(strike, y, sign)
        rates = strike.slopes(held[:, None], 0.0)[:, 0]
        free = y[0] ** strike.power * rates[5]
        if strike.power and y[0] > 0.0:
            free += strike.power * held[5] * y[0] ** (strike.power - 1.0) * rates[0]
        tiny = 1e-6 * max(float(y[0]), 1e-3 * smallest) / max(abs(float(y[1])), 1e-9)
        slope = strike.slopes(y[:, None], sign)[:, 0]
        ahead, back = y + tiny * slope, y - tiny * slope
        force = [float(strike.normal_force(one[0], one[1])) for one in (ahead, back)]
        return float(sign * free - strike.mu * (force[0] - force[1]) / (2.0 * tiny))

    return margin


def _limit(strike: Strike, y: Array, sign: float) -> float:
    """W of a force at the limit of friction; there is none at the start of the contact."""
    force = sign * strike.mu * float(strike.normal_force(y[0], y[1]))
    return float(force / y[0] ** strike.power) if force else 0.0


def _crossing(ahead: Array, stop: Test) -> float:
    """The fraction of a panel at whose node a test is first negative; infinite if at none."""
    places = [*(0.5 * (_X + 1.0)), 1.0]
    found = (place for place, y in zip(places, ahead.T, strict=True) if stop(y) < 0.0)
    return float(next(found, inf))


def _share(strike: Strike, y: Array, length: float, sign: float, stop: Test) -> float:
    """The part of a length in s after which a test becomes negative, by bisection."""
    low, high = 0.0, 1.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        if stop(strike.panel(y, middle * length, sign)[:, -1]) < 0.0:
            high = middle
        else:
            low = middle
    return 0.5 * (low + high) * length


def _first(strike: Strike, y: Array) -> float:
    """The sign of T if the contact slips from the start, else 0."""
    slip = y[2] - strike.radius * y[3]
    slip -= strike.partner_radius * y[4] if strike.partner_radius < inf else 0.0
    limit = (strike.p - strike.h * (strike.p - 1.0)) * strike.mu * strike.K * -y[1]
    if strike.mu == 0.0 or (strike.z == 0.0 and strike.S * abs(slip) > limit):
        return -float(np.sign(slip)) or 1.0
    return 0.0


def _read(strike: Strike, y: Array) -> tuple[float, ...]:
    """Velocities along the initial axes, both spins, the duration, and when the overlap ends."""
    c, s = cos(float(y[6])), sin(float(y[6]))
    normal, tangential = c * y[1] - s * y[2], s * y[1] + c * y[2]
    left, end = _clearing(strike, y), float(y[7])
    return float(normal), float(tangential), float(y[3]), float(y[4]), end, end + left


def _clearing(strike: Strike, y: Array) -> float:
    """The time [s] until the distance of two bodies that move freely is that of touching.

    The distance is convex in time, so that Newton's method from a time beyond the root falls to it
    and never misses it, also where the slip is fast; a fixed point t = f(t) need not converge.
    """
    deep, away, across = max(float(y[0]), 0.0) ** 4, float(y[1]), float(y[2])
    if strike.partner_radius == inf:
        return deep / away
    gap = strike.radius + strike.partner_radius
    left = 2.0 * gap / hypot(away, across)
    for _ in range(100):
        along, beside = gap - deep + away * left, across * left
        distance = hypot(along, beside)
        excess = away * left - deep + beside**2 / (distance + along)  # distance - gap
        change = excess * distance / (along * away + beside * across)
        left = max(left - change, 0.0)
        if abs(change) <= 1e-16 * left:
            break
    return left
