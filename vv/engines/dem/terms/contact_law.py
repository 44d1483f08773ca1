"""The contact law, inlined into kernels: springs that turn with the contact, Coulomb friction."""

from __future__ import annotations

import math

from vv.engines.dem.rows import Index
from vv.engines.dem.terms.friction import share_closed, sheared
from vv.engines.kernels.compiled import inlined
from vv.engines.kernels.triples import NOWHERE, Triple, at, cross, dot, plus, put
from vv.scene import Vector

Pairs = tuple[Index, Vector, Vector, Vector]
Walls = tuple[Index, Vector, Vector, Vector]
Moving = tuple[Index, Vector]


@inlined
def emptied(shear: Vector) -> None:
    """No shear (k, 3) in any contact."""
    for k in range(len(shear)):
        put(shear, k, NOWHERE)


@inlined
def stilled(moving: Moving | None) -> None:
    """No force of a moving wall."""
    if moving is not None:
        emptied(moving[1])


@inlined
def last_step(
    d: Triple, length: float, relative: Triple, dt: float
) -> tuple[Triple, Triple, float]:
    """How a pair came to the offset d [m] in a step: normals before and midway, gap opened [m]."""
    back = plus(d, -dt, relative)
    length_back = math.sqrt(dot(back, back))
    n_before = plus(NOWHERE, 1.0 / length_back, back)
    both = plus(n_before, 1.0 / length, d)
    opened = dt * dot(relative, plus(d, 1.0, back)) / (length + length_back)
    return n_before, plus(NOWHERE, 1.0 / math.sqrt(dot(both, both)), both), opened


@inlined
def apart(u: Vector, pairs: Pairs, p: int) -> tuple[float, Triple, float]:
    """The overlap of pair p, its offset and the length of that [m], by displacements u [m]."""
    rows, offset, gap, radius = pairs
    start = at(offset, p)
    moved = plus(at(u, rows[p, 1]), -1.0, at(u, rows[p, 0]))
    d = plus(start, 1.0, moved)
    length = math.sqrt(dot(d, d))
    length_start = gap[p] + radius[p, 0] + radius[p, 1]
    overlap = -gap[p] - dot(moved, plus(start, 1.0, d)) / (length_start + length)
    return overlap, d, length


@inlined
def off_wall(u: Vector, walls: Walls, q: int) -> float:
    """The overlap [m] of a sphere with a wall at rest."""
    rows, facing, gap, _ = walls
    return float(-gap[q] - dot(at(facing, q), at(u, rows[q])))


@inlined
def pair_forces(
    push: Vector,
    turn: Vector | None,
    u: Vector,
    v: Vector,
    v_before: Vector,
    w: Vector | None,
    w_before: Vector | None,
    dt: float,
    pairs: Pairs,
    kn: float,
    friction: tuple[float, float] | None,
    shear: Vector,
) -> Triple:
    """Add the forces of pairs of spheres; return energies [J]: normal, shear, lost by friction.

    push, turn, u: (rows, 3) forces, torques, displacements; v, w: mean velocities and spins of
    the step that ended, v_before, w_before: of the one before it. pairs: rows (p, 2); offset
    (p, 3) from the first centre to the second and gap (p,) at t = 0; radii (p, 2). friction: ks
    [N/m] and mu. shear: (p, 3) force on the second sphere, kept from step to step. A gap is that
    at t = 0 and a change free of cancellation, so that it is as accurate as the displacements.
    """
    rows, _, _, radius = pairs
    normal = sprung = lost = 0.0
    for p in range(len(rows)):
        i, j = rows[p, 0], rows[p, 1]
        overlap, d, length = apart(u, pairs, p)
        if overlap <= 0.0:
            if friction is not None:
                put(shear, p, NOWHERE)
            continue
        n = plus(NOWHERE, 1.0 / length, d)
        force = plus(NOWHERE, kn * overlap, n)
        normal += 0.5 * kn * overlap * overlap
        if friction is not None:
            ks, mu = friction
            relative = plus(at(v, j), -1.0, at(v, i))
            changed = plus(relative, -1.0, plus(at(v_before, j), -1.0, at(v_before, i)))
            n_before, m, opened = last_step(d, length, relative, dt)
            if w is not None and w_before is not None:
                # the contact point lies in the middle of the overlap, at the middle of the step
                inside = 0.5 * (overlap + 0.5 * opened)
                first, second = radius[p, 0] - inside, radius[p, 1] - inside
                rolled = plus(plus(NOWHERE, first, at(w, i)), second, at(w, j))
                before = plus(plus(NOWHERE, first, at(w_before, i)), second, at(w_before, j))
                relative = plus(relative, -1.0, cross(rolled, m))
                changed = plus(changed, -1.0, cross(plus(rolled, -1.0, before), m))
                twist = 0.5 * dt * dot(plus(at(w, i), 1.0, at(w, j)), m)
            else:
                twist = None
            share = dt * share_closed(overlap, opened)
            slide = plus(NOWHERE, share, plus(relative, -dot(m, relative), m))
            change = plus(NOWHERE, share, plus(changed, -dot(m, changed), m))
            caps = mu * kn * (overlap + opened), mu * kn * overlap
            tangential, cut = sheared(at(shear, p), n, n_before, twist, slide, change, ks, caps)
            lost += cut
            sprung += 0.5 * dot(tangential, tangential) / ks
            put(shear, p, tangential)
            force = plus(force, 1.0, tangential)
            if turn is not None:
                torque = cross(tangential, n)
                put(turn, i, plus(at(turn, i), radius[p, 0] - 0.5 * overlap, torque))
                put(turn, j, plus(at(turn, j), radius[p, 1] - 0.5 * overlap, torque))
        put(push, i, plus(at(push, i), -1.0, force))
        put(push, j, plus(at(push, j), 1.0, force))
    return normal, sprung, lost


