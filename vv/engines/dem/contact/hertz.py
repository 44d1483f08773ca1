"""Contact of elastic spheres: Hertz along the normal, Mindlin without micro-slip across it."""

from __future__ import annotations

import math
from typing import NamedTuple

from vv.engines.dem.contact.friction import sheared, slid
from vv.engines.dem.contact.touch import Touch
from vv.engines.kernels.compiled import inlined
from vv.engines.kernels.triples import Triple, dot
from vv.scene import Hertz, Scene

DEEP = 1.2  # times the overlap that would hold all energy at t = 0: room for what loads add


class Elastic(NamedTuple):
    """Effective modulus [Pa]; friction: effective shear modulus [Pa] and mu, or None.

    stiffness: kn and ks [N/m] of the deepest contact that the energy at t = 0 can make.
    """

    modulus: float
    friction: tuple[float, float] | None
    stiffness: tuple[float, float]


def elastic(scene: Scene, law: Hertz, rubs: bool) -> Elastic:
    """The law of a scene whose contacts are those of elastic spheres."""
    friction = (law.shear_modulus, scene.contact.mu) if rubs else None
    spheres = scene.spheres
    energy = 0.5 * float(spheres.mass @ (spheres.velocity**2).sum(axis=1))
    energy += 0.5 * float(spheres.inertia @ (spheres.spin**2).sum(axis=1))
    radius = float(spheres.radius.max())
    held = 8.0 / 15.0 * law.modulus * math.sqrt(radius)  # J/m^2.5
    root = math.sqrt(DEEP * radius * (energy / held) ** 0.4)
    return Elastic(
        law.modulus, friction, (2.0 * law.modulus * root, 8.0 * law.shear_modulus * root)
    )


@inlined
def pressed(law: Elastic, overlap: float, radius: float) -> tuple[float, float]:
    """4/3 E sqrt(R) U^(3/2), and 2/5 of that times U."""
    push = 4.0 / 3.0 * law.modulus * overlap * math.sqrt(radius * overlap)
    return push, 0.4 * push * overlap


@inlined
def rubbed(
    law: Elastic, touch: Touch, radius: float, spring: Triple, dt: float
) -> tuple[Triple, float, float]:
    """The force charged by the slide times 8 G sqrt(R U), up to mu Fn.

    The stiffness is the mean of the step, or of the part of it in which surfaces touched, as the
    overlap changes evenly: that at the end would make the force first order in dt. What a spring
    of today's stiffness would hold is no energy that can be had back, as it grows when a contact
    opens under a force that stays.
    """
    (shear, mu), overlap = law.friction, touch.overlap  # type: ignore[misc]  # asked where it rubs
    before = max(overlap + touch.opened, 0.0)
    now, then = math.sqrt(overlap), math.sqrt(before)
    mean = 2.0 / 3.0 * (overlap + now * then + before) / (now + then)
    stiff = 8.0 * shear * math.sqrt(radius)
    slide, change = slid(touch, dt)
    caps = mu * pressed(law, before, radius)[0], mu * pressed(law, overlap, radius)[0]
    force, taken = sheared(spring, touch, slide, change, stiff * mean, caps)
    return force, 0.5 * dot(force, force) / (stiff * now), taken
