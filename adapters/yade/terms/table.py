"""The table of the functions that translate terms for YADE: a new term adds one line."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from adapters.yade.given import Given, bare
from adapters.yade.setup import Setup
from adapters.yade.terms.bonds import bonds, sheared_bonds
from adapters.yade.terms.contact import charged, friction, viscosity, viscous_friction
from adapters.yade.terms.drives import moving_walls, pulsed, shaken
from adapters.yade.terms.forces import carried, dead_loads, drag, gravity, oblique_locks
from adapters.yade.terms.hertz import elastic, viscous
from adapters.yade.terms.walls import walls
from vv.scene import Term


def in_every_plan(given: Given, setup: Setup) -> Given:
    """Adds nothing: the term is part of the input of every scene of spheres, or of every block."""
    return given


TRANSLATIONS: Mapping[Term, Callable[[Given, Setup], Given]] = {
    Term.SPHERE: in_every_plan,
    Term.SPHERE_CONTACT: in_every_plan,
    Term.ROTATION: in_every_plan,
    Term.BLOCK: in_every_plan,
    Term.GRAVITY: gravity,
    Term.LOAD: dead_loads,
    Term.FRICTION: friction,
    Term.BOND: bonds,
    Term.CARRIED: carried,
    Term.BOND_SHEAR: sheared_bonds,
    Term.BREAKAGE: in_every_plan,
    Term.CONTACT_VISCOSITY: viscosity,
    Term.HERTZ: elastic,
    Term.HERTZ_VISCOSITY: viscous,
    Term.VISCOUS_FRICTION: viscous_friction,
    Term.DRAG: drag,
    Term.WALL_CONTACT: walls,
    Term.OBLIQUE_LOCK: oblique_locks,
    Term.RIGID_CONTACT: charged,
    Term.SHAKING: shaken,
    Term.PULSE: pulsed,
    Term.BASE_MOTION: moving_walls,
}
"""In this order: forces are summed, and notes stand, as they come."""


def translated(setup: Setup) -> Given:
    """The YADE input for the spheres and walls of a setup, term by term."""
    given = bare(setup)
    for term, translation in TRANSLATIONS.items():
        if term in setup.terms:
            given = translation(given, setup)
    return given
