"""States which terms are modelled on which contact, and refuses scenes that have others."""

from __future__ import annotations

import numpy as np

from vv.engines.exact.reachability import LARGEST, RefusedError
from vv.scene import Scene, Term

EITHER = {
    Term.SPHERE,
    Term.WALL_CONTACT,
    Term.FRICTION,
    Term.GRAVITY,
    Term.LOAD,
    Term.OBLIQUE_LOCK,
}
CONTACT = {Term.SPHERE_CONTACT, Term.WALL_CONTACT, Term.CONTACT_VISCOSITY}
SPRINGS = frozenset(EITHER | CONTACT | {Term.DRAG})
BONDS = (SPRINGS | {Term.BOND, Term.BOND_SHEAR}) - CONTACT
RIGID = frozenset(EITHER | {Term.RIGID_CONTACT, Term.BLOCK, Term.SHAKING, Term.BASE_MOTION})
TERMS = SPRINGS | BONDS | RIGID


def check_terms(scene: Scene) -> None:
    """Refuse a scene with a term that is not modelled on its kind of contact, or on bonds."""
    modelled, contact = (RIGID, "rigid contact") if scene.contact.rigid else (SPRINGS, "springs")
    if scene.bonds is not None:
        modelled, contact = BONDS, "bonds"
    for lacking in sorted(scene.terms() - modelled, key=lambda term: term.value):
        where = f" on {contact}" if lacking in TERMS else ""
        raise RefusedError(f"{lacking.value} is not modelled{where}")


def check_spheres(scene: Scene) -> None:
    """Refuse too many spheres, and spin."""
    spheres = scene.spheres
    if len(spheres) > LARGEST:
        raise RefusedError(f"the scene has {len(spheres)} spheres; at most {LARGEST} are solved")
    for i in np.flatnonzero(spheres.spin.any(axis=1))[:1]:
        raise RefusedError(f"sphere {i} spins; spin is not modelled")


def counted(number: int, noun: str) -> str:
    """A number of things in words."""
    return f"{number} {noun}{'' if number == 1 else 's'}"
