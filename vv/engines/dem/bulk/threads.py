"""Divides the chunks of the bulk model among threads; compiled only where threads are requested."""

from __future__ import annotations

from typing import TYPE_CHECKING

from vv.engines.dem.bulk.chunks import gather, push_chunk, step_chunk, step_head
from vv.engines.dem.bulk.crowd import Crowd
from vv.engines.kernels.compiled import shared

if TYPE_CHECKING:
    import numba


@shared
def push_shared(crowd: Crowd, with_energy: bool) -> None:
    """Call `push_chunk` for all chunks, then `gather` for all heads, each in parallel."""
    for c in numba.prange(len(crowd.work.head)):
        push_chunk(c, crowd, with_energy)
    for c in numba.prange(len(crowd.work.head)):
        gather(c, crowd)


@shared
def step_shared(crowd: Crowd, with_energy: bool, span: float) -> None:
    """Call `step_chunk` for all chunks, then `step_head` for all heads, each in parallel."""
    for c in numba.prange(len(crowd.work.head)):
        step_chunk(c, crowd, with_energy, span)
    for c in numba.prange(len(crowd.work.head)):
        step_head(c, crowd, span)