@inlined
def wall_forces(  # noqa: PLR0915 - one algorithm, a branch per term
    push: Vector,
    turn: Vector | None,
    u: Vector,
    v: Vector,
    v_before: Vector,
    w: Vector | None,
    w_before: Vector | None,
    dt: float,
    walls: Walls,
    kn: float,
    friction: tuple[float, float] | None,
    shear: Vector,
    moving: Moving | None,
) -> tuple[float, float, float, float]:
    """Add the forces of walls on spheres; return energies [J].

    walls: rows (q,) of the spheres; outward normals (q, 3); gap (q,) at t = 0; radii (q,).
    shear: (q, 3) force on the sphere. moving: where walls move, the rows (q,) of u and v that
    hold their motion, and the forces (q, 3) on the spheres, kept from step to step. All else is
    as in `pair_forces`. Energies: normal, shear, lost by friction, work of the walls.
    """
    rows, facing, _, radius = walls
    normal = sprung = lost = work = 0.0
    for q in range(len(rows)):
        i = rows[q]
        n = at(facing, q)
        overlap = off_wall(u, walls, q)
        if moving is not None:
            ground, acting = moving
            overlap += dot(n, at(u, ground[q]))
            travel = plus(NOWHERE, 0.5 * dt, at(v, ground[q]))
            work += dot(at(acting, q), travel)
            put(acting, q, NOWHERE)
        if overlap <= 0.0:
            if friction is not None:
                put(shear, q, NOWHERE)
            continue
        force = plus(NOWHERE, kn * overlap, n)
        normal += 0.5 * kn * overlap * overlap
        if friction is not None:
            ks, mu = friction
            relative = at(v, i)
            changed = plus(relative, -1.0, at(v_before, i))
            if moving is not None:
                relative = plus(relative, -1.0, at(v, ground[q]))
                changed = plus(changed, -1.0, at(v, ground[q]))
                changed = plus(changed, 1.0, at(v_before, ground[q]))
            opened = dt * dot(n, relative)
            if w is not None and w_before is not None:
                arm = 0.5 * (overlap + 0.5 * opened) - radius[q]
                spun = plus(at(w, i), -1.0, at(w_before, i))
                relative = plus(relative, arm, cross(at(w, i), n))
                changed = plus(changed, arm, cross(spun, n))
                twist = 0.5 * dt * dot(at(w, i), n)
            else:
                twist = None
            share = dt * share_closed(overlap, opened)
            slide = plus(NOWHERE, share, plus(relative, -dot(n, relative), n))
            change = plus(NOWHERE, share, plus(changed, -dot(n, changed), n))
            caps = mu * kn * (overlap + opened), mu * kn * overlap
            tangential, cut = sheared(at(shear, q), n, n, twist, slide, change, ks, caps)
            lost += cut
            sprung += 0.5 * dot(tangential, tangential) / ks
            put(shear, q, tangential)
            force = plus(force, 1.0, tangential)
            if turn is not None:
                arm = radius[q] - 0.5 * overlap
                put(turn, i, plus(at(turn, i), arm, cross(tangential, n)))
        if moving is not None:
            put(acting, q, force)
            work += dot(force, travel)
        put(push, i, plus(at(push, i), 1.0, force))
    return normal, sprung, lost, work
