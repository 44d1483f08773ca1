"""Hands the chunks of the bulk model to threads; compiled only where threads are asked for."""

from __future__ import annotations

from typing import TYPE_CHECKING

from vv.engines.dem.bulk.chunks import gather, push_chunk, step_chunk, step_head
from vv.engines.dem.bulk.crowd import Crowd
from vv.engines.kernels.compiled import shared

if TYPE_CHECKING:
    import numba


@shared
def push_shared(crowd: Crowd, told: bool) -> None:
    """`push_chunk` of all chunks, then `gather` of all heads, each by all threads."""
    for c in numba.prange(len(crowd.work.head)):
        push_chunk(c, crowd, told)
    for c in numba.prange(len(crowd.work.head)):
        gather(c, crowd)


@shared
def step_shared(crowd: Crowd, told: bool, way: float) -> None:
    """`step_chunk` of all chunks, then `step_head` of all heads, each by all threads."""
    for c in numba.prange(len(crowd.work.head)):
        step_chunk(c, crowd, told, way)
    for c in numba.prange(len(crowd.work.head)):
        step_head(c, crowd, way)
