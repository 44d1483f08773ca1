"""Divides the spheres of the bulk model into batches, and the batches into chunks.

A batch is computed in one vectorised loop; a chunk may be computed by a thread.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vv.engines.dem.bonds.blocks import WIDE
from vv.engines.dem.bulk.grains import Short
from vv.engines.dem.bulk.near import Near
from vv.engines.kernels.bundles import bundle
from vv.engines.kernels.compiled import called, lent
from vv.scene import Vector

CHUNKS, LEAST = 8, 1000  # most chunks; fewest spheres in a chunk
PLACES = 33  # how many numbers a contact has in scratch (`gather.py`)
NORMAL, SPRUNG, LOST, KINETIC, BEHIND, AHEAD, FAR, SUMS = 0, 1, 2, 3, 4, 5, 6, 8


@bundle
class Batches(NamedTuple):
    """Batch b has the spheres first[b] to first[b + 1] (exclusive), with about WIDE pairs listed.

    share (c + 1,): chunk c has the batches share[c] to share[c + 1] (exclusive). head (c,): the
    spheres of chunk c before head[c] also get forces from the chunk before. Both depend on the
    positions of the spheres, not on threads. scratch (c, PLACES x WIDE), ends (c, 4 WIDE): the
    spheres and slots of the computed pairs, and which pairs slip; sums (c, SUMS).
    """

    first: Short
    share: Short
    head: Short
    scratch: Vector
    ends: Short
    sums: Vector


@called
def batches(pairs: Near) -> Batches:
    """The batches and chunks for a list of pairs."""
    start, n = pairs.start, len(pairs.start) - 1
    first, many = np.zeros(n + 1, np.uint32), 0
    for i in range(n):
        begun = first[many]
        if i > begun and (start[i + 1] - start[begun] > WIDE or i - begun >= WIDE):
            many += 1
            first[many] = i
    many += 1
    first[many] = n
    chunks = max(1, min(CHUNKS, n // LEAST))
    while chunks > 1 and reaches_too_far(pairs, first, many, chunks):
        chunks -= 1
    share, head = chunk_bounds(pairs, first, many, chunks)
    return Batches(
        first,
        share,
        head,
        np.zeros((chunks, PLACES * WIDE)),
        np.zeros((chunks, 4 * WIDE), np.uint32),
        np.zeros((chunks, SUMS)),
    )


@called
def chunk_bounds(pairs: Near, first: Short, many: int, chunks: int) -> tuple[Short, Short]:
    """The arrays share and head for `many` batches in `chunks` chunks."""
    share, head = np.zeros(chunks + 1, np.uint32), np.zeros(chunks, np.uint32)
    for c in range(chunks):
        share[c + 1] = (c + 1) * many // chunks
    for c in range(1, chunks):
        last = first[share[c]]
        head[c] = last
        for k in range(pairs.start[first[share[c - 1]]], pairs.start[last]):
            head[c] = max(head[c], pairs.other[k] + 1)
    return share, head


@called
def reaches_too_far(pairs: Near, first: Short, many: int, chunks: int) -> bool:
    """Whether some sphere lists a sphere beyond the next chunk."""
    share, head = chunk_bounds(pairs, first, many, chunks)
    found = False
    for c in range(1, chunks):
        found = found or head[c] > first[share[c + 1]]
    return found


@lent
def clear_sums(sums: Vector) -> None:
    """Set all sums to zero."""
    for c in range(len(sums)):
        for k in range(SUMS):
            sums[c, k] = 0.0


@lent
def total(sums: Vector, which: int) -> float:
    """A sum over all chunks, added in their order."""
    whole = 0.0
    for c in range(len(sums)):
        whole += sums[c, which]
    return whole


@lent
def farthest(sums: Vector) -> float:
    """The largest FAR of all chunks."""
    far = 0.0
    for c in range(len(sums)):
        far = max(far, sums[c, FAR])
    return far
