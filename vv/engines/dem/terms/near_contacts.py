"""Contacts between spheres, searched anew as spheres move (`vv.engines.dem.space.neighbours`)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vv.engines.dem.contact.law import Law, has_friction
from vv.engines.dem.contact.pairs import pair_forces
from vv.engines.dem.rows import Index
from vv.engines.dem.space.bodies import Bodies, Motion
from vv.engines.dem.space.neighbours import Near, Slots
from vv.engines.dem.space.placed import Placed
from vv.engines.dem.space.springs import TOUCHING, Springs, springs_of_contacts
from vv.engines.kernels.compiled import inlined
from vv.scene import Mask, Term

STANDS_FOR = frozenset({Term.SPHERE_CONTACT, Term.FRICTION})


class NearContacts(NamedTuple):
    """The contact law of pairs that are found by the neighbour search."""

    law: Law


def build(placed: Placed) -> NearContacts | None:
    """The term; None if the scene needs no neighbour search."""
    return NearContacts(placed.law) if placed.near else None


def models(term: NearContacts) -> frozenset[Term]:
    """The terms of the scene that this models."""
    return STANDS_FOR if has_friction(term.law) else frozenset({Term.SPHERE_CONTACT})


def turns(term: NearContacts) -> bool:
    """Whether the contacts may rotate spheres."""
    return has_friction(term.law)


def springs(term: NearContacts, near: Near) -> tuple[Springs, Mask]:
    """The springs of unbonded pairs near each other at t = 0, and which of them are in contact."""
    from scipy.spatial import cKDTree

    reach = 2.0 * float(near.radius.max()) + near.skin
    pairs = np.sort(cKDTree(near.position).query_pairs(reach, output_type="ndarray"), axis=1)
    n = len(near.radius)
    names = n * np.repeat(np.arange(n), np.diff(near.start)) + near.partner
    pairs = pairs[~np.isin(pairs @ np.array([n, 1]), names)]
    offset, radii = near.position[pairs[:, 1]] - near.position[pairs[:, 0]], near.radius[pairs]
    gap = np.linalg.norm(offset, axis=1) - radii.sum(axis=1)
    kept = gap / radii.min(axis=1) <= TOUCHING
    return springs_of_contacts(
        near.row[pairs[kept]], offset[kept], gap[kept], radii[kept], *term.law.stiffness
    )


def highest_square(term: NearContacts, near: Near, bodies: Bodies) -> float:
    """An upper bound of w^2 [1/s2] of a single contact between any two spheres; 0 without any."""
    n, still = len(near.radius), len(near.radius) - len(bodies.mass)
    if len(near.broken) == 0 and len(near.partner) == (n * (n - 1) - still * (still - 1)) // 2:
        return 0.0  # unbreakable bonds hold all pairs
    lightest = np.sort(1.0 / bodies.mass)[-2:].sum()
    across = 1.0 / bodies.mass
    if bodies.turns:
        radius = np.zeros(len(across) + 1)
        np.maximum.at(radius, np.minimum(near.row, len(across)), near.radius)
        across = across + radius[: len(across)] ** 2 / bodies.inertia
    kn, ks = term.law.stiffness
    return max(float(kn * lightest), float(ks * np.sort(across)[-2:].sum()))


@inlined
def force(
    term: NearContacts, bodies: Bodies, motion: Motion, dt: float, slots: Slots, many: Index
) -> tuple[float, float, float, float]:
    """Add the forces of all pairs that touch; return energies [J] as `hooks.force` does."""
    k, law = many[0], term.law
    pairs = slots.rows[:k], slots.offset[:k], slots.gap[:k], slots.radii[:k]
    normal, shear, lost = pair_forces(
        motion, bodies.mass, dt, pairs, law, law.at_run_time, slots.shear
    )
    return normal, shear, lost, 0.0
