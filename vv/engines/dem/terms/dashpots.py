"""Contacts that are viscous along their normal and never pull, inlined into the kernel of space.

Their forces act on the mean of the velocities before and after, which they change themselves:
those of all contacts are found together, by sweeps over one contact after the other.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vv.engines.dem.contact.law import Law, damped, pressed
from vv.engines.dem.contact.pairs import Pairs, apart
from vv.engines.dem.contact.touch import reduced_mass
from vv.engines.dem.contact.walls import Moving, Walls, into_wall
from vv.engines.dem.rows import Index
from vv.engines.dem.space.advance import carried_on, held
from vv.engines.dem.space.bodies import Bodies, Motion
from vv.engines.dem.space.ledger import column
from vv.engines.dem.space.neighbours import MET, OVERLAP, Slots
from vv.engines.dem.space.placed import Placed
from vv.engines.dem.terms import pair_contacts, wall_contacts
from vv.engines.dem.terms.drag import Drag
from vv.engines.kernels.compiled import inlined
from vv.engines.kernels.triples import NOWHERE, Triple, add_scaled, at, dot, put
from vv.scene import Form, Term, Vector

STANDS_FOR = frozenset({Term.CONTACT_VISCOSITY, Term.HERTZ_VISCOSITY, Term.VISCOUS_FRICTION})
WALLS = column(Form.WALLS)

SWEEPS = 1000  # at most; 1 + eta_n dt/2 B M^-1 B^T, of condition 2 at most, takes some tens
SETTLED = 1e-15  # of the largest force: how little a last sweep changes
SPRING, RATE, FORCE = 3, 4, 5  # columns after those of the normal
EARLIER, BEHIND, AHEAD, WORK = 0, 1, 2, 3  # places in what is kept of moving walls

Met = tuple[Index, Vector]
"""All contacts that may be: the rows (k, 2) of what meets, the first pushed against the normal;
(k, 7) normal, push of the spring [N], coefficient [N s/m], viscous force [N], overlap [m]."""


class Dashpots(NamedTuple):
    """The contacts that are viscous, and their law.

    met: all listed contacts; those that are gathered have it in their slots. near: None if none
    are gathered. new: room for
    velocities, a row for each of `Motion.v`. moving: how walls move, or None; done (4,): the power
    [W] that walls which move had after the last step, have before and after now, and their work
    since t = 0 [J].
    """

    pairs: Pairs | None
    walls: Walls | None
    law: Law
    met: Met
    near: int | None
    new: Vector
    moving: Moving | None
    done: Vector


def build(placed: Placed) -> Dashpots | None:
    """The dashpots of a scene whose contacts are viscous."""
    scene, m = placed.scene, int(placed.moves.sum())
    pairs, walls = pair_contacts.listed(placed), wall_contacts.listed(placed)
    if not scene.contact.viscous or (pairs is None and walls is None and placed.near is None):
        return None
    ends = [np.zeros((0, 2), np.intp)] if pairs is None else [pairs[0]]
    moving = wall_contacts.moved(placed)
    if walls is not None:  # a wall is the first of two, in a row of its own or of the ground
        first = np.full_like(walls[0], m) if moving is None else moving[0]
        ends.append(np.stack([first, walls[0]], axis=1))
    both = np.concatenate(ends)
    met = both, np.zeros((len(both), MET))
    new = np.zeros((m + 1 + (0 if moving is None else len(scene.walls)), 3))
    near = None if placed.near is None else len(placed.near.radius)
    return Dashpots(pairs, walls, placed.law, met, near, new, moving, np.zeros(4))


def models(term: Dashpots) -> frozenset[Term]:
    """What it models of a scene."""
    return STANDS_FOR


@inlined
def begin(term: Dashpots, bodies: Bodies, motion: Motion) -> None:
    """No contact met as yet; what touches at t = 0 did so before."""
    kept = term.met[1]
    for k in range(len(kept)):
        for c in range(OVERLAP):
            kept[k, c] = 0.0
        kept[k, OVERLAP] = np.inf
    for c in range(len(term.done)):
        term.done[c] = 0.0


@inlined
def start(term: Dashpots, bodies: Bodies, motion: Motion, dt: float) -> None:
    """The velocities at t = 0."""
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
    """The forces of all dashpots."""
    meet(term.met, motion.u, term.pairs, term.walls, term.moving, term.law, bodies.mass)
    foresee(term.new, motion, len(bodies.mass) + 1)
    taken = slow_all(term, term.near, bodies, motion, dt, slots, many, drag, lag)
    carry(term, term.moving, motion.v, len(bodies.mass))
    return taken


@inlined
def slow_all(
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
    """Add the forces of listed contacts, and of gathered ones if there are any; see `slow`."""
    new, mass, hold = term.new, bodies.mass, bodies.hold
    if near is None:
        return slow((term.met, None), motion.push, motion.v, new, mass, hold, dt, drag, lag)
    pairs = slots.rows[: many[0]], slots.offset, slots.gap, slots.radii
    meet((slots.rows, slots.met), motion.u, pairs, None, None, term.law, mass)
    mets = term.met, (slots.rows[: many[0]], slots.met)
    return slow(mets, motion.push, motion.v, new, mass, hold, dt, drag, lag)


@inlined
def foresee(new: Vector, motion: Motion, first: int) -> None:
    """The velocities of moving walls in the next step, as the two before lead to."""
    for r in range(first, len(new)):
        put(
            new,
            r,
            add_scaled(add_scaled(NOWHERE, 2.0, at(motion.v, r)), -1.0, at(motion.before, r)),
        )


@inlined
def carry(term: Dashpots, moving: Moving | None, v: Vector, ground: int) -> None:
    """Note the powers [W] of moving walls before and after now, and what the one after was."""
    if moving is not None:
        ends, kept = term.met
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
    """The work of moving walls in a step, by the trapezoidal rule."""
    worked(term.done, term.moving, dt)


@inlined
def worked(done: Vector, moving: Moving | None, dt: float) -> None:
    """Add the work of a step, if any wall moves."""
    if moving is not None:
        done[WORK] += 0.5 * dt * (done[EARLIER] + done[BEHIND])


@inlined
def book(term: Dashpots, bodies: Bodies, motion: Motion, energy: Vector, row: int) -> tuple[float]:
    """Add it to what walls did by springs."""
    if energy.shape[1] > WALLS:
        energy[row, WALLS] += term.done[WORK]
    return (term.done[WORK],)


@inlined
def withdraw(term: Dashpots, bodies: Bodies, motion: Motion, slots: Slots, many: Index) -> None:
    """Take them away again."""
    shove(term.met, motion.push, -1.0)
    withdraw_gathered(term.near, motion.push, slots, many)


@inlined
def withdraw_gathered(near: int | None, push: Vector, slots: Slots, many: Index) -> None:
    """Take the forces of gathered contacts away, if there are any."""
    if near is not None:
        shove((slots.rows[: many[0]], slots.met), push, -1.0)


@inlined
def meet(
    met: Met,
    u: Vector,
    pairs: Pairs | None,
    walls: Walls | None,
    moving: Moving | None,
    law: Law,
    mass: Vector,
) -> None:
    """Bring all contacts to the displacements u (rows, 3) [m]."""
    k = 0
    if pairs is not None:
        for p in range(len(pairs[0])):
            overlap, d, length = apart(u, pairs, p)
            reduced = 1.0 / (1.0 / pairs[3][p, 0] + 1.0 / pairs[3][p, 1])
            close(met, k, add_scaled(NOWHERE, 1.0 / length, d), overlap, reduced, law, mass)
            k += 1
    if walls is not None:
        for q in range(len(walls[0])):
            overlap = into_wall(u, walls, moving, q)
            close(met, k, at(walls[1], q), overlap, walls[3][q], law, mass)
            k += 1


@inlined
def close(
    met: Met, k: int, n: Triple, overlap: float, radius: float, law: Law, mass: Vector
) -> None:
    """Bring contact k to an overlap [m]; radius: 1/(1/r1 + 1/r2) [m]."""
    ends, kept = met
    before = kept[k, OVERLAP]
    put(kept, k, n)
    if overlap > 0.0:
        reduced = reduced_mass(mass, ends[k, 0], ends[k, 1])
        kept[k, SPRING] = pressed(law, overlap, radius)[0]
        kept[k, RATE] = damped(law, before, overlap, radius, reduced)
    else:
        kept[k, SPRING] = kept[k, RATE] = 0.0
    kept[k, OVERLAP] = overlap


@inlined
def slow(
    mets: tuple[Met, Met | None],
    push: Vector,
    v: Vector,
    new: Vector,
    mass: Vector,
    hold: Vector | None,
    dt: float,
    drag: Drag | None,
    lag: float,
) -> tuple[float, float]:
    """Add the viscous forces of all contacts to push (m + 1, 3) [N].

    F = max(-kn U, eta_n (lag a- + (1 - lag) a+)), a the rate of approach; new (m + 1, 3) becomes
    the velocities after. Returns the powers [W] that it takes before and after now.
    """
    for i in range(len(mass)):
        free = held(at(push, i), hold, i)
        put(new, i, carried_on(at(v, i), free, mass[i], dt, drag, lag, i))
    forget(mets[0])
    forget(mets[1])
    extra = 0.0
    if drag is not None:
        extra = (1.0 - lag) * drag.eta * dt
    for _ in range(SWEEPS):
        reached = settle_all(mets[0], (0.0, 0.0), v, new, mass, hold, dt, extra, lag)
        most, change = settle_all(mets[1], reached, v, new, mass, hold, dt, extra, lag)
        if change <= SETTLED * most:
            break
    taken = powers(mets[1], powers(mets[0], (0.0, 0.0), v, new), v, new)
    shove(mets[0], push, 1.0)
    shove(mets[1], push, 1.0)
    return taken


@inlined
def forget(met: Met | None) -> None:
    """No viscous force in any contact."""
    if met is not None:
        for k in range(len(met[0])):
            met[1][k, FORCE] = 0.0


@inlined
def settle_all(
    met: Met | None,
    reached: tuple[float, float],
    v: Vector,
    new: Vector,
    mass: Vector,
    hold: Vector | None,
    dt: float,
    extra: float,
    lag: float,
) -> tuple[float, float]:
    """One sweep over contacts; returns the largest force and change [N], with those before."""
    if met is None:
        return reached
    ends, kept = met
    most, change = reached
    for k in range(len(ends)):
        if kept[k, RATE] > 0.0:
            force = settled(met, k, v, new, mass, hold, dt, extra, lag)
            change = max(change, abs(force - kept[k, FORCE]))
            most = max(most, abs(force))
            kept[k, FORCE] = force
    return most, change


@inlined
def powers(
    met: Met | None, before: tuple[float, float], v: Vector, new: Vector
) -> tuple[float, float]:
    """What contacts take [W] before and after now, added to what others do."""
    if met is None:
        return before
    ends, kept = met
    behind, ahead = before
    for k in range(len(ends)):
        n, i, j = at(kept, k), ends[k, 0], ends[k, 1]
        behind += kept[k, FORCE] * dot(n, add_scaled(at(v, i), -1.0, at(v, j)))
        ahead += kept[k, FORCE] * dot(n, add_scaled(at(new, i), -1.0, at(new, j)))
    return behind, ahead


@inlined
def settled(
    met: Met,
    k: int,
    v: Vector,
    new: Vector,
    mass: Vector,
    hold: Vector | None,
    dt: float,
    extra: float,
    lag: float,
) -> float:
    """The force [N] of contact k that holds as the others are; new is brought to it."""
    ends, kept = met
    n, i, j = at(kept, k), ends[k, 0], ends[k, 1]
    first, second = NOWHERE, NOWHERE
    if i < len(mass):
        first = add_scaled(NOWHERE, dt / (mass[i] + extra), held(n, hold, i))
    if j < len(mass):
        second = add_scaled(NOWHERE, dt / (mass[j] + extra), held(n, hold, j))
    went = dot(n, add_scaled(at(v, i), -1.0, at(v, j)))
    goes = dot(n, add_scaled(at(new, i), -1.0, at(new, j)))
    rate = kept[k, RATE]
    wanted = rate * (lag * went + (1.0 - lag) * goes)
    by = (wanted - kept[k, FORCE]) / (
        1.0 + (1.0 - lag) * rate * dot(n, add_scaled(first, 1.0, second))
    )
    by = max(by, -kept[k, SPRING] - kept[k, FORCE])
    put(new, i, add_scaled(at(new, i), -by, first))
    put(new, j, add_scaled(at(new, j), by, second))
    return float(kept[k, FORCE] + by)


@inlined
def shove(met: Met | None, push: Vector, sign: float) -> None:
    """Add the forces of all contacts to push, or take them away."""
    if met is None:
        return
    ends, kept = met
    for k in range(len(ends)):
        force, j = add_scaled(NOWHERE, sign * kept[k, FORCE], at(kept, k)), ends[k, 1]
        i = min(ends[k, 0], len(push) - 1)  # what pushes a wall that moves is not kept
        put(push, i, add_scaled(at(push, i), -1.0, force))
        put(push, j, add_scaled(at(push, j), 1.0, force))
