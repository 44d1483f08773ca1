"""Spheres that strike a wall, or each other in pairs, side by side in one scene."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np

from cases.impact.parts._materials import require_shallow
from reference_solutions.impact import hertz, micro_slip
from reference_solutions.impact.rebound import WALL, After, Law, Sphere, rebound
from vv.ask import Displacement, Method, Observable, Run, Velocity
from vv.case import Exact, Scalar, Tolerance
from vv.scene import Contact, Scene, Spheres, Vector, Wall

FLOOR = 1e-6  # effect of arms that differ in second order of U/R, at overlaps of 1e-3 R
LEAST = 0.02  # least bound of first order, over the step as a part of a contact
APART = 6.0  # radii between impacts
ARMS = (0.5, 0.5), (1.0, 1.0), (1.0, 0.5)  # a and b of `Law`, in which codes differ
SPRINGS = 0.0, 1.0  # h of `Law`, in which codes differ too
OURS = (ARMS[0], SPRINGS[0])
Choice = tuple[tuple[float, float], float]
NORMAL, ALONG, ASIDE = np.eye(3)


@dataclass(frozen=True)
class Blow:
    """How a sphere starts: towards and along what it strikes [m/s], and its spin [1/s].

    The spin, and that of the partner, is positive from the normal to the tangent.
    """

    vn: float
    vt: float = 0.0
    spin: float = 0.0
    partner_spin: float = 0.0

    @property
    def speed(self) -> float:
        """The speed of the sphere [m/s], to which errors are relative."""
        return math.hypot(self.vn, self.vt)


@dataclass(frozen=True, eq=False)
class Impacts:
    """Impacts of one kind: their starts by name, and the contact law of all of them.

    partner: the sphere that is struck, which is at rest but for its spin; WALL for a wall.
    """

    sphere: Sphere
    contact: Contact
    blows: Mapping[str, Blow]
    partner: Sphere = WALL

    def __post_init__(self) -> None:
        law, fastest = self.law, max((blow.vn for blow in self.blows.values()), default=0.0)
        if fastest > 0.0:
            deepest = (
                fastest * math.sqrt(self.reduced / law.K) if law.p == 1.0
                else hertz.deepest(m=self.reduced, K=law.K, v=fastest)
            )  # fmt: skip
            require_shallow(deepest, min(self.sphere.radius, self.partner.radius))

    @property
    def each(self) -> int:
        """The number of spheres in an impact."""
        return 1 if self.partner.is_wall else 2

    @property
    def slips_in_part(self) -> bool:
        """Whether contacts have micro-slip, which only one code has."""
        return self.contact.hertz is not None and self.contact.hertz.micro_slip

    @property
    def reduced(self) -> float:
        """Reduced mass [kg]."""
        one, two = self.sphere.mass, self.partner.mass
        return one if self.partner.is_wall else one * two / (one + two)

    @property
    def law(self) -> Law:
        """The contact law as the reference has it, with arms in the middle of the overlap."""
        law = self.contact
        if law.hertz is None:
            z = 0.5 * law.eta_n / math.sqrt(self.reduced * law.kn)
            return Law(law.kn, law.ks, law.mu, 1.0, z)
        radius = 1.0 / (1.0 / self.sphere.radius + 1.0 / self.partner.radius)
        factors = (
            hertz.normal_factor(modulus=law.hertz.modulus, radius=radius),
            hertz.shear_factor(modulus=law.hertz.shear_modulus, radius=radius),
        )
        return Law(*factors, law.mu, 1.5, law.hertz.damping)

    def scene(self) -> Scene:
        """All impacts side by side; the bodies of each touch at t = 0."""
        one, two, each = self.sphere, self.partner, self.each
        place, velocity, spin = np.zeros((3, len(self.blows), each, 3))
        width = APART * max(one.radius, 0.0 if two.is_wall else two.radius)
        for k, blow in enumerate(self.blows.values()):
            place[k] = k * width * ASIDE
            place[k, 0] += one.radius * NORMAL
            velocity[k, 0] = -blow.vn * NORMAL + blow.vt * ALONG
            spin[k, 0] = blow.spin * ASIDE
            if each == 2:
                place[k, 1] -= two.radius * NORMAL
                spin[k, 1] = blow.partner_spin * ASIDE
        count = each * len(self.blows)
        kinds = [one, two][:each] * len(self.blows)
        spheres = Spheres(
            position=place.reshape(-1, 3),
            velocity=velocity.reshape(-1, 3),
            radius=np.array([kind.radius for kind in kinds]),
            mass=np.array([kind.mass for kind in kinds]),
            spin=spin.reshape(-1, 3),
            free=np.ones((count, 3), bool),
            free_spin=np.ones((count, 3), bool),
        )
        walls = () if each == 2 else (Wall(np.zeros(3), NORMAL),)
        return Scene((spheres, *walls), self.contact)

    def seen(self) -> tuple[Observable, ...]:
        """The observables of the spheres."""
        bodies = range(self.each * len(self.blows))
        return tuple(kind(body) for body in bodies for kind in (Displacement, Velocity))

    def after(self, name: str, choice: Choice = OURS) -> After:
        """The exact end of an impact, by the scene's law or by one in which codes differ."""
        blow, ((a, b), h) = self.blows[name], choice
        solve = micro_slip.rebound if self.slips_in_part else rebound
        return solve(
            replace(self.law, a=a, b=b, h=h), self.sphere, partner=self.partner,
            vn=blow.vn, vt=blow.vt, spin=blow.spin, partner_spin=blow.partner_spin,
        )  # fmt: skip

    def seen_after(self, name: str, run: Run) -> Vector:
        """The velocity (2,) of the sphere against its partner at the end, along and across."""
        return np.asarray((self._relative(Velocity, name, run) @ np.array([NORMAL, ALONG]).T)[-1])

    def _relative(self, kind: type[Displacement] | type[Velocity], name: str, run: Run) -> Vector:
        """An observable (k, 3) of the sphere minus that of its partner."""
        first = self.each * [*self.blows].index(name)
        own = run.values[kind(first)]
        return np.asarray(own if self.each == 1 else own - run.values[kind(first + 1)])

    def parting(self, name: str, run: Run) -> float:
        """The time of separation [s], extrapolated back from the end; nan if still in contact."""
        moved = self._relative(Displacement, name, run)[-1]
        speed = self._relative(Velocity, name, run)[-1]
        if self.each == 1:
            ago = moved[0] / speed[0]
        else:
            reach = self.sphere.radius + self.partner.radius
            beyond = 2.0 * reach * moved[0] + moved @ moved  # of the squared distance
            rate = (reach * NORMAL + moved) @ speed
            ago = beyond / (rate + math.sqrt(max(rate**2 - speed @ speed * beyond, 0.0)))
        return float(run.times[-1] - ago) if ago > 0 else math.nan

    def error(self, name: str, run: Run, choice: Choice = OURS) -> float:
        """The error of the velocity after an impact, over the speed before it."""
        due = self.after(name, choice)
        off = self.seen_after(name, run) - [due.normal, due.tangential]
        return float(np.linalg.norm(off)) / self.blows[name].speed

    def worst(self, judge: Exact) -> Scalar:
        """The largest error of all impacts."""
        return Scalar(
            "worst", "max|e|", "", "largest error of a velocity after impact, over the speed "
            "before",
            lambda run: max(self.error(name, run) for name in self.blows), 0.0, 1.0, judge,
        )  # fmt: skip

    def nearest(self, judge: Exact) -> Scalar:
        """The largest error with the best-fitting of the laws in which codes differ."""
        return Scalar(
            "nearest", "min max|e|", "",
            "the same with the closest of the laws that codes have: arms of R - U/2, or on a wall "
            "R - U, or R - U for slip and R - U/2 for torque; shear by increments, or by a spring "
            "of the current stiffness", self._nearest, 0.0, 1.0, judge,
        )  # fmt: skip

    def _laws(self) -> Iterator[Choice]:
        """The laws in which codes differ: in arms on a wall alone.

        Between spheres arms of R - U would leave a gap between the surfaces where they touch.
        """
        if self.slips_in_part:
            return iter((OURS,))
        arms = ARMS if self.partner.is_wall else ARMS[:1]
        return itertools.product(arms, SPRINGS if self.contact.hertz else SPRINGS[:1])

    def _nearest(self, run: Run) -> float:
        return least_of_largest(
            (self.error(name, run, law) for name in self.blows) for law in self._laws()
        )

    def lasting(self, judge: Exact) -> Scalar:
        """The largest relative error of the time at which an overlap ends."""

        def errors(run: Run, law: Choice) -> Iterator[float]:
            for name in self.blows:
                yield abs(self.parting(name, run) / self.after(name, law).cleared - 1.0)

        return Scalar(
            "lasting", "max|tc/tc* - 1|", "",
            "largest relative error of the time at which an overlap ends, with the closest of "
            "these laws",
            lambda run: least_of_largest(errors(run, law) for law in self._laws()), 0.0, 1.0, judge,
        )  # fmt: skip

    def longest(self) -> float:
        """The time at which the last overlap ends [s], of the slowest impact along the normal.

        Motion across the normal changes it in second order of U/R.
        """
        law, slowest = self.law, min(blow.vn for blow in self.blows.values())
        if law.z:
            frictionless = replace(law, mu=0.0)
            return rebound(frictionless, self.sphere, partner=self.partner, vn=slowest).cleared
        if law.p == 1.0:
            return math.pi * math.sqrt(self.reduced / law.K)
        return hertz.contact_time(m=self.reduced, K=law.K, v=slowest)


