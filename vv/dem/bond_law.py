"""The springs of bonds, and how a bond that breaks goes over into contact; parts of kernels."""

from __future__ import annotations

import math

from vv.compiled import called, inlined
from vv.dem.friction import turned
from vv.dem.neighbours import Slots, State
from vv.dem.rows import Index
from vv.scene import Vector
from vv.triples import NOWHERE, Triple, at, cross, dot, plus, put

Springs = tuple[Index, Vector, Vector, Vector, Vector, Vector]
Frail = tuple[Vector, Vector, float, Index]


@inlined
def arms(radius: Vector, p: int, length: float) -> tuple[float, float]:
    """How far from either centre the surfaces of a pair meet [m]: halfway between or within."""
    beyond = 0.5 * (length - radius[p, 0] - radius[p, 1])
    return radius[p, 0] + beyond, radius[p, 1] + beyond


@inlined
def charged(s: Triple, m: Triple, half: Triple) -> Triple:
    """The displacement across a bond after a step in which its ends moved apart by m.

    half: the bond at the middle of the step. What there was is mirrored in the plane across it,
    which turns it with the bond and keeps its length; what is added is the part of m in that
    plane, which makes it the integral of L times the angle. What little of m is left along the
    bond changes sign with the next mirror and does not gather.
    """
    share = dot(half, plus(m, 2.0, s)) / dot(half, half)
    return plus(plus(s, 1.0, m), -share, half)


@called
def parted(
    p: int,
    along: float,
    stretch: float,
    opened: float,
    across: Triple,
    s: Triple,
    m: Triple,
    springs: Springs,
    frail: Frail,
    slots: Slots,
    many: Index,
    lost: Vector,
) -> tuple[float, float]:
    """Put bond p among the contacts; return what stays of its normal force [N], share of shear.

    What stays is what a contact may have: no tension, and shear up to mu Fn. The trapezoidal rule
    by which all is booked makes the force the mean of that at the two ends of the step, so that
    the bond parts in the middle: `lost` (2,) [J] is what its springs held then, less what stays.
    opened, m: how its ends moved in the step, along it and across [m].
    """
    rows, offset, first, _, _, radius = springs
    mu, force = frail[2], math.sqrt(dot(across, across))
    pressed, kept = min(along, 0.0), 1.0
    if force > -mu * pressed:
        kept = -mu * pressed / force
    lost[0] += 0.5 * (along - pressed) * (stretch - opened)
    lost[1] += 0.5 * (1.0 - kept) * dot(across, plus(plus(NOWHERE, 1.0 + kept, s), -1.0, m))
    k = many[0]
    many[0] = k + 1
    slots[0][k, 0], slots[0][k, 1] = frail[3][p, 0], frail[3][p, 1]
    slots[1][k, 0], slots[1][k, 1] = rows[p, 0], rows[p, 1]
    put(slots[2], k, at(offset, p))
    slots[3][k] = first[p] - radius[p, 0] - radius[p, 1]
    slots[4][k, 0], slots[4][k, 1] = radius[p, 0], radius[p, 1]
    put(slots[5], k, plus(NOWHERE, -kept, across))
    return pressed, kept


@inlined
def pull(
    push: Vector,
    turn: Vector | None,
    u: Vector,
    v: Vector,
    w: Vector | None,
    dt: float,
    springs: Springs,
    ks: Vector | None,
    slip: Vector,
    frail: Frail | None,
    broken: State,
    slots: Slots,
    many: Index,
    lost: Vector,
) -> tuple[float, float]:
    """Add the forces of all whole bonds to push and turn; return normal and shear energies [J].

    springs: rows (b, 2), first offset (b, 3) and its length (b,), stretch at t = 0 (b,), kn (b,),
    radii (b, 2). A stretch is its first value plus what the displacements add, so that small
    strains keep their digits. slip: (b, 3) displacement of the surfaces across each bond, which
    turns with it and, where spheres spin, about it by the mean of their spins. frail: tension and
    shear strengths (b,), mu, and the spheres i < j (b, 2); broken: (b,) 1 for the bonds that
    have parted, whose pairs are among the first many[0] of slots (vv.dem.neighbours).
    """
    rows, offset, first, strained, kn, radius = springs
    normal = sheared = 0.0
    for p in range(len(rows)):
        if frail is not None and broken[p]:
            continue
        i, j = rows[p, 0], rows[p, 1]
        moved, r = plus(at(u, j), -1.0, at(u, i)), at(offset, p)
        now = plus(r, 1.0, moved)
        length = math.sqrt(dot(now, now))
        n = plus(NOWHERE, 1.0 / length, now)
        more = dot(plus(plus(NOWHERE, 2.0, r), 1.0, moved), moved) / (length + first[p])
        stretch = strained[p] + more
        along, kept, s, across = kn[p] * stretch, 1.0, NOWHERE, NOWHERE
        step = plus(NOWHERE, dt, plus(at(v, j), -1.0, at(v, i)))
        m = step
        if ks is not None:
            half, s = plus(now, -0.5, step), at(slip, p)
            if w is not None:
                halfway = math.sqrt(dot(half, half))
                arm_i, arm_j = arms(radius, p, halfway)
                middle = plus(NOWHERE, 1.0 / halfway, half)
                rolled = plus(plus(NOWHERE, arm_i, at(w, i)), arm_j, at(w, j))
                m = plus(m, -dt, cross(rolled, middle))
                twist = 0.5 * dt * dot(plus(at(w, i), 1.0, at(w, j)), middle)
                m = plus(m, -0.5 * twist, cross(middle, m))  # it turns for half the step only
            s = charged(s, m, half)
            if w is not None:
                s = turned(s, n, twist)
            put(slip, p, s)
            across = plus(NOWHERE, ks[p], s)
        if frail is not None:
            shear = frail[1][p] - frail[2] * along
            beyond = (shear < 0.0) | (dot(across, across) > shear * shear)
            if (along > frail[0][p]) | beyond:  # of three tests that rarely hold, one branch
                broken[p] = 1
                along, kept = parted(
                    p, along, stretch, dot(step, n), across, s, m, springs, frail, slots, many, lost
                )
        normal += 0.5 * along * stretch
        force = plus(NOWHERE, along, n)
        if ks is not None:
            sheared += 0.5 * kept * kept * dot(across, s)
            force = plus(force, kept, across)
            if turn is not None:
                arm_i, arm_j = arms(radius, p, length)
                torque = plus(NOWHERE, kept, cross(n, across))
                put(turn, i, plus(at(turn, i), arm_i, torque))
                put(turn, j, plus(at(turn, j), arm_j, torque))
        put(push, i, plus(at(push, i), 1.0, force))
        put(push, j, plus(at(push, j), -1.0, force))
    return normal, sheared
