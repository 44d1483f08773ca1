"""The sum of the forces of all bonds, and the breaking of bonds; parts of kernels."""

from __future__ import annotations

import numpy as np

from vv.engines.dem.bonds.block_forces import SCRATCH, vector_of
from vv.engines.dem.bonds.blocks import SLIP, WIDE, Blocks
from vv.engines.dem.bonds.chunk_forces import BREAKS, BROKEN, compute_chunks
from vv.engines.dem.bonds.law import (
    Frail,
    Springs,
    add_contact,
    arms,
    elongation,
    remaining_force,
    surface_motion,
)
from vv.engines.dem.bonds.threads import compute_chunks_in_threads
from vv.engines.dem.rows import Index
from vv.engines.dem.space.neighbours import Slots, State
from vv.engines.kernels.compiled import inlined, inlined_called, lent
from vv.engines.kernels.triples import NOWHERE, Triple, add_scaled, at, cross, dot, put
from vv.scene import Vector

Shares = tuple[Vector, Vector, Vector, Vector]


@inlined_called
def chunk_arrays(chunks: int, rows: int) -> Shares:
    """Arrays for each chunk: forces and torques (c x rows, 3), scratch, and sums (c, 3)."""
    push, turn = np.zeros((chunks * rows, 3)), np.zeros((chunks * rows, 3))
    return push, turn, np.zeros((chunks, SCRATCH * WIDE)), np.zeros((chunks, 3))


@inlined
def break_bond(
    p: int,
    push: Vector,
    turn: Vector | None,
    u: Vector,
    v: Vector,
    w: Vector | None,
    dt: float,
    springs: Springs,
    ks: Vector | None,
    table: Vector,
    frail: Frail,
    slots: Slots,
    many: Index,
    lost: Vector,
) -> tuple[float, float]:
    """Turn bond p into a contact with the force that remains; return the energies that remain [J].

    Work is summed by the trapezoidal rule, which takes the mean of the forces at both ends of the
    step: the bond thus breaks in the middle of the step. The energy of its springs there, minus
    what remains, is added to `lost` (2,) [J]. It is one function since a third of its lines are
    arguments and the rest shares its vectors.
    """
    rows, offset, first, strained, kn, radius = springs
    i, j = rows[p, 0], rows[p, 1]
    moved, step = add_scaled(at(u, j), -1.0, at(u, i)), add_scaled(at(v, j), -1.0, at(v, i))
    now, n, length, stretch = elongation(at(offset, p), moved, first[p], strained[p])
    step = add_scaled(NOWHERE, dt, step)
    along, m, s, across = kn[p] * stretch, step, NOWHERE, NOWHERE
    if ks is not None:
        s = vector_of(table, p // WIDE, SLIP, p % WIDE)
        if w is not None:
            half = add_scaled(now, -0.5, step)
            m, _ = surface_motion(step, half, dt, at(w, i), at(w, j), radius[p, 0], radius[p, 1])
        across = add_scaled(NOWHERE, ks[p], s)
    pressed, share = remaining_force(along, across, frail[2])
    lost[0] += 0.5 * (along - pressed) * (stretch - dot(step, n))
    lost[1] += (
        0.5 * (1.0 - share) * dot(across, add_scaled(add_scaled(NOWHERE, 1.0 + share, s), -1.0, m))
    )
    across = add_scaled(NOWHERE, share, across)
    add_contact(p, across, springs, frail, slots, many)
    force = add_scaled(across, pressed, n)
    put(push, i, add_scaled(at(push, i), 1.0, force))
    put(push, j, add_scaled(at(push, j), -1.0, force))
    if turn is not None:
        arm_i, arm_j = arms(radius[p, 0], radius[p, 1], length)
        put(turn, i, add_scaled(at(turn, i), arm_i, cross(n, across)))
        put(turn, j, add_scaled(at(turn, j), arm_j, cross(n, across)))
    return 0.5 * pressed * stretch, 0.5 * share * dot(across, s)


@inlined
def add_chunks(push: Vector, pushes: Vector, window: Index, chunks: int) -> None:
    """Add the forces of all chunks to push, in the order of chunks."""
    rows = len(pushes) // chunks
    for c in range(chunks):
        for i in range(window[c, 0], window[c, 1]):
            put(push, i, add_scaled(at(push, i), 1.0, at(pushes, c * rows + i)))


@lent
def break_bonds(
    push: Vector,
    turn: Vector | None,
    u: Vector,
    v: Vector,
    w: Vector | None,
    dt: float,
    springs: Springs,
    ks: Vector | None,
    table: Vector,
    frail: Frail,
    state: State,
    slots: Slots,
    many: Index,
    lost: Vector,
) -> tuple[float, float]:
    """Break all bonds marked as breaking; return the energies that remain [J].

    The pairs of broken bonds become contacts in slots, of which the first many[0] are in use
    (space/neighbours.py).
    """
    normal = sheared = 0.0
    for p in range(len(springs[0])):
        if state[p // WIDE, p % WIDE] == BREAKS:
            state[p // WIDE, p % WIDE] = BROKEN
            a, b = break_bond(
                p, push, turn, u, v, w, dt, springs, ks, table, frail, slots, many, lost
            )
            normal, sheared = normal + a, sheared + b
    return normal, sheared


@inlined
def add_bond_forces(
    push: Vector,
    turn: Vector | None,
    u: Vector,
    v: Vector,
    w: Vector | None,
    dt: float,
    springs: Springs,
    ks: Vector | None,
    blocks: Blocks,
    table: Vector,
    each: Shares,
    frail: Frail | None,
    state: State,
    threads: int | None,
) -> Triple:
    """Add the forces of all bonds to push and turn; return their energies [J] and how many break.

    The energies are those of normal and of shear springs. Kernels call `break_bonds` for those that
    break: a call from here would have numba count references to all its arrays in every step.

    springs: rows (b, 2), offset at t = 0 (b, 3) and its length (b,), stretch at t = 0 (b,), kn
    (b,), radii (b, 2). table: that of blocks, in which the shear displacements are updated; they
    rotate with the bond and, where spheres rotate, about it by the mean of their spins. frail:
    tension and shear strengths (b,), mu, and the spheres i < j (b, 2); state: see `compute_chunk`.
    It is one function since most of its lines are arguments.
    """
    ends, like, share, window = blocks[0], blocks[2], blocks[3], blocks[4]
    if threads is None:
        compute_chunks(
            each[0], each[1], each[2], each[3], u, v, w, dt,
            ends, table, like, share, window, len(springs[0]), ks, frail, state,
        )  # fmt: skip
    else:
        compute_chunks_in_threads(
            each[0], each[1], each[2], each[3], u, v, w, dt,
            ends, table, like, share, window, len(springs[0]), ks, frail, state,
        )  # fmt: skip
    held = each[3]
    add_chunks(push, each[0], window, len(held))
    if turn is not None:
        add_chunks(turn, each[1], window, len(held))
    normal = sheared = breaking = 0.0
    for c in range(len(held)):
        normal, sheared, breaking = normal + held[c, 0], sheared + held[c, 1], breaking + held[c, 2]
    return normal, sheared, breaking
