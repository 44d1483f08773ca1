"""The table of the functions that translate terms for LIGGGHTS: a new term adds one line."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from adapters.liggghts.atoms import bare
from adapters.liggghts.sections import Deck
from adapters.liggghts.setup import Setup
from adapters.liggghts.terms.bodies import block
from adapters.liggghts.terms.bonds import harmonic
from adapters.liggghts.terms.contact import charged, friction, viscosity
from adapters.liggghts.terms.drives import moving_walls, shaken
from adapters.liggghts.terms.forces import dead_loads, drag, gravity, oblique_locks
from adapters.liggghts.terms.hertz import elastic, viscous
from adapters.liggghts.terms.walls import walls
from vv.scene import Term


def in_every_deck(deck: Deck, setup: Setup) -> Deck:
    """Adds nothing, since `atoms.bare` writes the term for any scene of spheres."""
    return deck


TRANSLATIONS: Mapping[Term, Callable[[Deck, Setup], Deck]] = {
    Term.SPHERE: in_every_deck,
    Term.SPHERE_CONTACT: in_every_deck,
    Term.ROTATION: in_every_deck,
    Term.BLOCK: block,
    Term.FRICTION: friction,
    Term.CONTACT_VISCOSITY: viscosity,
    Term.HERTZ: elastic,
    Term.HERTZ_VISCOSITY: viscous,
    Term.VISCOUS_FRICTION: in_every_deck,
    Term.DRAG: drag,
    Term.GRAVITY: gravity,
    Term.LOAD: dead_loads,
    Term.WALL_CONTACT: walls,
    Term.OBLIQUE_LOCK: oblique_locks,
    Term.BOND: harmonic,
    Term.BOND_SHEAR: in_every_deck,
    Term.RIGID_CONTACT: charged,
    Term.SHAKING: shaken,
    Term.PULSE: in_every_deck,
    Term.BASE_MOTION: moving_walls,
}
"""In this order: forces are added, and notes stand, as they come; walls want the whole law."""


def translated(setup: Setup) -> Deck:
    """The sections of the deck of a setup, term by term."""
    deck, present = bare(setup), setup.terms | setup.scene.terms()
    for term, translation in TRANSLATIONS.items():
        if term in present:
            deck = translation(deck, setup)
    return deck
