"""Viscous normal forces of contacts that never pull; parts of kernels.

They depend on the mean of the velocities before and after the step, which they change themselves.
The forces of all contacts are therefore found together, by Gauss-Seidel sweeps over the contacts.
"""

from __future__ import annotations

from vv.engines.dem.contact.law import Law, damping_at, normal_force
from vv.engines.dem.contact.pairs import Pairs, pair_overlap
from vv.engines.dem.contact.touch import reduced_mass
from vv.engines.dem.contact.walls import Moving, Walls, wall_overlap
from vv.engines.dem.rows import Index
from vv.engines.dem.space.advance import free_part, next_velocity
from vv.engines.dem.space.neighbours import OVERLAP
from vv.engines.dem.terms.drag import Drag
from vv.engines.kernels.compiled import inlined
from vv.engines.kernels.triples import NOWHERE, Triple, add_scaled, at, dot, put
from vv.scene import Vector

SWEEPS = 1000  # at most; 1 + eta_n dt/2 B M^-1 B^T, whose condition is at most 2, takes some tens
SETTLED = 1e-15  # change of a last sweep, relative to the largest force
SPRING, RATE, FORCE = 3, 4, 5  # columns after those of the normal

ViscousContacts = tuple[Index, Vector]
"""Contacts that may be viscous: the rows (k, 2) of their bodies, the first of which is pushed
against the normal; (k, 7) normal, push of the spring [N], coefficient [N s/m], viscous force [N],
overlap [m]."""


@inlined
def update_contacts(
    contacts: ViscousContacts,
    u: Vector,
    pairs: Pairs | None,
    walls: Walls | None,
    moving: Moving | None,
    law: Law,
    mass: Vector,
) -> None:
    """Update all contacts to the displacements u (rows, 3) [m], with coefficients from the law."""
    k = 0
    if pairs is not None:
        for p in range(len(pairs[0])):
            overlap, d, length = pair_overlap(u, pairs, p)
            reduced = 1.0 / (1.0 / pairs[3][p, 0] + 1.0 / pairs[3][p, 1])
            update_contact(
                contacts, k, add_scaled(NOWHERE, 1.0 / length, d), overlap, reduced, law, mass
            )
            k += 1
    if walls is not None:
        for q in range(len(walls[0])):
            overlap = wall_overlap(u, walls, moving, q)
            update_contact(contacts, k, at(walls[1], q), overlap, walls[3][q], law, mass)
            k += 1


@inlined
def update_contact(
    contacts: ViscousContacts,
    k: int,
    n: Triple,
    overlap: float,
    radius: float,
    law: Law,
    mass: Vector,
) -> None:
    """Update contact k to a normal n and an overlap [m]; radius: 1/(1/r1 + 1/r2) [m]."""
    ends, kept = contacts
    before = kept[k, OVERLAP]
    put(kept, k, n)
    if overlap > 0.0:
        reduced = reduced_mass(mass, ends[k, 0], ends[k, 1])
        kept[k, SPRING] = normal_force(law, overlap, radius)[0]
        kept[k, RATE] = damping_at(law, before, overlap, radius, reduced)
    else:
        kept[k, SPRING] = kept[k, RATE] = 0.0
    kept[k, OVERLAP] = overlap


