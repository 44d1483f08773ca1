"""Divides the chunks of bonds among threads; compiled only where threads are requested."""

from __future__ import annotations

from typing import TYPE_CHECKING

from vv.engines.dem.bonds.block_forces import Like
from vv.engines.dem.bonds.blocks import Ends
from vv.engines.dem.bonds.chunk_forces import compute_chunk
from vv.engines.dem.bonds.law import Frail
from vv.engines.dem.rows import Index
from vv.engines.dem.space.neighbours import State
from vv.engines.kernels.compiled import shared
from vv.scene import Vector

if TYPE_CHECKING:
    import numba


@shared
def compute_chunks_in_threads(
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
    """Compute all chunks by `compute_chunk`, in as many threads as numba is set to."""
    for c in numba.prange(len(held)):
        compute_chunk(
            push, turn, scratch, held, c, u, v, w, dt,
            ends, table, like, share, window, many, ks, frail, state,
        )  # fmt: skip
