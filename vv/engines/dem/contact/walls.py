"""Contacts of spheres with walls: their kinematics and forces, inlined into kernels."""

from __future__ import annotations

from vv.engines.dem.contact.law import Law, friction_force, normal_force, spheres_rotate
from vv.engines.dem.contact.pairs import clear_rows
from vv.engines.dem.contact.touch import Touch
from vv.engines.dem.rows import Index
from vv.engines.dem.space.bodies import Motion
from vv.engines.kernels.compiled import inlined
from vv.engines.kernels.triples import NOWHERE, Triple, add_scaled, at, cross, dot, put
from vv.scene import Vector

Walls = tuple[Index, Vector, Vector, Vector]
"""Rows (q,) of the spheres; outward normals (q, 3); gap (q,) at t = 0 [m]; radii (q,) [m]."""
Moving = tuple[Index, Vector]
"""Rows (q,) of u and v that hold the walls' motion; stored forces (q, 3) on the spheres [N]."""


@inlined
def clear_wall_forces(moving: Moving | None) -> None:
    """Set the stored forces of moving walls to zero, if there are any."""
    if moving is not None:
        clear_rows(moving[1])


@inlined
def overlap_at_rest(u: Vector, walls: Walls, q: int) -> float:
    """The overlap [m] of a sphere with a wall, without the wall's displacement."""
    rows, facing, gap, _ = walls
    return float(-gap[q] - dot(at(facing, q), at(u, rows[q])))


@inlined
def wall_overlap(u: Vector, walls: Walls, moving: Moving | None, q: int) -> float:
    """The overlap [m] of a sphere with a wall at its present position."""
    overlap = overlap_at_rest(u, walls, q)
    if moving is not None:
        overlap += dot(at(walls[1], q), at(u, moving[0][q]))
    return overlap


@inlined
def wall_work(v: Vector, moving: Moving | None, q: int, dt: float) -> float:
    """The work [J] of a moving wall in half a step by its stored force; zero if no wall moves."""
    if moving is None:
        return 0.0
    grounds, acting = moving
    return float(dot(at(acting, q), add_scaled(NOWHERE, 0.5 * dt, at(v, grounds[q]))))


@inlined
def store_wall_force(moving: Moving | None, q: int, force: Triple) -> None:
    """Store the force of a wall on a sphere, if walls move."""
    if moving is not None:
        put(moving[1], q, force)


@inlined
def relative_motion(motion: Motion, i: int, moving: Moving | None, q: int) -> tuple[Triple, Triple]:
    """The velocity of sphere i relative to a wall [m/s], and its change since the last step."""
    v, before = motion.v, motion.before
    relative = at(v, i)
    changed = add_scaled(relative, -1.0, at(before, i))
    if moving is not None:
        ground = moving[0][q]
        relative = add_scaled(relative, -1.0, at(v, ground))
        changed = add_scaled(changed, -1.0, at(v, ground))
        changed = add_scaled(changed, 1.0, at(before, ground))
    return relative, changed


@inlined
def wall_touch(
    motion: Motion,
    w: Vector | None,
    spun: Vector | None,
    turns: bool,
    walls: Walls,
    moving: Moving | None,
    q: int,
    overlap: float,
    dt: float,
) -> Touch:
    """The kinematics of the closed contact q of a sphere with a wall in a step."""
    i, n, radius = walls[0][q], at(walls[1], q), walls[3][q]
    relative, changed = relative_motion(motion, i, moving, q)
    opened, more = dt * dot(n, relative), 0.5 * dot(n, changed)
    rates = dot(n, relative) - more, dot(n, relative) + more
    if w is not None and spun is not None:
        twist = 0.0
        if turns:
            arm = 0.5 * (overlap + 0.5 * opened) - radius
            relative = add_scaled(relative, arm, cross(at(w, i), n))
            changed = add_scaled(changed, arm, cross(add_scaled(at(w, i), -1.0, at(spun, i)), n))
            twist = 0.5 * dt * dot(at(w, i), n)
    else:
        twist = None
    return Touch(overlap, opened, n, n, n, rates, relative, changed, twist)


@inlined
def add_wall_torque(
    turn: Vector | None, turns: bool, walls: Walls, q: int, overlap: float, across: Triple
) -> None:
    """Add the torque of the tangential force at a wall, if spheres rotate."""
    if turn is not None and turns:
        i, arm = walls[0][q], walls[3][q] - 0.5 * overlap
        put(turn, i, add_scaled(at(turn, i), arm, cross(across, at(walls[1], q))))


@inlined
def wall_forces(
    motion: Motion,
    mass: Vector,
    dt: float,
    walls: Walls,
    law: Law,
    at_run_time: int | None,
    shear: Vector,
    moving: Moving | None,
) -> tuple[float, float, float, float]:
    """Add the forces of walls; return energies [J] as of `pair_forces`, and the work of the walls.

    mass: (m,) of the moving spheres; at_run_time: see `law.py`; shear: (q, columns) numbers stored
    from step to step, the tangential force on the sphere [N] first; moving: None if no wall moves.
    """
    if at_run_time is not None and law.friction[1] == 0.0:
        return add_wall_forces(motion, mass, dt, walls, law, None, False, shear, moving)
    turns = spheres_rotate(motion.turn, at_run_time)
    return add_wall_forces(motion, mass, dt, walls, law, law.friction, turns, shear, moving)


@inlined
def add_wall_forces(
    motion: Motion,
    mass: Vector,
    dt: float,
    walls: Walls,
    law: Law,
    friction: tuple[float, float] | None,
    turns: bool,
    shear: Vector,
    moving: Moving | None,
) -> tuple[float, float, float, float]:
    """As `wall_forces`, with friction either that of the law or None."""
    rows, facing, _, radius = walls
    push, normal, sprung, lost, work = motion.push, 0.0, 0.0, 0.0, 0.0
    for q in range(len(rows)):
        i, n = rows[q], at(facing, q)
        overlap = wall_overlap(motion.u, walls, moving, q)
        work += wall_work(motion.v, moving, q, dt)
        store_wall_force(moving, q, NOWHERE)
        if overlap <= 0.0:
            if friction is not None:
                put(shear, q, NOWHERE)
            continue
        along, held = normal_force(law, overlap, radius[q])
        force = add_scaled(NOWHERE, along, n)
        normal += held
        if friction is not None:
            touch = wall_touch(motion, motion.w, motion.spun, turns, walls, moving, q, overlap, dt)
            across, charged, taken = friction_force(law, touch, radius[q], mass[i], shear, q, dt)
            lost += taken
            sprung += charged
            put(shear, q, across)
            force = add_scaled(force, 1.0, across)
            add_wall_torque(motion.turn, turns, walls, q, overlap, across)
        store_wall_force(moving, q, force)
        work += wall_work(motion.v, moving, q, dt)
        put(push, i, add_scaled(at(push, i), 1.0, force))
    return normal, sprung, lost, work
