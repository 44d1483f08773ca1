"""The springs of one bond, and how it goes over into contact where it breaks; parts of kernels."""

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
def stretched(
    r: Triple, moved: Triple, first: float, strained: float
) -> tuple[Triple, Triple, float, float]:
    """A bond whose ends were at the offset r [m] and moved apart: offset, normal, length, stretch.

    first, strained: length and stretch at t = 0 [m]. A stretch is its first value plus what the
    displacements add, so that small strains keep their digits.
    """
    now = add_scaled(r, 1.0, moved)
    length = math.sqrt(dot(now, now))
    more = dot(add_scaled(add_scaled(NOWHERE, 2.0, r), 1.0, moved), moved) / (length + first)
    return now, add_scaled(NOWHERE, 1.0 / length, now), length, strained + more


@inlined
def arms(first: float, second: float, length: float) -> tuple[float, float]:
    """How far from either centre the surfaces of a pair meet [m]: halfway between or within."""
    beyond = 0.5 * (length - first - second)
    return first + beyond, second + beyond


@inlined
def rolled(
    step: Triple, half: Triple, dt: float, a: Triple, b: Triple, first: float, second: float
) -> tuple[Triple, float]:
    """How the surfaces of spheres of spins a and b moved apart [m], and the bond's twist [rad].

    step: how the centres did; half: the bond at the middle of the step; first, second: radii [m].
    """
    halfway = math.sqrt(dot(half, half))
    arm_i, arm_j = arms(first, second, halfway)
    middle = add_scaled(NOWHERE, 1.0 / halfway, half)
    m = add_scaled(step, -dt, cross(add_scaled(add_scaled(NOWHERE, arm_i, a), arm_j, b), middle))
    twist = 0.5 * dt * dot(add_scaled(a, 1.0, b), middle)
    return add_scaled(m, -0.5 * twist, cross(middle, m)), twist  # it turns for half the step only


@inlined
def charged(s: Triple, m: Triple, half: Triple) -> Triple:
    """The displacement across a bond after a step in which its ends moved apart by m.

    half: the bond at the middle of the step. What there was is mirrored in the plane across it,
    which turns it with the bond and keeps its length; what is added is the part of m in that
    plane, which makes it the integral of L times the angle. What little of m is left along the
    bond changes sign with the next mirror and does not gather.
    """
    share = dot(half, add_scaled(m, 2.0, s)) / dot(half, half)
    return add_scaled(add_scaled(s, 1.0, m), -share, half)


@inlined
def beyond(along: float, across: Triple, tension: float, shear: float, mu: float) -> bool:
    """Whether a bond breaks: its pull exceeds `tension`, or what is across it, shear - mu pull."""
    most = shear - mu * along
    return (along > tension) | (most < 0.0) | (dot(across, across) > most * most)


@inlined
def kept(along: float, across: Triple, mu: float) -> tuple[float, float]:
    """What stays of a bond that breaks: its push [N], and the share of the force across it.

    It is what a contact may have: no tension, and shear up to mu Fn.
    """
    pressed, force = min(along, 0.0), math.sqrt(dot(across, across))
    return pressed, (-mu * pressed / force if force > -mu * pressed else 1.0)


@inlined
def listed(
    p: int, across: Triple, springs: Springs, frail: Frail, slots: Slots, many: Index
) -> None:
    """Put the spheres of bond p among the contacts (space/neighbours.py); across: their shear."""
    rows, offset, first, _, _, radius = springs
    k = many[0]
    many[0] = k + 1
    slots.both[k, 0], slots.both[k, 1] = frail[3][p, 0], frail[3][p, 1]
    slots.rows[k, 0], slots.rows[k, 1] = rows[p, 0], rows[p, 1]
    put(slots.offset, k, at(offset, p))
    slots.gap[k] = first[p] - radius[p, 0] - radius[p, 1]
    slots.radii[k, 0], slots.radii[k, 1] = radius[p, 0], radius[p, 1]
    put(slots.shear, k, add_scaled(NOWHERE, -1.0, across))
