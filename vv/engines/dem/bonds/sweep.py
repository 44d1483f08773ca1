"""The forces of all bonds, chunk by chunk; parts of kernels.

Each chunk of blocks has forces of its own, which are added up in order: the same numbers come out
however many threads share the chunks.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from vv.engines.dem.bonds.bend import HIT, Like, bend, fetch, hand_out
from vv.engines.dem.bonds.blocks import WIDE, Ends
from vv.engines.dem.bonds.law import Frail
from vv.engines.dem.rows import Index
from vv.engines.dem.space.neighbours import State
from vv.engines.kernels.compiled import lent
from vv.engines.kernels.triples import NOWHERE, put
from vv.scene import Vector

BROKEN, BREAKS = 1, 2  # states of a bond; it breaks in the step that is computed


@lent
def sweep(
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
    """Set what the bonds of chunk c do, in its window of rows.

    push, turn: forces and torques (chunks x rows, 3); scratch: a row for each chunk; held: (c, 3)
    normal and shear energies [J], and how many bonds break. many: of all bonds; state: (k, WIDE)
    0 for a whole bond, BROKEN, or BREAKS if it does so now. All else is as in `Blocks`.
    """
    base: Any = np.uint64(c * (len(push) // len(held)))  # which numba does not take for negative
    for i in range(base + np.uint64(window[c, 0]), base + np.uint64(window[c, 1])):
        put(push, i, NOWHERE)
        if w is not None:
            put(turn, i, NOWHERE)
    normal, sheared, breaking = 0.0, 0.0, 0
    for k in range(share[c], share[c + 1]):
        here = min(WIDE, many - k * WIDE)
        fetch(scratch, c, table, ends, k, here, u, v, w)
        found = bend(scratch, c, table, k, here, dt, like, ks, w, frail, state)
        if found > 0:
            breaking += found
            for q in range(here):
                if scratch[c, HIT * WIDE + q] > 0.0:
                    state[k, q] = BREAKS
        a, b = hand_out(push, turn, base, scratch, c, ends, k, here, ks, w)
        normal, sheared = normal + a, sheared + b
    held[c, 0], held[c, 1], held[c, 2] = normal, sheared, breaking


@lent
def sweep_all(
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
    """`sweep` of all chunks in turn."""
    for c in range(len(held)):
        sweep(
            push, turn, scratch, held, c, u, v, w, dt,
            ends, table, like, share, window, many, ks, frail, state,
        )  # fmt: skip
