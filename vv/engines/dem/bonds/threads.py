"""Divides the chunks of bonds among threads; compiled only where threads are requested."""

from __future__ import annotations

from typing import TYPE_CHECKING

from vv.engines.dem.bonds.arrays import BondArrays
from vv.engines.dem.bonds.chunk_forces import compute_chunk
from vv.engines.dem.space.bodies import Motion
from vv.engines.kernels.compiled import shared

if TYPE_CHECKING:
    import numba


@shared
def compute_chunks_in_threads(bonds: BondArrays, motion: Motion, dt: float) -> None:
    """Compute all chunks by `compute_chunk`, in as many threads as numba is set to."""
    for c in numba.prange(len(bonds.held)):
        compute_chunk(bonds, c, motion, dt)
