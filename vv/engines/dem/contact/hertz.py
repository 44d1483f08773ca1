"""Contact of elastic spheres: Hertz along the normal, Mindlin without micro-slip across it.

It may also be viscous along the normal, by the law of Tsuji, Tanaka and Ishida (1992).
"""

from __future__ import annotations

import math
from typing import NamedTuple

from vv.engines.dem.contact.friction import shear_force
from vv.engines.dem.contact.touch import Touch
from vv.engines.kernels.compiled import inlined
from vv.engines.kernels.triples import Triple, at, dot
from vv.scene import Hertz, Scene, Vector

DEEP = 1.2  # factor on the overlap that stores all energy of t = 0: loads add energy
TOUCHES = 1e-6  # relative to the approach in a step: smaller overlaps are rounding


class Elastic(NamedTuple):
    """The parameters of elastic contact.

    modulus: effective modulus [Pa]; friction: effective shear modulus [Pa] and mu, or None;
    damping: z in the viscous force 2 z sqrt(m kn) U', or None; stiffness: kn and ks [N/m] at the
    deepest overlap that the energy at t = 0 can cause; at_run_time: see `law.py`.
    """

    modulus: float
    friction: tuple[float, float] | None
    damping: float | None
    stiffness: tuple[float, float]
    at_run_time: int | None = None

    @property
    def columns(self) -> int:
        """The count of numbers stored per contact: the tangential force [N] has three."""
        return 3


def elastic_law(scene: Scene, law: Hertz, rubs: bool) -> Elastic:
    """The contact law of a scene of elastic spheres."""
    friction = (law.shear_modulus, scene.contact.mu) if rubs else None
    spheres = scene.spheres
    energy = 0.5 * float(spheres.mass @ (spheres.velocity**2).sum(axis=1))
    energy += 0.5 * float(spheres.inertia @ (spheres.spin**2).sum(axis=1))
    radius = float(spheres.radius.max())
    held = 8.0 / 15.0 * law.modulus * math.sqrt(radius)  # J/m^2.5
    root = math.sqrt(DEEP * radius * (energy / held) ** 0.4)
    damping = law.damping if law.damping > 0.0 else None
    stiffness = 2.0 * law.modulus * root, 8.0 * law.shear_modulus * root
    return Elastic(law.modulus, friction, damping, stiffness)


@inlined
def normal_force(law: Elastic, overlap: float, radius: float) -> tuple[float, float]:
    """The normal force 4/3 E sqrt(R) U^(3/2) [N], and the elastic energy, 2/5 of it times U [J]."""
    push = 4.0 / 3.0 * law.modulus * overlap * math.sqrt(radius * overlap)
    return push, 0.4 * push * overlap


@inlined
def damping_at(law: Elastic, before: float, overlap: float, radius: float, mass: float) -> float:
    """2 z sqrt(m kn) [N s/m], kn = 2 E sqrt(R U), corrected in the step in which a contact closes.

    With s the part of the step after the closing, the sum over steps of (s + k)^q, k = 0, 1, ...,
    misses the integral of t^q by zeta(-q, s), an error of order 1 + q in dt. The coefficient of the
    first step compensates for it. Here q = 1/4, since U grows linearly at first.
    """
    part, way = 1.0, overlap - before
    if before <= TOUCHES * way:
        since = min(overlap / way, 1.0)
        part = first_step_factor(since) / math.sqrt(math.sqrt(since))
    return part * viscosity(law.modulus, law.damping, overlap, radius, mass)


@inlined
def viscosity(
    modulus: float, damping: float | None, overlap: float, radius: float, mass: float
) -> float:
    """The damping coefficient 2 z sqrt(m kn) [N s/m]; 0 without damping."""
    if damping is not None:
        return 2.0 * damping * math.sqrt(mass * 2.0 * modulus * math.sqrt(radius * overlap))
    return 0.0


@inlined
def first_step_factor(since: float) -> float:
    """s^q - zeta(-q, s) for q = 1/4 and s in (0, 1], by Euler and Maclaurin's formula, to 1e-5."""
    far = since + 2.0
    root = math.sqrt(math.sqrt(far))
    near = math.sqrt(math.sqrt(since + 1.0))
    late = root / far / 48.0 - 7.0 / 15360.0 * root / far**3
    return 0.8 * far * root - 0.5 * root - near + late


@inlined
def shear_stiffness(
    law: Elastic, touch: Touch, radius: float, mass: float, spring: Triple
) -> tuple[float, tuple[float, float]]:
    """The mean tangential stiffness 8 G sqrt(R U) [N/m] over a step, and the limits mu Fn [N].

    The mean is over the part of the step in which the contact was closed, with U linear in time.
    The stiffness at the end of the step would make the force first order in dt.
    """
    (shear, mu), overlap = law.friction, touch.overlap  # type: ignore[misc]  # has friction
    before = max(overlap + touch.opened, 0.0)
    now, then = math.sqrt(overlap), math.sqrt(before)
    mean = 2.0 / 3.0 * (overlap + now * then + before) / (now + then)
    caps = friction_limits(law, mu, touch, radius, mass, spring)
    return 8.0 * shear * math.sqrt(radius) * mean, caps


@inlined
def shear_energy(law: Elastic, overlap: float, radius: float, force: Triple) -> float:
    """The elastic energy of the tangential spring [J]: F^2/(2 ks) with ks = 8 G sqrt(R U).

    This is not recoverable as a whole: it grows when a contact opens under a constant force.
    """
    shear = law.friction[0]  # type: ignore[index]  # as above
    return 0.5 * dot(force, force) / (8.0 * shear * math.sqrt(radius) * math.sqrt(overlap))


@inlined
def friction_force(
    law: Elastic, touch: Touch, radius: float, mass: float, kept: Vector, row: int, dt: float
) -> tuple[Triple, float, float]:
    """The tangential force [N] of a spring stretched by the slide, at most mu Fn; see `law.py`."""
    spring = at(kept, row)
    ks, caps = shear_stiffness(law, touch, radius, mass, spring)
    force, taken = shear_force(spring, touch, ks, caps, dt)
    return force, shear_energy(law, touch.overlap, radius, force), taken


@inlined
def friction_limits(
    law: Elastic, mu: float, touch: Touch, radius: float, mass: float, spring: Triple
) -> tuple[float, float]:
    """The limits of friction [N] before and after a step, viscous normal forces included.

    As in `linear.py`.
    """
    overlap = touch.overlap
    before = max(overlap + touch.opened, 0.0)
    first, last = normal_force(law, before, radius)[0], normal_force(law, overlap, radius)[0]
    behind, ahead = viscous_forces(law.modulus, law.damping, touch, before, radius, mass)
    old = math.sqrt(dot(spring, spring)) if law.damping is not None else 0.0
    return max(mu * (first - behind), old), max(mu * (last - ahead), 0.0)


@inlined
def viscous_forces(
    modulus: float, damping: float | None, touch: Touch, before: float, radius: float, mass: float
) -> tuple[float, float]:
    """The viscous part [N] of the normal force before and after a step, as it limits friction."""
    old = viscosity(modulus, damping, before, radius, mass) * touch.rates[0]
    return old, viscosity(modulus, damping, touch.overlap, radius, mass) * touch.rates[1]
