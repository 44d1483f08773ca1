"""Lists the terms that the exact engine models on each kind of contact, and refuses others."""

from __future__ import annotations

import numpy as np

from vv.engines.exact.reachability import MOST_SPHERES, RefusedError
from vv.scene import Scene, Term

ON_ANY_CONTACT = {
    Term.SPHERE,
    Term.WALL_CONTACT,
    Term.FRICTION,
    Term.GRAVITY,
    Term.LOAD,
    Term.OBLIQUE_LOCK,
}
CONTACT = {Term.SPHERE_CONTACT, Term.WALL_CONTACT, Term.CONTACT_VISCOSITY}
SPRINGS = frozenset(ON_ANY_CONTACT | CONTACT | {Term.DRAG})
BONDS = (SPRINGS | {Term.BOND, Term.BOND_SHEAR}) - CONTACT
RIGID = frozenset(ON_ANY_CONTACT | {Term.RIGID_CONTACT, Term.BLOCK, Term.SHAKING, Term.BASE_MOTION})
TERMS = SPRINGS | BONDS | RIGID


def check_terms(scene: Scene) -> None:
    """Raise RefusedError for a term that is not modelled with the scene's kind of contact."""
    modelled, contact = (RIGID, "rigid contact") if scene.contact.rigid else (SPRINGS, "springs")
    if scene.bonds is not None:
        modelled, contact = BONDS, "bonds"
    for lacking in sorted(scene.terms() - modelled, key=lambda term: term.value):
        where = f" on {contact}" if lacking in TERMS else ""
        raise RefusedError(f"{lacking.value} is not modelled{where}")


def check_spheres(scene: Scene) -> None:
    """Raise RefusedError for more than MOST_SPHERES spheres, and for spheres that spin."""
    spheres = scene.spheres
    if len(spheres) > MOST_SPHERES:
        raise RefusedError(
            f"the scene has {len(spheres)} spheres; at most {MOST_SPHERES} are solved"
        )
    for i in np.flatnonzero(spheres.spin.any(axis=1))[:1]:
        raise RefusedError(f"sphere {i} spins; rotation is not modelled")


def count_in_words(number: int, noun: str) -> str:
    """A number with its noun, in the plural unless it is 1: `3 contacts`."""
    return f"{number} {noun}{'' if number == 1 else 's'}"
