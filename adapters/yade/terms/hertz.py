"""Translates contact of elastic spheres for YADE: materials that give its Mindlin law."""

from __future__ import annotations

import math

from adapters.yade.given import Given
from adapters.yade.setup import Setup
from vv.scene import Hertz, Scene, Term, initial_normal_forces

NOTES = (
    "contacts by MindlinPhys, with a material that gives their moduli",
    "MindlinPhys gives a wall the radius of the sphere, and a facet twice that; their material is "
    "therefore stiffer, by the square roots of 2 and 3/2 in sum",
    "shear forces grow by increments; on a wall their arm is R - U",
)
DAMPED = (
    "viscous along normals by betan of MindlinPhys, from the velocity half a step ago; it never "
    "pulls, and friction is limited by all of the normal force"
)


def elastic(given: Given, setup: Setup) -> Given:
    """Young's modulus and Poisson's ratio of spheres, and Young's modulus of walls and facets.

    YADE takes 1/E and 1/G as sums over both bodies; the effective radius of a sphere and a wall is
    R/2 there, that of a sphere and a facet 2R/3.
    """
    law = setup.scene.contact.hertz
    if law is None:
        return given
    young, poisson = law.material()
    material = {
        "young": young,
        "poisson": poisson,
        "walls_young": young * _beside(math.sqrt(2.0)),
        "facets_young": young * _beside(math.sqrt(1.5)),
    }
    return given.with_more(*NOTES, hertz=material)


def _beside(times: float) -> float:
    """How much stiffer one of two equal bodies must be, for a contact so many times as stiff."""
    return times / (2.0 - times)


def viscous(given: Given, setup: Setup) -> Given:
    """A fraction of YADE's critical damping, 2 sqrt(m kn) with kn at the present overlap."""
    law = setup.scene.contact.hertz
    if law is None:
        return given
    material = {**given.numbers["hertz"], "damping": law.damping}
    return given.with_more(DAMPED, hertz=material)


def why_no_material(law: Hertz | None) -> str | None:
    """Why no material of YADE has these moduli; None if one has."""
    return None if law is None else law.why_no_material()


def why_not_viscous(scene: Scene) -> str | None:
    """Why YADE cannot represent viscous contacts of elastic spheres; else None."""
    if Term.HERTZ_VISCOSITY not in scene.terms():
        return None
    if initial_normal_forces(scene).any():
        return (
            "viscous elastic spheres overlap at t = 0, where YADE's first step would lack a force"
        )
    if not scene.spheres.free.any(axis=1).all():
        return (
            "a sphere cannot move; YADE would include its mass in the damping of a viscous contact"
        )
    return None
