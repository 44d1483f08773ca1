"""The term for contacts of spheres with walls."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vv.engines.dem.contact.law import Law, has_friction
from vv.engines.dem.contact.pairs import clear_rows
from vv.engines.dem.contact.walls import Moving, Walls, clear_wall_forces, wall_forces
from vv.engines.dem.rows import Index
from vv.engines.dem.space.bodies import Bodies, Motion
from vv.engines.dem.space.neighbours import Slots
from vv.engines.dem.space.placed import Placed
from vv.engines.dem.space.springs import Springs, springs_of_contacts
from vv.engines.kernels.compiled import inlined
from vv.engines.kernels.triples import at, put
from vv.scene import Mask, Term, Vector

STANDS_FOR = frozenset({Term.WALL_CONTACT, Term.FRICTION, Term.MICRO_SLIP})


class WallContacts(NamedTuple):
    """Walls and their law: see `wall_forces`; shear: (q, columns) numbers stored between steps.

    charged: (q, 3) the tangential forces at t = 0 [N]; (0, 3) if they are zero. moving: None if no
    wall moves.
    """

    walls: Walls
    law: Law
    moving: Moving | None
    charged: Vector
    shear: Vector


def build(placed: Placed) -> WallContacts | None:
    """The contacts with all walls, possibly without any wall; None if nothing can touch."""
    walls, charged, law = listed(placed), placed.charged, placed.law
    if walls is None:
        return None
    moving, q = wall_rows(placed), len(walls[0])
    if charged is None or not (has_friction(law) and charged.any()):
        charged = np.zeros((0, 3))
    shear = np.zeros((q if has_friction(law) else 0, law.columns))
    return WallContacts(walls, law, moving, charged, shear)


def listed(placed: Placed) -> Walls | None:
    """All pairs of a moving sphere and a wall: rows, normals, gaps at t = 0, radii."""
    scene, moves = placed.scene, placed.moves
    if not placed.may_touch or (scene.bonds is not None and not scene.walls):
        return None
    position, radius = scene.spheres.position[moves], scene.spheres.radius[moves]
    gaps = [(position - wall.point) @ wall.normal - radius for wall in scene.walls]
    normals = np.array([wall.normal for wall in scene.walls]).reshape(-1, 3)
    normals, gap = np.repeat(normals, len(radius), axis=0), np.concatenate([[], *gaps])
    count = len(scene.walls)
    return np.tile(placed.row[moves], count), normals, gap, np.tile(radius, count)


def wall_rows(placed: Placed) -> Moving | None:
    """The rows of the walls in `listed`, and storage for their forces; None if no wall moves."""
    if not placed.walls_move:
        return None
    m, count = int(placed.moves.sum()), len(placed.scene.walls)
    # the rows of walls follow those of the spheres and of the ground
    return np.repeat(m + 1 + np.arange(count), m), np.zeros((m * count, 3))


def models(term: WallContacts) -> frozenset[Term]:
    """The terms of the scene that this models."""
    return STANDS_FOR if has_friction(term.law) else frozenset({Term.WALL_CONTACT})


def turns(term: WallContacts) -> bool:
    """Whether the contacts may rotate spheres."""
    return has_friction(term.law)


def springs(term: WallContacts, near: object) -> tuple[Springs, Mask]:
    """The springs of all contacts, with walls as ground, and which are in contact at t = 0."""
    rows, normal, gap, radius = term.walls
    return springs_of_contacts(rows, normal, gap, radius, *term.law.stiffness)


@inlined
def begin(term: WallContacts, bodies: Bodies, motion: Motion) -> None:
    """Set the tangential forces to those at t = 0."""
    clear_rows(term.shear)
    set_initial_shear(term.shear, term.charged)
    clear_wall_forces(term.moving)


@inlined
def set_initial_shear(shear: Vector, charged: Vector) -> None:
    """Set the stored tangential forces to those at t = 0."""
    for q in range(len(charged)):
        put(shear, q, at(charged, q))


@inlined
def force(
    term: WallContacts, bodies: Bodies, motion: Motion, dt: float, slots: Slots, many: Index
) -> tuple[float, float, float, float]:
    """Add the forces of walls on spheres; return energies [J] as `hooks.force` does."""
    law = term.law
    return wall_forces(
        motion, bodies.mass, dt, term.walls, law, law.at_run_time, term.shear, term.moving
    )
