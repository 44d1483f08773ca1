"""Contacts between spheres, of which all pairs are listed."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vv.engines.dem.contact.law import Law, rubs
from vv.engines.dem.contact.pairs import Pairs, emptied, pair_forces
from vv.engines.dem.rows import Index
from vv.engines.dem.space.bodies import Bodies, Motion
from vv.engines.dem.space.neighbours import Slots
from vv.engines.dem.space.placed import Placed
from vv.engines.dem.space.springs import Springs, springs_of_contacts
from vv.engines.kernels.compiled import inlined
from vv.scene import Mask, Term, Vector

STANDS_FOR = frozenset({Term.SPHERE_CONTACT, Term.FRICTION, Term.MICRO_SLIP})


class PairContacts(NamedTuple):
    """Pairs and their law: see `pair_forces`; shear: (p, columns) kept from step to step."""

    pairs: Pairs
    law: Law
    shear: Vector


def build(placed: Placed) -> PairContacts | None:
    """The contacts of all pairs, if spheres are few and without bonds; of one there are none."""
    pairs = listed(placed)
    if pairs is None:
        return None
    law = placed.law
    return PairContacts(pairs, law, np.zeros((len(pairs[0]) if rubs(law) else 0, law.columns)))


def listed(placed: Placed) -> Pairs | None:
    """All pairs of which one moves: rows, first offset, first gap, radii."""
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
    """What it models of a scene."""
    return STANDS_FOR if rubs(term.law) else frozenset({Term.SPHERE_CONTACT})


def turns(term: PairContacts) -> bool:
    """Whether it may turn spheres."""
    return rubs(term.law)


def springs(term: PairContacts, near: object) -> tuple[Springs, Mask]:
    """Its springs, and which are there at t = 0."""
    rows, offset, gap, radii = term.pairs
    return springs_of_contacts(rows, offset, gap, radii, *term.law.stiffness)


@inlined
def begin(term: PairContacts, bodies: Bodies, motion: Motion) -> None:
    """No shear."""
    emptied(term.shear)


@inlined
def force(
    term: PairContacts, bodies: Bodies, motion: Motion, dt: float, slots: Slots, many: Index
) -> tuple[float, float, float, float]:
    """The forces of all pairs."""
    law = term.law
    normal, shear, lost = pair_forces(
        motion, bodies.mass, dt, term.pairs, law, law.asked, term.shear
    )
    return normal, shear, lost, 0.0