def least_of_largest(rows: Iterable[Iterable[float]]) -> float:
    """The least of the largest numbers of rows; nan if a number is.

    A row is abandoned at a number that is larger than the largest of another: each is computed on
    demand, and costs an integration.
    """
    least = math.inf
    for row in rows:
        largest = -math.inf
        for number in row:
            if math.isnan(number):
                return math.nan
            largest = max(largest, number)
            if largest >= least:
                break
        least = min(least, largest)
    return least


def judged(value: float, unit: float, steps: int, reason: str, late: float = 0.0) -> Exact:
    """The bounds at `steps` steps in contacts that last for about a `unit` [s].

    late: the effect of viscous forces that are half a step late, at a step of a unit.
    """
    dt = unit / steps
    why = f"{reason}. The floor is the effect of arms that differ in second order of U/R"
    step = Tolerance(value, why, dt=dt, order=2, floor=FLOOR)
    behind = Tolerance(
        (LEAST + late) / steps,
        "a viscous force that is half a step late acts as if the mass were smaller by a fraction z "
        "w dt. That changes normal speeds by up to pi z^2, and the limit of friction by up to pi "
        "z, times half of the fraction; a contact that begins without the force loses a fraction z "
        "w dt of the speed, pi z over the steps. At least half of the bound of elastic forces at "
        "the coarsest step is allowed",
        dt=dt, order=1,
    )  # fmt: skip
    return Exact({Method.SECOND_ORDER: step, Method.FIRST_ORDER: behind})


def at_angles(speed: float, degrees: Iterator[float]) -> dict[str, Blow]:
    """Impacts of one speed [m/s] at angles from the normal, by the name of the angle."""
    turned = ((angle, math.radians(angle)) for angle in degrees)
    return {
        f"{angle:g}": Blow(speed * math.cos(way), speed * math.sin(way)) for angle, way in turned
    }
