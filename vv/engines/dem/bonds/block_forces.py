"""The forces of one block of bonds; parts of kernels.

The motion of the ends is copied to scratch, the bonds are computed in a vectorised loop, and their
forces are added to those of the spheres.
"""

from __future__ import annotations

from vv.engines.dem.bonds.arrays import BondArrays
from vv.engines.dem.bonds.blocks import (
    ARMS,
    FIRST,
    FORCE,
    HIT,
    KN,
    MOVED,
    NORMAL,
    OFFSET,
    RADII,
    SHEARED,
    SLIP,
    SPIN_I,
    SPIN_J,
    STEP,
    STRAINED,
    TORQUE,
    WIDE,
)
from vv.engines.dem.bonds.law import (
    Frail,
    arms,
    elongation,
    exceeds_strength,
    sheared_by,
    surface_motion,
)
from vv.engines.dem.contact.friction import rotated
from vv.engines.dem.space.bodies import Motion
from vv.engines.kernels.compiled import inlined
from vv.engines.kernels.prefetch import begin_to_read
from vv.engines.kernels.triples import NOWHERE, Triple, add_scaled, at, cross, dot, put
from vv.scene import Vector

LINE = 8  # numbers in a cache line; WIDE lines hold nearly all numbers of a block
Like = tuple[float, float, float, float]


@inlined
def vector_of(numbers: Vector, k: int, place: int, q: int) -> Triple:
    """A vector of bond q in row k, without a view of the row: numba counts references to views."""
    return (
        numbers[k, place * WIDE + q],
        numbers[k, (place + 1) * WIDE + q],
        numbers[k, (place + 2) * WIDE + q],
    )


@inlined
def store_vector(numbers: Vector, k: int, place: int, q: int, a: Triple) -> None:
    """Store a vector of bond q in row k."""
    numbers[k, place * WIDE + q] = a[0]
    numbers[k, (place + 1) * WIDE + q] = a[1]
    numbers[k, (place + 2) * WIDE + q] = a[2]


@inlined
def property_of(table: Vector, like: Like | None, which: int, k: int, q: int) -> float:
    """The stiffness or strength of bond q in block k: 0 kn, 1 ks, 2 tension, 3 shear."""
    if like is not None:
        return like[which]
    number: float = table[k, (KN + which) * WIDE + q]
    return number


@inlined
def bonds_in(bonds: BondArrays, k: int) -> int:
    """How many bonds block k has: the last one may be incomplete."""
    return min(WIDE, len(bonds.springs[0]) - k * WIDE)


@inlined
def gather_ends(bonds: BondArrays, c: int, k: int, motion: Motion, w: Vector | None) -> None:
    """Copy the relative motion and the spins of the ends of block k's bonds to row c of scratch.

    Meanwhile the table of the next block is loaded into the cache, if there is a next block. A
    scene with few bonds has none; the loads would cost a twentieth of its step.
    """
    scratch, table, ends = bonds.scratch, bonds.table, bonds.blocks.ends
    u, v = motion.u, motion.v
    goes_on = k + 1 < len(table)
    for q in range(bonds_in(bonds, k)):
        if goes_on:
            begin_to_read(table, k + 1, q * LINE)
        i, j = ends[k, q], ends[k, WIDE + q]
        store_vector(scratch, c, MOVED, q, add_scaled(at(u, j), -1.0, at(u, i)))
        store_vector(scratch, c, STEP, q, add_scaled(at(v, j), -1.0, at(v, i)))
        if w is not None:
            store_vector(scratch, c, SPIN_I, q, at(w, i))
            store_vector(scratch, c, SPIN_J, q, at(w, j))


@inlined
def compute_block(
    bonds: BondArrays,
    c: int,
    k: int,
    dt: float,
    like: Like | None,
    ks: Vector | None,
    w: Vector | None,
    frail: Frail | None,
) -> int:
    """Compute the forces and energies of the bonds in block k; return how many bonds break.

    The forces are those on the first ends. The loop has no branch, no call and no sum of floats, so
    that it is vectorised. A bond that breaks or is broken has no force. For this reason it is one
    function.
    """
    scratch, table, state, breaking = bonds.scratch, bonds.table, bonds.state, 0
    for q in range(bonds_in(bonds, k)):
        r, moved = vector_of(table, k, OFFSET, q), vector_of(scratch, c, MOVED, q)
        first, strained = table[k, FIRST * WIDE + q], table[k, STRAINED * WIDE + q]
        now, n, length, stretch = elongation(r, moved, first, strained)
        along, across, s = property_of(table, like, 0, k, q) * stretch, NOWHERE, NOWHERE
        if ks is not None:
            m = add_scaled(NOWHERE, dt, vector_of(scratch, c, STEP, q))
            half, s = add_scaled(now, -0.5, m), vector_of(table, k, SLIP, q)
            if w is not None:
                radii = table[k, RADII * WIDE + q], table[k, (RADII + 1) * WIDE + q]
                spins = vector_of(scratch, c, SPIN_I, q), vector_of(scratch, c, SPIN_J, q)
                m, twist = surface_motion(m, half, dt, spins[0], spins[1], radii[0], radii[1])
            s = sheared_by(s, m, half)
            if w is not None:
                s = rotated(s, n, twist)
            store_vector(table, k, SLIP, q, s)
            across = add_scaled(NOWHERE, property_of(table, like, 1, k, q), s)
        if frail is not None:
            tension, shear = property_of(table, like, 2, k, q), property_of(table, like, 3, k, q)
            broken = state[k, q] != 0
            breaks = exceeds_strength(along, across, tension, shear, frail[2]) & (not broken)
            scratch[c, HIT * WIDE + q] = 1.0 if breaks else 0.0
            breaking += 1 if breaks else 0
            along = 0.0 if breaks | broken else along
            across = NOWHERE if breaks | broken else across
        scratch[c, NORMAL * WIDE + q] = 0.5 * along * stretch
        store_vector(scratch, c, FORCE, q, add_scaled(across, along, n))
        if ks is not None:
            scratch[c, SHEARED * WIDE + q] = 0.5 * dot(across, s)
            if w is not None:
                store_vector(scratch, c, TORQUE, q, cross(n, across))
                arm_i, arm_j = arms(radii[0], radii[1], length)
                scratch[c, ARMS * WIDE + q], scratch[c, (ARMS + 1) * WIDE + q] = arm_i, arm_j
    return breaking


@inlined
def add_block_forces(
    bonds: BondArrays, c: int, k: int, base: int, ks: Vector | None, w: Vector | None
) -> tuple[float, float]:
    """Add the forces of block k to those of its chunk, from row `base` on.

    Return their energies [J]: those of normal and of shear springs.
    """
    push, turn, scratch, ends = bonds.pushes, bonds.torques, bonds.scratch, bonds.blocks.ends
    normal = sheared = 0.0
    for q in range(bonds_in(bonds, k)):
        i, j = base + ends[k, q], base + ends[k, WIDE + q]
        force = vector_of(scratch, c, FORCE, q)
        put(push, i, add_scaled(at(push, i), 1.0, force))
        put(push, j, add_scaled(at(push, j), -1.0, force))
        normal += scratch[c, NORMAL * WIDE + q]
        if ks is not None:
            sheared += scratch[c, SHEARED * WIDE + q]
            if w is not None:
                torque = vector_of(scratch, c, TORQUE, q)
                put(turn, i, add_scaled(at(turn, i), scratch[c, ARMS * WIDE + q], torque))
                put(turn, j, add_scaled(at(turn, j), scratch[c, (ARMS + 1) * WIDE + q], torque))
    return normal, sheared
