"""The forces of all contacts at the end of a step, inlined into the kernel of bulk."""

from __future__ import annotations

from vv.engines.dem.bulk.grains import RADIUS, Flags, Grains
from vv.engines.dem.bulk.near import Near
from vv.engines.dem.bulk.touches import pair_touch, wall_touch
from vv.engines.dem.contact.law import Law, pressed, rubbed
from vv.engines.dem.contact.touch import reduced_mass
from vv.engines.kernels.compiled import inlined, lent
from vv.engines.kernels.triples import NOWHERE, Triple, add_scaled, at, cross, dot, put
from vv.scene import Vector


@inlined
def part_company(touching: Flags, shear: Vector, k: int) -> None:
    """Forget the shear of a contact that opened."""
    if touching[k]:
        touching[k] = 0
        put(shear, k, NOWHERE)


@lent
def pair_forces(
    grains: Grains,
    near: Near,
    turns: Vector | None,
    law: Law,
    friction: tuple[float, float] | None,
    dt: float,
) -> Triple:
    """Add the forces of pairs to push and turn; return energies [J]: normal, shear, friction's.

    friction: that of the law, or None where nothing rubs; turns: None if no sphere turns.
    """
    row, push, turn = grains.row, grains.push, grains.turn
    start, other, touching, shear = near.start, near.other, near.touching, near.shear
    normal, sprung, lost = 0.0, 0.0, 0.0
    for i in range(len(start) - 1):
        x, radius, pushed, turned = at(row, i), row[i, RADIUS], NOWHERE, NOWHERE
        for k in range(start[i], start[i + 1]):
            j = other[k]
            d, reach = add_scaled(at(row, j), -1.0, x), radius + row[j, RADIUS]
            square = dot(d, d)
            if square >= reach * reach:
                if friction is not None:
                    part_company(touching, shear, k)
                continue
            touch, reduced = pair_touch(row, turns, i, j, d, square, dt)
            along, held = pressed(law, touch.overlap, reduced)
            force = add_scaled(NOWHERE, along, touch.n)
            normal += held
            if friction is not None:
                touching[k] = 1
                across, charged, taken = rubbed(
                    law, touch, reduced, reduced_mass(grains.mass, i, j), at(shear, k), dt
                )
                lost += taken
                sprung += charged
                put(shear, k, across)
                force = add_scaled(force, 1.0, across)
                if turns is not None:
                    torque, inside = cross(across, touch.n), 0.5 * touch.overlap
                    turned = add_scaled(turned, radius - inside, torque)
                    put(turn, j, add_scaled(at(turn, j), row[j, RADIUS] - inside, torque))
            pushed = add_scaled(pushed, -1.0, force)
            put(push, j, add_scaled(at(push, j), 1.0, force))
        put(push, i, add_scaled(at(push, i), 1.0, pushed))
        if turns is not None:
            put(turn, i, add_scaled(at(turn, i), 1.0, turned))
    return normal, sprung, lost


@lent
def wall_forces(
    grains: Grains,
    near: Near,
    walls: Vector,
    turns: Vector | None,
    law: Law,
    friction: tuple[float, float] | None,
    dt: float,
) -> Triple:
    """As `pair_forces`, of walls (w, 4): outward normals and how far they lie along them [m]."""
    row, push, turn = grains.row, grains.push, grains.turn
    start, other, touching, shear = near.start, near.other, near.touching, near.shear
    normal, sprung, lost = 0.0, 0.0, 0.0
    for i in range(len(start) - 1):
        for k in range(start[i], start[i + 1]):
            n, radius = at(walls, other[k]), row[i, RADIUS]
            overlap = radius - dot(at(row, i), n) + walls[other[k], 3]
            if overlap <= 0.0:
                if friction is not None:
                    part_company(touching, shear, k)
                continue
            along, held = pressed(law, overlap, radius)
            force = add_scaled(NOWHERE, along, n)
            normal += held
            if friction is not None:
                touching[k] = 1
                touch = wall_touch(row, turns, i, n, overlap, dt)
                across, charged, taken = rubbed(
                    law, touch, radius, grains.mass[i], at(shear, k), dt
                )
                lost += taken
                sprung += charged
                put(shear, k, across)
                force = add_scaled(force, 1.0, across)
                if turns is not None:
                    put(turn, i, add_scaled(at(turn, i), radius - 0.5 * overlap, cross(across, n)))
            put(push, i, add_scaled(at(push, i), 1.0, force))
    return normal, sprung, lost


@lent
def forces(
    grains: Grains,
    pairs: Near,
    edges: Near,
    walls: Vector,
    turns: Vector | None,
    law: Law,
    friction: tuple[float, float] | None,
    dt: float,
) -> Triple:
    """Add to push and turn all but what is viscous; return energies [J] as `pair_forces`."""
    one = pair_forces(grains, pairs, turns, law, friction, dt)
    return add_scaled(one, 1.0, wall_forces(grains, edges, walls, turns, law, friction, dt))
