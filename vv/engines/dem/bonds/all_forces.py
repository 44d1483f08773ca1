"""The sum of the forces of all bonds, and the breaking of bonds; parts of kernels."""

from __future__ import annotations

from vv.engines.dem.bonds.arrays import BREAKS, BROKEN, BondArrays
from vv.engines.dem.bonds.block_forces import vector_of
from vv.engines.dem.bonds.blocks import SLIP, WIDE
from vv.engines.dem.bonds.chunk_forces import compute_chunks
from vv.engines.dem.bonds.law import (
    Frail,
    add_contact,
    arms,
    elongation,
    remaining_force,
    surface_motion,
)
from vv.engines.dem.bonds.threads import compute_chunks_in_threads
from vv.engines.dem.rows import Index
from vv.engines.dem.space.bodies import Motion
from vv.engines.dem.space.neighbours import Slots
from vv.engines.kernels.compiled import inlined, lent
from vv.engines.kernels.triples import NOWHERE, Triple, add_scaled, at, cross, dot, put
from vv.scene import Vector


@inlined
def bond_now(
    p: int, bonds: BondArrays, motion: Motion, dt: float, ks: Vector | None, w: Vector | None
) -> tuple[Triple, float, float, Triple, Triple, Triple, Triple]:
    """Bond p after a step: its normal, length and stretch, and how it shears.

    The last four are how far its ends [m] and the surfaces of its spheres [m] moved apart in the
    step, its shear displacement [m] and its shear force [N].
    """
    rows, offset, first, strained, _, radius = bonds.springs
    i, j = rows[p, 0], rows[p, 1]
    moved = add_scaled(at(motion.u, j), -1.0, at(motion.u, i))
    step = add_scaled(NOWHERE, dt, add_scaled(at(motion.v, j), -1.0, at(motion.v, i)))
    now, n, length, stretch = elongation(at(offset, p), moved, first[p], strained[p])
    m, s, across = step, NOWHERE, NOWHERE
    if ks is not None:
        s = vector_of(bonds.table, p // WIDE, SLIP, p % WIDE)
        if w is not None:
            half = add_scaled(now, -0.5, step)
            m, _ = surface_motion(step, half, dt, at(w, i), at(w, j), radius[p, 0], radius[p, 1])
        across = add_scaled(NOWHERE, ks[p], s)
    return n, length, stretch, step, m, s, across


@inlined
def break_bond(
    p: int, bonds: BondArrays, motion: Motion, dt: float, frail: Frail, slots: Slots, many: Index
) -> tuple[float, float]:
    """Turn bond p into a contact with the force that remains; return the energies that remain [J].

    Work is summed by the trapezoidal rule, which takes the mean of the forces at both ends of the
    step: the bond thus breaks in the middle of the step. The energy of its springs there, minus
    what remains, is added to what is lost with broken bonds.
    """
    n, length, stretch, step, m, s, across = bond_now(p, bonds, motion, dt, bonds.ks, motion.w)
    along = bonds.springs[4][p] * stretch
    pressed, share = remaining_force(along, across, frail[2])
    bonds.torn[0] += 0.5 * (along - pressed) * (stretch - dot(step, n))
    bonds.torn[1] += (
        0.5 * (1.0 - share) * dot(across, add_scaled(add_scaled(NOWHERE, 1.0 + share, s), -1.0, m))
    )
    across = add_scaled(NOWHERE, share, across)
    add_contact(p, across, bonds.springs, frail, slots, many)
    push_ends(p, bonds, motion.push, add_scaled(across, pressed, n))
    turn_ends(p, bonds, motion.turn, length, cross(n, across))
    return 0.5 * pressed * stretch, 0.5 * share * dot(across, s)


@inlined
def push_ends(p: int, bonds: BondArrays, push: Vector, force: Triple) -> None:
    """Add the force of bond p on its first end, and the opposite force on its second."""
    i, j = bonds.springs[0][p, 0], bonds.springs[0][p, 1]
    put(push, i, add_scaled(at(push, i), 1.0, force))
    put(push, j, add_scaled(at(push, j), -1.0, force))


@inlined
def turn_ends(p: int, bonds: BondArrays, turn: Vector | None, length: float, lever: Triple) -> None:
    """Add the torques of bond p on its ends; lever: its normal x its shear force [N]."""
    if turn is not None:
        i, j, radius = bonds.springs[0][p, 0], bonds.springs[0][p, 1], bonds.springs[5]
        arm_i, arm_j = arms(radius[p, 0], radius[p, 1], length)
        put(turn, i, add_scaled(at(turn, i), arm_i, lever))
        put(turn, j, add_scaled(at(turn, j), arm_j, lever))


@inlined
def compute_all(bonds: BondArrays, motion: Motion, dt: float, threads: int | None) -> None:
    """Compute the forces of all chunks, in turn or in threads."""
    if threads is None:
        compute_chunks(bonds, motion, dt)
    else:
        compute_chunks_in_threads(bonds, motion, dt)


@inlined
def add_chunks(push: Vector | None, pushes: Vector, window: Index, chunks: int) -> None:
    """Add the forces of all chunks to push in the order of chunks; or torques, if there are any."""
    if push is None:
        return
    rows = len(pushes) // chunks
    for c in range(chunks):
        for i in range(window[c, 0], window[c, 1]):
            put(push, i, add_scaled(at(push, i), 1.0, at(pushes, c * rows + i)))


@lent
def break_bonds(
    bonds: BondArrays, motion: Motion, dt: float, frail: Frail, slots: Slots, many: Index
) -> tuple[float, float]:
    """Break all bonds marked as breaking; return the energies that remain [J].

    The pairs of broken bonds become contacts in slots, of which the first many[0] are in use
    (space/neighbours.py).
    """
    normal = sheared = 0.0
    for p in range(len(bonds.springs[0])):
        if bonds.state[p // WIDE, p % WIDE] == BREAKS:
            bonds.state[p // WIDE, p % WIDE] = BROKEN
            a, b = break_bond(p, bonds, motion, dt, frail, slots, many)
            normal, sheared = normal + a, sheared + b
    return normal, sheared


@inlined
def add_bond_forces(bonds: BondArrays, motion: Motion, dt: float) -> Triple:
    """Add the forces of all bonds to those of motion; return their energies [J] and how many break.

    The energies are those of normal and of shear springs. Kernels call `break_bonds` for those that
    break: a call from here would have numba count references to all its arrays in every step.
    """
    compute_all(bonds, motion, dt, bonds.threads)
    held, window = bonds.held, bonds.blocks.window
    add_chunks(motion.push, bonds.pushes, window, len(held))
    add_chunks(motion.turn, bonds.torques, window, len(held))
    normal = sheared = breaking = 0.0
    for c in range(len(held)):
        normal, sheared, breaking = normal + held[c, 0], sheared + held[c, 1], breaking + held[c, 2]
    return normal, sheared, breaking
