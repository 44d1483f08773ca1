"""The forces of walls on the spheres of the bulk model, one contact after the other."""

from __future__ import annotations

from vv.engines.dem.bulk.batches import LOST, NORMAL, SPRUNG
from vv.engines.dem.bulk.crowd import Crowd
from vv.engines.dem.bulk.grains import BEFORE, RADIUS, SPUN, TURN, V, W, columns_of, set_columns
from vv.engines.dem.contact.friction import shear_force
from vv.engines.dem.contact.law import Law, normal_force, shear_energy, shear_stiffness
from vv.engines.dem.contact.touch import Touch
from vv.engines.kernels.compiled import inlined, lent
from vv.engines.kernels.triples import NOWHERE, Triple, add_scaled, at, cross, dot, put
from vv.scene import Vector


@inlined
def wall_kinematics(row: Vector, i: int, n: Triple, overlap: float, dt: float) -> Touch:
    """The kinematics of the contact of sphere i with a wall of outward normal n in a step."""
    relative = columns_of(row, i, V)
    changed = add_scaled(relative, -1.0, columns_of(row, i, BEFORE))
    opened, more = dt * dot(n, relative), 0.5 * dot(n, changed)
    rates = dot(n, relative) - more, dot(n, relative) + more
    arm, w = 0.5 * (overlap + 0.5 * opened) - row[i, RADIUS], columns_of(row, i, W)
    relative = add_scaled(relative, arm, cross(w, n))
    changed = add_scaled(changed, arm, cross(add_scaled(w, -1.0, columns_of(row, i, SPUN)), n))
    twist = 0.5 * dt * dot(w, n)
    return Touch(overlap, opened, n, n, n, rates, relative, changed, twist)


@lent
def add_wall_forces(
    crowd: Crowd,
    c: int,
    some: tuple[int, int],
    with_energy: bool,
    law: Law,
    friction: tuple[float, float] | None,
) -> None:
    """Add the forces of walls for contacts some[0] to some[1]; see `add_pair_forces`."""
    edges, walls, dt, sums = crowd.edges, crowd.rules.walls, crowd.rules.dt, crowd.work.sums
    row, acting = crowd.grains.row, crowd.grains.acting
    one, other, touching, shear = edges.one, edges.other, edges.touching, edges.shear
    for k in range(some[0], some[1]):
        i, n = one[k], at(walls, other[k])
        radius, spring = row[i, RADIUS], NOWHERE
        overlap = radius - dot(at(row, i), n) + walls[other[k], 3]
        if friction is not None:
            spring = at(shear, k) if touching[k] else NOWHERE
            touching[k] = overlap > 0.0
        if overlap > 0.0:
            along, held = normal_force(law, overlap, radius)
            force = add_scaled(NOWHERE, along, n)
            sums[c, NORMAL] += held if with_energy else 0.0
            if friction is not None:
                touch = wall_kinematics(row, i, n, overlap, dt)
                ks, caps = shear_stiffness(
                    law, touch, radius, 0.0, spring
                )  # laws here need no mass
                rubbed, taken = shear_force(spring, touch, ks, caps, dt)
                sums[c, LOST] += taken
                sums[c, SPRUNG] += (
                    shear_energy(law, overlap, radius, rubbed) if with_energy else 0.0
                )
                put(shear, k, rubbed)
                force = add_scaled(force, 1.0, rubbed)
                torque = add_scaled(NOWHERE, radius - 0.5 * overlap, cross(rubbed, n))
                set_columns(acting, i, TURN, add_scaled(columns_of(acting, i, TURN), 1.0, torque))
            put(acting, i, add_scaled(at(acting, i), 1.0, force))
