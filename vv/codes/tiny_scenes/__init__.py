"""Tiny scenes with answers in closed form, which `vv check` asks of a code.

There is a scene for each term that affects the motion of a body. A scheme is tested with those
whose terms it declares.
"""

from __future__ import annotations

from collections.abc import Callable

from vv.ask import Displacement, Velocity
from vv.codes.adapter import Scheme
from vv.codes.tiny_scenes import blocks, bonds, contacts, flights, friction
from vv.codes.tiny_scenes.tiny_scene import STEPS, Terms, TinyScene, error, likeness
from vv.scene import Term

__all__ = ["STEPS", "TinyScene", "error", "likeness", "tiny_scenes", "unasked"]

OFFERED: tuple[Callable[[Terms], TinyScene], ...] = (
    flights.flight, flights.laden, contacts.bounce, contacts.collision, flights.lock,
    flights.oblique, flights.carried, flights.drag, flights.fluid, flights.shaken, flights.pulse,
    contacts.moving_wall, contacts.dashpot, contacts.hertz, contacts.viscous_hertz,
    friction.skid, friction.roll, friction.viscous_skid,
    bonds.pulled, bonds.sheared, bonds.broken,
    blocks.flight, blocks.laden, blocks.slide,
)  # fmt: skip


def tiny_scenes(scheme: Scheme) -> list[TinyScene]:
    """The tiny scenes that a scheme declares it can solve."""
    if not {Displacement, Velocity} & scheme.observables:
        return []
    offered = (make(scheme.terms) for make in OFFERED)
    return [one for one in offered if one.scene.terms() <= scheme.terms]


def unasked(scheme: Scheme) -> frozenset[Term]:
    """The terms that a scheme declares and that no tiny scene tests."""
    return scheme.terms.difference(*(one.scene.terms() for one in tiny_scenes(scheme)))
