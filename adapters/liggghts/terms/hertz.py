"""Puts contact of elastic spheres to LIGGGHTS: moduli as the factors of its Hertz law."""

from __future__ import annotations

from dataclasses import replace

from adapters.liggghts.sections import Deck
from adapters.liggghts.setup import Setup

NOTE = "pair gran, hertz/stiffness: kn and kt are 4/3 E and 8 G, times sqrt(R U); nothing is damped"
HELD = "its shear force is all of the slip times today's stiffness, where increments are asked for"


def elastic(deck: Deck, setup: Setup) -> Deck:
    """Effective moduli in place of springs, which the term of friction has put already."""
    contact = setup.scene.contact
    if contact.hertz is None:
        return deck
    moduli = {"kn": 4.0 / 3.0 * contact.hertz.modulus, "kt": 8.0 * contact.hertz.shear_modulus}
    law = replace(
        deck.law, style="hertz/stiffness", properties={**deck.law.properties, **moduli}, note=NOTE
    )
    return replace(deck, law=law).with_more(notes=[HELD] if contact.carries_shear else [])
