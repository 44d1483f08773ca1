"""Contacts between spheres in scenes so small that all pairs are listed once."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vv.engines.dem.contact.law import Law, has_friction
from vv.engines.dem.contact.pairs import Pairs, clear_rows, pair_forces
from vv.engines.dem.rows import Index
from vv.engines.dem.space.bodies import Bodies, Motion
from vv.engines.dem.space.neighbours import Slots
from vv.engines.dem.space.placed import Placed
from vv.engines.dem.space.springs import Springs, springs_of_contacts
from vv.engines.kernels.compiled import inlined
from vv.scene import Mask, Term, Vector

STANDS_FOR = frozenset({Term.SPHERE_CONTACT, Term.FRICTION, Term.MICRO_SLIP})


class PairContacts(NamedTuple):
    """Pairs and their law: see `pair_forces`; shear: (p, columns) numbers stored between steps."""

    pairs: Pairs
    law: Law
    shear: Vector


def build(placed: Placed) -> PairContacts | None:
    """The contacts of all pairs; None if there are many spheres, or bonds, or nothing can touch."""
    pairs = listed(placed)
    if pairs is None:
        return None
    law = placed.law
    return PairContacts(
        pairs, law, np.zeros((len(pairs[0]) if has_friction(law) else 0, law.columns))
    )


def listed(placed: Placed) -> Pairs | None:
    """All pairs with at least one moving sphere: rows, offsets and gaps at t = 0, radii."""
    if placed.scene.bonds is not None or placed.near is not None or not placed.may_touch:
        return None
    spheres, moves, row = placed.scene.spheres, placed.moves, placed.row
    i, j = np.triu_indices(len(spheres), 1)
    kept = moves[i] | moves[j]
    i, j = i[kept], j[kept]
    offset = spheres.position[j] - spheres.position[i]
    radii = np.stack([spheres.radius[i], spheres.radius[j]], axis=1)
    gap = np.linalg.norm(offset, axis=1) - radii.sum(axis=1)
    return np.stack([row[i], row[j]], axis=1), offset, gap, radii


def models(term: PairContacts) -> frozenset[Term]:
    """The terms of the scene that this models."""
    return STANDS_FOR if has_friction(term.law) else frozenset({Term.SPHERE_CONTACT})


def turns(term: PairContacts) -> bool:
    """Whether the contacts may rotate spheres."""
    return has_friction(term.law)


def springs(term: PairContacts, near: object) -> tuple[Springs, Mask]:
    """The springs of all pairs, and which of them are in contact at t = 0."""
    rows, offset, gap, radii = term.pairs
    return springs_of_contacts(rows, offset, gap, radii, *term.law.stiffness)


@inlined
def begin(term: PairContacts, bodies: Bodies, motion: Motion) -> None:
    """Set the tangential forces to zero."""
    clear_rows(term.shear)


@inlined
def force(
    term: PairContacts, bodies: Bodies, motion: Motion, dt: float, slots: Slots, many: Index
) -> tuple[float, float, float, float]:
    """Add the forces of all pairs that touch; return energies [J] as `hooks.force` does."""
    law = term.law
    normal, shear, lost = pair_forces(
        motion, bodies.mass, dt, term.pairs, law, law.at_run_time, term.shear
    )
    return normal, shear, lost, 0.0
