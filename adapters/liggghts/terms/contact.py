"""Translates friction, damping and the initial shear forces of contacts for LIGGGHTS."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from adapters.liggghts.sections import Deck
from adapters.liggghts.setup import Setup
from adapters.liggghts.words import group, parts

UNCOUNTED, COUNTED = "charging shear springs", "shear springs are charged"


def friction(deck: Deck, setup: Setup) -> Deck:
    """A shear spring ks [N/m], limited by Coulomb friction."""
    contact = setup.scene.contact
    springs = {**deck.law.properties, "kt": contact.ks, "coefficientFriction": contact.mu}
    law = replace(deck.law, properties=springs, tangential="history")
    note = "shear springs of model history, without tangential damping"
    return replace(deck, law=law).with_more(notes=[note])


def viscosity(deck: Deck, setup: Setup) -> Deck:
    """A viscous contact has its coefficient [N s/m] as a parameter, and exerts no tension."""
    properties = {
        {"gamman": "gamman_abs", "gammat": "gammat_abs"}.get(name, name): value
        for name, value in deck.law.properties.items()
    }
    properties["gamman_abs"] = setup.scene.contact.eta_n
    law = replace(
        deck.law,
        properties=properties,
        damping=f"{deck.law.damping} absolute_damping on limitForce on",
        note="pair gran, hooke/stiffness with absolute damping from the velocity half a step ago, "
        "whose force never pulls",
    )
    return replace(deck, law=law)


def charged(deck: Deck, setup: Setup) -> Deck:
    """Shear springs that start with the friction of the rigid contact that they represent."""
    if not setup.slides:
        return deck
    note = (
        "shear springs charged by a step before t = 0, in which the sphere slides to its position"
    )
    return deck.with_more(charging=_charging(setup), notes=[note])


def _charging(setup: Setup) -> Iterator[str]:
    """A step before t = 0 in which spheres slide to their initial positions, with walls at rest.

    It gives shear springs their force at t = 0, for which there is no command.
    """
    yield f'print "{UNCOUNTED}"'
    yield group("slid", list(setup.slides))
    for i, way in setup.slides.items():
        yield f"set             atom {i + 1} {parts('v', (way / setup.ask.dt).tolist())}"
    yield "fix slid slid nve/noforce"
    yield "run             1"
    yield "unfix slid"
    yield "group slid delete"
    for i in setup.slides:
        yield f"set             atom {i + 1} {parts('v', setup.spheres.velocity[i].tolist())}"
    yield "reset_timestep  0"
    yield f'print "{COUNTED}"'
