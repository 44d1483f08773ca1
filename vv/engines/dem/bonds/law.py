"""The springs of one bond, and its transition to a contact when it breaks; parts of kernels."""

from __future__ import annotations

import math

from vv.engines.dem.rows import Index
from vv.engines.dem.space.neighbours import Slots
from vv.engines.kernels.compiled import inlined
from vv.engines.kernels.triples import NOWHERE, Triple, add_scaled, at, cross, dot, put
from vv.scene import Vector

Springs = tuple[Index, Vector, Vector, Vector, Vector, Vector]
Frail = tuple[Vector, Vector, float, Index]


@inlined
def elongation(
    r: Triple, moved: Triple, first: float, strained: float
) -> tuple[Triple, Triple, float, float]:
    """The offset of the ends of a bond [m], its normal, length and stretch; r: the offset at t = 0.

    moved: the relative displacement of the ends [m]; first, strained: length and stretch at t = 0
    [m]. The stretch is that at t = 0 plus a change without cancellation, so that small strains are
    precise.
    """
    now = add_scaled(r, 1.0, moved)
    length = math.sqrt(dot(now, now))
    more = dot(add_scaled(add_scaled(NOWHERE, 2.0, r), 1.0, moved), moved) / (length + first)
    return now, add_scaled(NOWHERE, 1.0 / length, now), length, strained + more


@inlined
def arms(first: float, second: float, length: float) -> tuple[float, float]:
    """The distances [m] from both centres to the point midway between (or within) the surfaces."""
    beyond = 0.5 * (length - first - second)
    return first + beyond, second + beyond


@inlined
def surface_motion(
    step: Triple, half: Triple, dt: float, a: Triple, b: Triple, first: float, second: float
) -> tuple[Triple, float]:
    """The relative displacement [m] of the surfaces of two spheres in a step, and the twist [rad].

    step: the relative displacement of the centres [m]; half: the bond vector at the middle of the
    step; a, b: the spins [1/s]; first, second: radii [m].
    """
    halfway = math.sqrt(dot(half, half))
    arm_i, arm_j = arms(first, second, halfway)
    middle = add_scaled(NOWHERE, 1.0 / halfway, half)
    m = add_scaled(step, -dt, cross(add_scaled(add_scaled(NOWHERE, arm_i, a), arm_j, b), middle))
    twist = 0.5 * dt * dot(add_scaled(a, 1.0, b), middle)
    return add_scaled(m, -0.5 * twist, cross(middle, m)), twist  # half the twist acts on average


@inlined
def sheared_by(s: Triple, m: Triple, half: Triple) -> Triple:
    """The shear displacement s of a bond after a step in which its ends moved apart by m [m].

    half: the bond vector at the middle of the step. The old s is reflected at the plane normal to
    it, which rotates it with the bond and keeps its length. The part of m in that plane is added,
    so that s is the integral of L times the angle. A small remainder of m along the bond changes
    sign with the next reflection and does not accumulate.
    """
    share = dot(half, add_scaled(m, 2.0, s)) / dot(half, half)
    return add_scaled(add_scaled(s, 1.0, m), -share, half)


@inlined
def exceeds_strength(along: float, across: Triple, tension: float, shear: float, mu: float) -> bool:
    """Whether a bond breaks: its pull > `tension`, or its shear force > shear - mu pull."""
    most = shear - mu * along
    return (along > tension) | (most < 0.0) | (dot(across, across) > most * most)


@inlined
def remaining_force(along: float, across: Triple, mu: float) -> tuple[float, float]:
    """The normal force [N] that a breaking bond keeps, and the fraction of the shear force.

    They are those that a contact allows: no tension, and a shear force of at most mu Fn.
    """
    pressed, force = min(along, 0.0), math.sqrt(dot(across, across))
    return pressed, (-mu * pressed / force if force > -mu * pressed else 1.0)


@inlined
def add_contact(
    p: int, across: Triple, springs: Springs, frail: Frail, slots: Slots, many: Index
) -> None:
    """Add the spheres of bond p to the contacts in slots (space/neighbours.py).

    across: the shear force [N] on the first sphere.
    """
    rows, offset, first, _, _, radius = springs
    k = many[0]
    many[0] = k + 1
    slots.both[k, 0], slots.both[k, 1] = frail[3][p, 0], frail[3][p, 1]
    slots.rows[k, 0], slots.rows[k, 1] = rows[p, 0], rows[p, 1]
    put(slots.offset, k, at(offset, p))
    slots.gap[k] = first[p] - radius[p, 0] - radius[p, 1]
    slots.radii[k, 0], slots.radii[k, 1] = radius[p, 0], radius[p, 1]
    put(slots.shear, k, add_scaled(NOWHERE, -1.0, across))