@inlined
def add_viscous_forces(
    groups: tuple[ViscousContacts, ViscousContacts | None],
    push: Vector,
    v: Vector,
    new: Vector,
    mass: Vector,
    hold: Vector | None,
    dt: float,
    drag: Drag | None,
    lag: float,
) -> tuple[float, float]:
    """Add the viscous forces of all contacts to push (m + 1, 3) [N]; return their powers [W].

    F = max(-kn U, eta_n (lag a- + (1 - lag) a+)), where a is the approach rate before (-) and after
    (+) the kick, and kn U the push of the spring. new (m + 1, 3) is set to the velocities after the
    kick. The powers are those at the velocities before and after.
    """
    for i in range(len(mass)):
        free = free_part(at(push, i), hold, i)
        put(new, i, next_velocity(at(v, i), free, mass[i], dt, drag, lag, i))
    clear_forces(groups[0])
    clear_forces(groups[1])
    extra = 0.0
    if drag is not None:
        extra = (1.0 - lag) * drag.eta * dt
    for _ in range(SWEEPS):
        reached = sweep(groups[0], (0.0, 0.0), v, new, mass, hold, dt, extra, lag)
        most, change = sweep(groups[1], reached, v, new, mass, hold, dt, extra, lag)
        if change <= SETTLED * most:
            break
    taken = dissipated(groups[1], dissipated(groups[0], (0.0, 0.0), v, new), v, new)
    apply_forces(groups[0], push, 1.0)
    apply_forces(groups[1], push, 1.0)
    return taken


@inlined
def clear_forces(contacts: ViscousContacts | None) -> None:
    """Set the viscous forces of all contacts to zero."""
    if contacts is not None:
        for k in range(len(contacts[0])):
            contacts[1][k, FORCE] = 0.0


@inlined
def sweep(
    contacts: ViscousContacts | None,
    reached: tuple[float, float],
    v: Vector,
    new: Vector,
    mass: Vector,
    hold: Vector | None,
    dt: float,
    extra: float,
    lag: float,
) -> tuple[float, float]:
    """Correct the force of each contact once; return the largest force and the largest change [N].

    reached: both values of the contacts that were swept before, included in the result.
    """
    if contacts is None:
        return reached
    ends, kept = contacts
    most, change = reached
    for k in range(len(ends)):
        if kept[k, RATE] > 0.0:
            force = corrected_force(contacts, k, v, new, mass, hold, dt, extra, lag)
            change = max(change, abs(force - kept[k, FORCE]))
            most = max(most, abs(force))
            kept[k, FORCE] = force
    return most, change


@inlined
def dissipated(
    contacts: ViscousContacts | None, before: tuple[float, float], v: Vector, new: Vector
) -> tuple[float, float]:
    """The powers [W] dissipated at the velocities before and after, plus those in `before`."""
    if contacts is None:
        return before
    ends, kept = contacts
    behind, ahead = before
    for k in range(len(ends)):
        n, i, j = at(kept, k), ends[k, 0], ends[k, 1]
        behind += kept[k, FORCE] * dot(n, add_scaled(at(v, i), -1.0, at(v, j)))
        ahead += kept[k, FORCE] * dot(n, add_scaled(at(new, i), -1.0, at(new, j)))
    return behind, ahead


@inlined
def corrected_force(
    contacts: ViscousContacts,
    k: int,
    v: Vector,
    new: Vector,
    mass: Vector,
    hold: Vector | None,
    dt: float,
    extra: float,
    lag: float,
) -> float:
    """The force [N] of contact k for the present forces of all others; new is updated with it."""
    ends, kept = contacts
    n, i, j = at(kept, k), ends[k, 0], ends[k, 1]
    first, second = NOWHERE, NOWHERE
    if i < len(mass):
        first = add_scaled(NOWHERE, dt / (mass[i] + extra), free_part(n, hold, i))
    if j < len(mass):
        second = add_scaled(NOWHERE, dt / (mass[j] + extra), free_part(n, hold, j))
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
def apply_forces(contacts: ViscousContacts | None, push: Vector, sign: float) -> None:
    """Add the forces of all contacts, times `sign`, to push."""
    if contacts is None:
        return
    ends, kept = contacts
    for k in range(len(ends)):
        force, j = add_scaled(NOWHERE, sign * kept[k, FORCE], at(kept, k)), ends[k, 1]
        i = min(ends[k, 0], len(push) - 1)  # forces on moving walls go to the ground's row
        put(push, i, add_scaled(at(push, i), -1.0, force))
        put(push, j, add_scaled(at(push, j), 1.0, force))
