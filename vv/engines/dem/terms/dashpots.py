"""The term for contacts that are viscous along their normal and never pull.

Their forces are computed in `vv.engines.dem.contact.dashpots`; here are the hooks of the general
model, and the work of moving walls.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vv.engines.dem.contact.dashpots import (
    FORCE,
    ViscousContacts,
    add_viscous_forces,
    apply_forces,
    update_contacts,
)
from vv.engines.dem.contact.law import Law
from vv.engines.dem.contact.pairs import Pairs
from vv.engines.dem.contact.walls import Moving, Walls
from vv.engines.dem.rows import Index
from vv.engines.dem.space.bodies import Bodies, Motion
from vv.engines.dem.space.ledger import column
from vv.engines.dem.space.neighbours import DASHPOT_COLUMNS, OVERLAP, Slots
from vv.engines.dem.space.placed import Placed
from vv.engines.dem.terms import pair_contacts, wall_contacts
from vv.engines.dem.terms.drag import Drag
from vv.engines.kernels.compiled import inlined
from vv.engines.kernels.triples import NOWHERE, add_scaled, at, dot, put
from vv.scene import Form, Term, Vector

STANDS_FOR = frozenset({Term.CONTACT_VISCOSITY, Term.HERTZ_VISCOSITY, Term.VISCOUS_FRICTION})
WALLS = column(Form.WALLS)

EARLIER, BEHIND, AHEAD, WORK = 0, 1, 2, 3  # places in the array of stored powers and work


class Dashpots(NamedTuple):
    """The viscous contacts of a scene and their law.

    contacts: the contacts that are listed once; those found by the neighbour search are in the
    slots, and near is None if there is no search. new: storage for velocities, a row for each of
    `Motion.v`. moving: see `wall_contacts.moved`; done (4,): the powers [W] of moving walls after
    the previous step, and before and after the present kick, and their work since t = 0 [J].
    """

    pairs: Pairs | None
    walls: Walls | None
    law: Law
    contacts: ViscousContacts
    near: int | None
    new: Vector
    moving: Moving | None
    done: Vector


def build(placed: Placed) -> Dashpots | None:
    """The dashpots of a scene with viscous contacts."""
    scene, m = placed.scene, int(placed.moves.sum())
    pairs, walls = pair_contacts.listed(placed), wall_contacts.listed(placed)
    if not scene.contact.viscous or (pairs is None and walls is None and placed.near is None):
        return None
    ends = [np.zeros((0, 2), np.intp)] if pairs is None else [pairs[0]]
    moving = wall_contacts.wall_rows(placed)
    if walls is not None:  # the wall is the first body, in a row of its own or the ground's
        first = np.full_like(walls[0], m) if moving is None else moving[0]
        ends.append(np.stack([first, walls[0]], axis=1))
    both = np.concatenate(ends)
    contacts = both, np.zeros((len(both), DASHPOT_COLUMNS))
    new = np.zeros((m + 1 + (0 if moving is None else len(scene.walls)), 3))
    near = None if placed.near is None else len(placed.near.radius)
    return Dashpots(pairs, walls, placed.law, contacts, near, new, moving, np.zeros(4))


def models(term: Dashpots) -> frozenset[Term]:
    """The terms of the scene that this models."""
    return STANDS_FOR


@inlined
def begin(term: Dashpots, bodies: Bodies, motion: Motion) -> None:
    """Clear all contacts; those that are closed at t = 0 count as closed for long."""
    kept = term.contacts[1]
    for k in range(len(kept)):
        for c in range(OVERLAP):
            kept[k, c] = 0.0
        kept[k, OVERLAP] = np.inf
    for c in range(len(term.done)):
        term.done[c] = 0.0


@inlined
def start(term: Dashpots, bodies: Bodies, motion: Motion, dt: float) -> None:
    """Set the velocities to those at t = 0."""
    for i in range(len(bodies.mass)):
        put(motion.v, i, at(bodies.velocity, i))


@inlined
def viscous(
    term: Dashpots,
    bodies: Bodies,
    motion: Motion,
    dt: float,
    slots: Slots,
    many: Index,
    drag: Drag | None,
    lag: float,
) -> tuple[float, float]:
    """Add the forces of all dashpots; return the powers [W] before and after the kick."""
    update_contacts(
        term.contacts, motion.u, term.pairs, term.walls, term.moving, term.law, bodies.mass
    )
    extrapolate_walls(term.new, motion, len(bodies.mass) + 1)
    taken = add_all_forces(term, term.near, bodies, motion, dt, slots, many, drag, lag)
    note_wall_powers(term, term.moving, motion.v, len(bodies.mass))
    return taken


@inlined
def add_all_forces(
    term: Dashpots,
    near: int | None,
    bodies: Bodies,
    motion: Motion,
    dt: float,
    slots: Slots,
    many: Index,
    drag: Drag | None,
    lag: float,
) -> tuple[float, float]:
    """Add the forces of listed contacts, and of those in slots if there is a neighbour search."""
    new, mass, hold = term.new, bodies.mass, bodies.hold
    if near is None:
        return add_viscous_forces(
            (term.contacts, None), motion.push, motion.v, new, mass, hold, dt, drag, lag
        )
    pairs = slots.rows[: many[0]], slots.offset, slots.gap, slots.radii
    update_contacts((slots.rows, slots.dashpots), motion.u, pairs, None, None, term.law, mass)
    groups = term.contacts, (slots.rows[: many[0]], slots.dashpots)
    return add_viscous_forces(groups, motion.push, motion.v, new, mass, hold, dt, drag, lag)


@inlined
def extrapolate_walls(new: Vector, motion: Motion, first: int) -> None:
    """Set the velocities of moving walls in the next step, extrapolated from those of two steps."""
    for r in range(first, len(new)):
        put(
            new,
            r,
            add_scaled(add_scaled(NOWHERE, 2.0, at(motion.v, r)), -1.0, at(motion.before, r)),
        )


@inlined
def note_wall_powers(term: Dashpots, moving: Moving | None, v: Vector, ground: int) -> None:
    """Store the powers [W] of moving walls before and after this kick, and after the last one."""
    if moving is not None:
        ends, kept = term.contacts
        behind = ahead = 0.0
        for k in range(len(ends)):
            if ends[k, 0] > ground:
                force = add_scaled(NOWHERE, kept[k, FORCE], at(kept, k))
                behind += dot(force, at(v, ends[k, 0]))
                ahead += dot(force, at(term.new, ends[k, 0]))
        term.done[EARLIER] = term.done[AHEAD]
        term.done[BEHIND], term.done[AHEAD] = behind, ahead


@inlined
def after(term: Dashpots, bodies: Bodies, motion: Motion, dt: float) -> None:
    """Add the work of moving walls in a step, by the trapezoidal rule."""
    add_wall_work(term.done, term.moving, dt)


@inlined
def add_wall_work(done: Vector, moving: Moving | None, dt: float) -> None:
    """As `after`, if any wall moves."""
    if moving is not None:
        done[WORK] += 0.5 * dt * (done[EARLIER] + done[BEHIND])


@inlined
def book(term: Dashpots, bodies: Bodies, motion: Motion, energy: Vector, row: int) -> tuple[float]:
    """Add the work since t = 0 to that which walls do through springs."""
    if energy.shape[1] > WALLS:
        energy[row, WALLS] += term.done[WORK]
    return (term.done[WORK],)


@inlined
def withdraw(term: Dashpots, bodies: Bodies, motion: Motion, slots: Slots, many: Index) -> None:
    """Subtract the forces again."""
    apply_forces(term.contacts, motion.push, -1.0)
    withdraw_near(term.near, motion.push, slots, many)


@inlined
def withdraw_near(near: int | None, push: Vector, slots: Slots, many: Index) -> None:
    """Subtract the forces of contacts in slots, if there are any."""
    if near is not None:
        apply_forces((slots.rows[: many[0]], slots.dashpots), push, -1.0)
