"""An oblique impact of a sphere on a wall or another sphere, with Coulomb friction, in a plane.

The forces, with the overlap U [m] and the exponent p (1: linear springs, 3/2: Hertz and Mindlin):

- normal: Fn = max(0, K U^p + D U^((p - 1)/2) U'), never tensile; the contact ends where Fn = 0;
- tangential: T' = -S U^(p - 1) s, the stiffness without slip, in increments, and |T| <= mu Fn with
  the whole of Fn. The rate of slip s is taken at the middle of the overlap, where the bodies touch,
  so that the lever arms are R - U/2.

Codes differ in some of these, for which `Law` has parameters: the lever arm of slip, R - a U, that
of the torque, R - b U, and whether a spring of the current stiffness holds the whole slip, in which
case T is -S U^(p - 1) times the integral of s. The equations are integrated in Cartesian
coordinates by an explicit method of order 8 between events, at which slip begins or ends. There is
no closed form except for a sphere that slips throughout: its vt decreases by mu (1 + e) vn.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from math import copysign, hypot, inf, sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
RELATIVE = 3e-14  # relative tolerance of a step, about 100 rounding errors
LONGEST = 20.0  # times the largest overlap over the speed; contacts last less than 4 of these
MOST = 20  # changes between stick and slip; more of them count as a failure


@dataclass(frozen=True)
class Law:
    """K, S [N/m^p], friction mu, exponent p, and z of D = 2 z sqrt(m p K), m the reduced mass.

    a, b: the lever arms of slip and of torque are R - a U and R - b U. h: besides the increments,
    T' has the term h (p - 1) T U'/U; h = 0 for increments alone, 1 for a spring of the current
    stiffness.
    """

    K: float
    S: float
    mu: float
    p: float = 1.5
    z: float = 0.0
    a: float = 0.5
    b: float = 0.5
    h: float = 0.0

    def __post_init__(self) -> None:
        for name in ("K", "p"):
            if not 0.0 < getattr(self, name) < inf:
                raise ValueError(f"Law.{name} = {getattr(self, name)}; it must be positive")
        for name in ("S", "mu", "z", "a", "b", "h"):
            if not 0.0 <= getattr(self, name) < inf:
                raise ValueError(f"Law.{name} = {getattr(self, name)}; it must be zero or more")


@dataclass(frozen=True)
class Sphere:
    """Radius [m] and mass [kg]; inertia 2/5 m R^2. A wall is a partner of infinite radius."""

    radius: float
    mass: float

    @property
    def is_wall(self) -> bool:
        """Whether the radius is infinite."""
        return self.radius == inf


WALL = Sphere(inf, inf)


class After(NamedTuple):
    """The velocities after an impact, its duration, and the time at which the overlap ends [s].

    normal, tangential: the velocity of the sphere relative to its partner [m/s], along the initial
    line of centres, positive away from the partner, and across it; spin, partner_spin [1/s]. A
    viscous contact ends while the bodies still overlap; they then separate at constant velocity.
    """

    normal: float
    tangential: float
    spin: float
    partner_spin: float
    lasting: float
    cleared: float


@cache
def rebound(
    law: Law,
    sphere: Sphere,
    *,
    vn: float,
    vt: float = 0.0,
    spin: float = 0.0,
    partner: Sphere = WALL,
    partner_spin: float = 0.0,
) -> After:
    """The state after an impact with the speed vn towards the partner and vt across it [m/s].

    Spins are positive from the normal, which points to the sphere, to the tangent. Raises
    ValueError unless vn is positive, RuntimeError if the integration fails.
    """
    if not 0.0 < vn < inf:
        raise ValueError(f"vn = {vn} m/s; the bodies must approach each other")
    impact = Impact(law, sphere, partner, vn)
    start = np.array([0.0, 0.0, -vn, vt, spin, partner_spin, 0.0])
    time, state = 0.0, start
    slips = impact.slips_first(start)
    for _ in range(MOST):
        time, state, ended = impact.until_change(time, state, slips)
        if ended:
            left = impact.clearing(state)
            return After(state[2], state[3], state[4], state[5], time, time + left)
        slips = 0.0 if slips else copysign(1.0, state[6])
    raise RuntimeError(f"the contact began or ended to slip more than {MOST} times")


class Impact:
    """The equations of two bodies in contact; states (7,): displacement, velocity, spins, T.

    They are written in scalars, since arrays of two elements take several times as long.
    """

    def __init__(self, law: Law, sphere: Sphere, partner: Sphere, vn: float) -> None:
        self.law, self.sphere, self.partner = law, sphere, partner
        self.gap, self.is_wall = sphere.radius + partner.radius, partner.is_wall
        one, two = sphere, partner
        self.inertia = 0.4 * one.mass * one.radius**2
        self.other_inertia = 1.0 if two.is_wall else 0.4 * two.mass * two.radius**2
        self.mass = one.mass if two.is_wall else one.mass * two.mass / (one.mass + two.mass)
        self.damping = 2.0 * law.z * sqrt(self.mass * law.p * law.K)
        deep = ((law.p + 1.0) * self.mass * vn**2 / (2.0 * law.K)) ** (1.0 / (law.p + 1.0))
        self.unit, self.longest = deep / vn, LONGEST * deep / vn
        turn = vn / sphere.radius
        self.sizes = np.array([deep, deep, vn, vn, turn, turn, law.K * deep**law.p])

    def frame(self, y: Sequence[float] | Array) -> tuple[float, float, float]:
        """The normal (c, s), to which (-s, c) is the tangent, and the overlap.

        The overlap is computed from the displacements without cancellation.
        """
        if self.is_wall:
            return 1.0, 0.0, -float(y[0])
        gap, along, across = self.gap, float(y[0]), float(y[1])
        distance = hypot(gap + along, across)
        overlap = -(2.0 * gap * along + along**2 + across**2) / (gap + distance)
        return (gap + along) / distance, across / distance, overlap

    def closing(self, y: Sequence[float] | Array) -> tuple[float, float]:
        """The overlap, and its rate along the normal."""
        c, s, overlap = self.frame(y)
        return overlap, -(c * float(y[2]) + s * float(y[3]))

    def clearing(self, y: Array) -> float:
        """The time [s] for which the bodies still overlap after their contact has ended."""
        place, speed = y[:2], y[2:4]
        if self.partner.is_wall:
            return float(-place[0] / speed[0])
        beyond = float(2.0 * self.gap * place[0] + place @ place)  # excess of the squared distance
        rate = float(self.gap * speed[0] + place @ speed)
        return -beyond / (rate + sqrt(max(rate**2 - float(speed @ speed) * beyond, 0.0)))

    def push(self, overlap: float, closing: float) -> float:
        """The normal force Fn without the limit at zero: steps that go beyond it find it smooth."""
        law, deep = self.law, overlap if self.law.p == 1.0 else max(overlap, 0.0)
        return float(law.K * deep**law.p + self.damping * deep ** (0.5 * law.p - 0.5) * closing)

    def pressing(self, y: Array) -> float:
        """Fn/U^((p - 1)/2), which passes through zero once, where the contact ends."""
        overlap, closing = self.closing(y)
        held = self.law.K * abs(overlap) ** (0.5 * self.law.p + 0.5)
        return copysign(held, overlap) + self.damping * closing

    def arms(self, part: float, overlap: float) -> tuple[float, float]:
        """The lever arms [m], each a radius less a fraction `part` of the overlap; 0 for a wall."""
        short = part * overlap
        second = 0.0 if self.is_wall else self.partner.radius - short
        return self.sphere.radius - short, second

    def slip(self, y: Sequence[float] | Array) -> float:
        """The rate of slip s [m/s]."""
        c, s, overlap = self.frame(y)
        first, second = self.arms(self.law.a, overlap)
        across = c * float(y[3]) - s * float(y[2])
        return across - first * float(y[4]) - second * float(y[5])

    def slope(self, y: Array, slips: float) -> Array:
        """The derivative y'; slips: the sign of T where the contact slips, else 0."""
        now = y.tolist()
        c, s, overlap = self.frame(now)
        push = self.push(overlap, -(c * now[2] + s * now[3]))
        rubbing = slips * self.law.mu * push if slips else now[6]
        first, second = self.arms(self.law.b, overlap)
        return np.array([
            now[2],
            now[3],
            (push * c - rubbing * s) / self.mass,
            (push * s + rubbing * c) / self.mass,
            -first * rubbing / self.inertia,
            -second * rubbing / self.other_inertia,
            0.0 if slips else self.charging(now, now[6]),
        ])  # fmt: skip

    def charging(self, y: Sequence[float] | Array, force: float) -> float:
        """The rate T' without slip at the tangential force `force`."""
        overlap, closing = self.closing(y)
        rate = -float(self.law.S * max(overlap, 0.0) ** (self.law.p - 1.0)) * self.slip(y)
        if self.law.h and overlap > 0.0:
            rate += self.law.h * (self.law.p - 1.0) * force * closing / overlap
        return rate

    def slips_first(self, y: Array) -> float:
        """The sign of T if the contact slips from the start, where forces grow as t^p; else 0."""
        law, slip = self.law, self.slip(y)
        growth = law.p - law.h * (law.p - 1.0)  # T' of T = S v^(p - 1) s t^p/growth
        cap = growth * law.mu * law.K * -float(y[2])
        slips = law.mu == 0.0 or (self.damping == 0.0 and law.S * abs(slip) > cap)
        return -copysign(1.0, slip) if slips else 0.0

    def until_change(self, time: float, y: Array, slips: float) -> tuple[float, Array, bool]:
        """The time and state where contact ends, or slip begins or ends; whether contact ended."""

        from scipy.integrate import solve_ivp

        def ends(t: float, y: Array) -> float:
            return self.pressing(y)

        def changes(t: float, y: Array) -> float:
            if self.law.mu == 0.0:
                return 1.0
            return self.exceeding(y, slips) if slips else self.reserve(y)

        for event in (ends, changes):
            event.terminal, event.direction = True, -1  # type: ignore[attr-defined]
        # Time is counted in units of the contact, since events are located to 1e-15 of one unit.
        # The first step of the contact is tiny, since forces that grow as t^p are not smooth there;
        # after a change the margin grows as the square of a step, and must stand out of rounding.
        found = solve_ivp(
            lambda t, y: self.unit * self.slope(y, slips), (0.0, LONGEST), y, "DOP853",
            events=(ends, changes), rtol=RELATIVE, atol=1e-15 * self.sizes,
            first_step=2e-5 if time else 1e-11,
        )  # fmt: skip
        if found.status != 1:
            raise RuntimeError(f"the contact did not end within {self.longest:.3g} s")
        state = found.y[:, -1].copy()
        if slips:
            state[6] = slips * self.law.mu * max(self.push(*self.closing(state)), 0.0)
        ended = len(found.t_events[0]) > 0 or self.pressing(state) <= 0.0  # T = 0: both are due
        return time + self.unit * float(found.t[-1]), state, ended

    def reserve(self, y: Array) -> float:
        """The margin against slip, mu Fn - |T| [N]."""
        return self.law.mu * self.push(*self.closing(y)) - abs(float(y[6]))

    def exceeding(self, y: Array, slips: float) -> float:
        """The rate of |T| without slip less that of its limit mu Fn [N/s]."""
        c, s, overlap = self.frame(y)
        law, deep = self.law, max(overlap, 1e-300)
        closing = -(c * float(y[2]) + s * float(y[3]))
        across = c * float(y[3]) - s * float(y[2])
        turning = 0.0 if self.is_wall else across**2 / (self.gap - overlap)
        slowing = -max(self.push(overlap, closing), 0.0) / self.mass - turning
        half = 0.5 * law.p - 0.5
        rate = law.K * law.p * deep ** (law.p - 1.0) * closing
        if self.damping:
            rate += self.damping * deep**half * (half * closing**2 / deep + slowing)
        force = slips * law.mu * max(self.push(overlap, closing), 0.0)
        return float(slips * self.charging(y, force) - law.mu * rate)
