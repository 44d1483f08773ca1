"""Translates contact of elastic spheres for LIGGGHTS: moduli as factors of its Hertz law."""

from __future__ import annotations

import math
from dataclasses import replace

from adapters.liggghts.sections import Deck
from adapters.liggghts.setup import Setup
from vv.scene import Scene, Term

NOTE = "pair gran, hertz/stiffness: kn and kt are 4/3 E and 8 G, times sqrt(R U); nothing is damped"
DAMPED = (
    "pair gran, hertz, with a material and a restitution that give the moduli and the damping; "
    "damping from the velocity half a step ago, a force that never pulls, and friction limited by "
    "all of the normal force"
)
LEAST = 0.05  # LIGGGHTS requires a larger coefficient of restitution
HELD = (
    "its shear force is the total slip times the present stiffness, where a sum of increments is "
    "needed"
)


def elastic(deck: Deck, setup: Setup) -> Deck:
    """Effective moduli in place of the spring stiffnesses that the term of friction has set."""
    contact = setup.scene.contact
    if contact.hertz is None:
        return deck
    moduli = {"kn": 4.0 / 3.0 * contact.hertz.modulus, "kt": 8.0 * contact.hertz.shear_modulus}
    law = replace(
        deck.law, style="hertz/stiffness", properties={**deck.law.properties, **moduli}, note=NOTE
    )
    return replace(deck, law=law).with_more(notes=[HELD] if contact.carries_shear else [])


def viscous(deck: Deck, setup: Setup) -> Deck:
    """The material and restitution from which LIGGGHTS derives effective moduli and damping."""
    law = setup.scene.contact.hertz
    if law is None:
        return deck
    young, poisson = law.material()
    pairs = {
        "coefficientRestitution": restitution(law.damping),
        "coefficientFriction": setup.scene.contact.mu,
    }
    damping = f"{deck.law.damping} limitForce on"
    new = replace(
        deck.law, style="hertz", properties=pairs, damping=damping, note=DAMPED,
        material={"youngsModulus": young, "poissonsRatio": poisson},
    )  # fmt: skip
    return replace(deck, law=new)


def restitution(damping: float) -> float:
    """The restitution e from which LIGGGHTS derives the damping 2 sqrt(5/6) b sqrt(m kn).

    b = -ln e/sqrt(ln^2 e + pi^2), for a contact that may pull. Raises ValueError for a damping that
    no e gives.
    """
    share = math.sqrt(1.2) * damping
    if not share < 1.0:
        raise ValueError(f"Hertz.damping = {damping!r}; it must be less than sqrt(5/6)")
    return math.exp(-math.pi * share / math.sqrt(1.0 - share**2))


def why_not_viscous(scene: Scene) -> str | None:
    """Why LIGGGHTS cannot represent viscous contacts of elastic spheres; else None."""
    law = scene.contact.hertz
    if law is None or Term.HERTZ_VISCOSITY not in scene.terms():
        return None
    if 1.2 * law.damping**2 >= 1.0 or restitution(law.damping) <= LEAST:
        return f"Hertz.damping = {law.damping:.6g}; LIGGGHTS accepts no restitution up to {LEAST}"
    if not scene.spheres.free.any(axis=1).all():
        return (
            "a sphere cannot move; LIGGGHTS would include its mass in the damping of a viscous "
            "contact"
        )
    if (reason := law.why_no_material()) is None and law.material()[1] < 0.0:
        return f"Poisson's ratio = {law.material()[1]:.6g}; LIGGGHTS accepts none below 0"
    return reason
