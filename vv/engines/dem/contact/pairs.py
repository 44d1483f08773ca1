"""Contacts between spheres: their kinematics and forces, inlined into kernels."""

from __future__ import annotations

import math

from vv.engines.dem.contact.law import Law, friction_force, normal_force, spheres_rotate
from vv.engines.dem.contact.touch import Touch, reduced_mass
from vv.engines.dem.rows import Index
from vv.engines.dem.space.bodies import Motion
from vv.engines.kernels.compiled import inlined
from vv.engines.kernels.triples import NOWHERE, Triple, add_scaled, at, cross, dot, put
from vv.scene import Vector

Pairs = tuple[Index, Vector, Vector, Vector]
"""Rows (p, 2); offset (p, 3) from the first centre to the second and gap (p,) at t = 0 [m]; radii
(p, 2) [m]."""


@inlined
def clear_rows(kept: Vector) -> None:
    """Set the stored numbers (k, columns) of all contacts to zero."""
    for k in range(len(kept)):
        for c in range(kept.shape[1]):
            kept[k, c] = 0.0


@inlined
def pair_overlap(u: Vector, pairs: Pairs, p: int) -> tuple[float, Triple, float]:
    """The overlap of pair p [m], the vector between the centres, and its length; u: displacements.

    The gap is its value at t = 0 plus a change that is computed without cancellation, so that its
    relative accuracy is that of the displacements.
    """
    rows, offset, gap, radius = pairs
    start = at(offset, p)
    moved = add_scaled(at(u, rows[p, 1]), -1.0, at(u, rows[p, 0]))
    d = add_scaled(start, 1.0, moved)
    length = math.sqrt(dot(d, d))
    length_start = gap[p] + radius[p, 0] + radius[p, 1]
    overlap = -gap[p] - dot(moved, add_scaled(start, 1.0, d)) / (length_start + length)
    return overlap, d, length


@inlined
def normals_in_step(
    d: Triple, length: float, relative: Triple, dt: float
) -> tuple[Triple, Triple, float]:
    """The normals at the beginning and in the middle of a step, and how much the gap grew [m]."""
    back = add_scaled(d, -dt, relative)
    length_back = math.sqrt(dot(back, back))
    n_before = add_scaled(NOWHERE, 1.0 / length_back, back)
    both = add_scaled(n_before, 1.0 / length, d)
    opened = dt * dot(relative, add_scaled(d, 1.0, back)) / (length + length_back)
    return n_before, add_scaled(NOWHERE, 1.0 / math.sqrt(dot(both, both)), both), opened


@inlined
def pair_touch(
    motion: Motion,
    w: Vector | None,
    spun: Vector | None,
    turns: bool,
    pairs: Pairs,
    p: int,
    now: tuple[float, Triple, float],
    n: Triple,
    dt: float,
) -> Touch:
    """The kinematics of closed pair p in a step; now: see `pair_overlap`; n: normal at its end."""
    (overlap, d, length), v, before = now, motion.v, motion.before
    i, j = pairs[0][p, 0], pairs[0][p, 1]
    relative = add_scaled(at(v, j), -1.0, at(v, i))
    changed = add_scaled(relative, -1.0, add_scaled(at(before, j), -1.0, at(before, i)))
    n_before, m, opened = normals_in_step(d, length, relative, dt)
    rates = (
        dot(n_before, add_scaled(relative, -0.5, changed)),
        dot(n, add_scaled(relative, 0.5, changed)),
    )
    if w is not None and spun is not None:
        twist = 0.0
        if turns:
            # the contact point lies in the middle of the overlap, at the middle of the step
            inside = 0.5 * (overlap + 0.5 * opened)
            first, second = pairs[3][p, 0] - inside, pairs[3][p, 1] - inside
            rolled = add_scaled(add_scaled(NOWHERE, first, at(w, i)), second, at(w, j))
            rolled_before = add_scaled(add_scaled(NOWHERE, first, at(spun, i)), second, at(spun, j))
            relative = add_scaled(relative, -1.0, cross(rolled, m))
            changed = add_scaled(changed, -1.0, cross(add_scaled(rolled, -1.0, rolled_before), m))
            twist = 0.5 * dt * dot(add_scaled(at(w, i), 1.0, at(w, j)), m)
    else:
        twist = None
    return Touch(overlap, opened, n, n_before, m, rates, relative, changed, twist)


@inlined
def add_pair_torques(
    turn: Vector | None,
    turns: bool,
    pairs: Pairs,
    p: int,
    overlap: float,
    n: Triple,
    across: Triple,
) -> None:
    """Add the torques of the tangential force at pair p, if spheres rotate."""
    if turn is not None and turns:
        rows, _, _, radius = pairs
        i, j, torque = rows[p, 0], rows[p, 1], cross(across, n)
        put(turn, i, add_scaled(at(turn, i), radius[p, 0] - 0.5 * overlap, torque))
        put(turn, j, add_scaled(at(turn, j), radius[p, 1] - 0.5 * overlap, torque))


@inlined
def pair_forces(
    motion: Motion,
    mass: Vector,
    dt: float,
    pairs: Pairs,
    law: Law,
    at_run_time: int | None,
    shear: Vector,
) -> Triple:
    """Add the forces of all pairs; return energies [J]: normal and tangential springs, dissipation.

    mass: (m,) of the moving spheres; at_run_time: see `law.py`; shear: (p, columns) numbers stored
    from step to step, the tangential force on the second sphere [N] first.
    """
    if at_run_time is not None and law.friction[1] == 0.0:
        return add_pair_forces(motion, mass, dt, pairs, law, None, False, shear)
    turns = spheres_rotate(motion.turn, at_run_time)
    return add_pair_forces(motion, mass, dt, pairs, law, law.friction, turns, shear)


@inlined
def add_pair_forces(
    motion: Motion,
    mass: Vector,
    dt: float,
    pairs: Pairs,
    law: Law,
    friction: tuple[float, float] | None,
    turns: bool,
    shear: Vector,
) -> Triple:
    """As `pair_forces`, with friction either that of the law or None."""
    rows, _, _, radius = pairs
    push, normal, sprung, lost = motion.push, 0.0, 0.0, 0.0
    for p in range(len(rows)):
        i, j = rows[p, 0], rows[p, 1]
        now = pair_overlap(motion.u, pairs, p)
        overlap, d, length = now
        if overlap <= 0.0:
            if friction is not None:
                put(shear, p, NOWHERE)
            continue
        n = add_scaled(NOWHERE, 1.0 / length, d)
        reduced = radius[p, 0] * radius[p, 1] / (radius[p, 0] + radius[p, 1])
        along, held = normal_force(law, overlap, reduced)
        force = add_scaled(NOWHERE, along, n)
        normal += held
        if friction is not None:
            touch = pair_touch(motion, motion.w, motion.spun, turns, pairs, p, now, n, dt)
            both = reduced_mass(mass, i, j)
            across, charged, taken = friction_force(law, touch, reduced, both, shear, p, dt)
            lost += taken
            sprung += charged
            put(shear, p, across)
            force = add_scaled(force, 1.0, across)
            add_pair_torques(motion.turn, turns, pairs, p, overlap, n, across)
        put(push, i, add_scaled(at(push, i), -1.0, force))
        put(push, j, add_scaled(at(push, j), 1.0, force))
    return normal, sprung, lost
