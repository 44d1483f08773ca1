"""The forces of all bonds, chunk by chunk; parts of kernels.

Each chunk has its own array of forces; these are added in a fixed order, so that results do not
depend on the number of threads.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from vv.engines.dem.bonds.block_forces import (
    HIT,
    Like,
    add_block_forces,
    compute_block,
    gather_ends,
)
from vv.engines.dem.bonds.blocks import WIDE, Ends
from vv.engines.dem.bonds.law import Frail
from vv.engines.dem.rows import Index
from vv.engines.dem.space.neighbours import State
from vv.engines.kernels.compiled import lent
from vv.engines.kernels.triples import NOWHERE, put
from vv.scene import Vector

BROKEN, BREAKS = 1, 2  # states of a bond: broken before, or breaking in this step


@lent
def compute_chunk(
    push: Vector,
    turn: Vector,
    scratch: Vector,
    held: Vector,
    c: int,
    u: Vector,
    v: Vector,
    w: Vector | None,
    dt: float,
    ends: Ends,
    table: Vector,
    like: Like | None,
    share: Index,
    window: Index,
    many: int,
    ks: Vector | None,
    frail: Frail | None,
    state: State,
) -> None:
    """Compute the forces of the bonds in chunk c, in the rows of its window.

    push, turn: forces and torques (chunks x rows, 3); scratch: a row for each chunk; held: (c, 3)
    normal and shear energies [J], and how many bonds break; many: how many bonds there are in all;
    state: (k, WIDE) 0 for a whole bond, BROKEN or BREAKS. The other arguments are those of `Blocks`
    and `add_bond_forces`. It is one function since half of its lines are arguments.
    """
    base: Any = np.uint64(c * (len(push) // len(held)))  # unsigned: numba tests signs
    for i in range(base + np.uint64(window[c, 0]), base + np.uint64(window[c, 1])):
        put(push, i, NOWHERE)
        if w is not None:
            put(turn, i, NOWHERE)
    normal, sheared, breaking = 0.0, 0.0, 0
    for k in range(share[c], share[c + 1]):
        here = min(WIDE, many - k * WIDE)
        gather_ends(scratch, c, table, ends, k, here, u, v, w)
        found = compute_block(scratch, c, table, k, here, dt, like, ks, w, frail, state)
        if found > 0:
            breaking += found
            for q in range(here):
                if scratch[c, HIT * WIDE + q] > 0.0:
                    state[k, q] = BREAKS
        a, b = add_block_forces(push, turn, base, scratch, c, ends, k, here, ks, w)
        normal, sheared = normal + a, sheared + b
    held[c, 0], held[c, 1], held[c, 2] = normal, sheared, breaking


@lent
def compute_chunks(
    push: Vector,
    turn: Vector,
    scratch: Vector,
    held: Vector,
    u: Vector,
    v: Vector,
    w: Vector | None,
    dt: float,
    ends: Ends,
    table: Vector,
    like: Like | None,
    share: Index,
    window: Index,
    many: int,
    ks: Vector | None,
    frail: Frail | None,
    state: State,
) -> None:
    """Compute the forces of all chunks in turn, by `compute_chunk`."""
    for c in range(len(held)):
        compute_chunk(
            push, turn, scratch, held, c, u, v, w, dt,
            ends, table, like, share, window, many, ks, frail, state,
        )  # fmt: skip
