"""Divides the chunks of the bulk model among threads; compiled only where threads are requested."""

from __future__ import annotations

from typing import TYPE_CHECKING

from vv.engines.dem.bulk.chunks import add_chunk_forces, add_spare_rows, kick_head, step_chunk
from vv.engines.dem.bulk.crowd import Crowd
from vv.engines.kernels.compiled import shared

if TYPE_CHECKING:
    import numba


@shared
def add_all_in_threads(crowd: Crowd, with_energy: bool) -> None:
    """Call `add_chunk_forces` for all chunks, then `add_spare_rows` for all, each in parallel."""
    for c in numba.prange(len(crowd.work.head)):
        add_chunk_forces(c, crowd, with_energy)
    for c in numba.prange(len(crowd.work.head)):
        add_spare_rows(c, crowd)


@shared
def step_all_in_threads(crowd: Crowd, with_energy: bool, span: float) -> None:
    """Call `step_chunk` for all chunks, then `kick_head` for all heads, each in parallel."""
    for c in numba.prange(len(crowd.work.head)):
        step_chunk(c, crowd, with_energy, span)
    for c in numba.prange(len(crowd.work.head)):
        kick_head(c, crowd, span)
