"""Tiny scenes with answers known by heart, which `vv check` asks of a code.

A scene for each term that shows in how a body moves, where that is known by heart; what a scheme
declares, it is asked.
"""

from __future__ import annotations

from collections.abc import Callable

from vv.ask import Displacement, Velocity
from vv.codes.adapter import Scheme
from vv.codes.greetings import blocks, bonds, contacts, flights, rubbing
from vv.codes.greetings.greeting import STEPS, Greeting, Terms, error, likeness
from vv.scene import Term

__all__ = ["STEPS", "Greeting", "error", "greetings", "likeness", "unasked"]

OFFERED: tuple[Callable[[Terms], Greeting], ...] = (
    flights.flight, flights.laden, contacts.bounce, contacts.collision, flights.lock,
    flights.oblique, flights.carried, flights.drag, flights.fluid, flights.shaken, flights.pulse,
    contacts.moving_wall, contacts.dashpot, contacts.hertz, contacts.viscous_hertz,
    rubbing.skid, rubbing.roll, rubbing.viscous_skid,
    bonds.pulled, bonds.sheared, bonds.broken,
    blocks.flight, blocks.laden, blocks.slide,
)  # fmt: skip


def greetings(scheme: Scheme) -> list[Greeting]:
    """The tiny scenes that a scheme declares it can solve."""
    if not {Displacement, Velocity} & scheme.observables:
        return []
    offered = (make(scheme.terms) for make in OFFERED)
    return [one for one in offered if one.scene.terms() <= scheme.terms]


def unasked(scheme: Scheme) -> frozenset[Term]:
    """The terms that a scheme declares and no tiny scene asks of it."""
    return scheme.terms.difference(*(one.scene.terms() for one in greetings(scheme)))
