"""Shares out the spheres of the bulk model: to batches computed at once, and to chunks of these."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vv.engines.dem.bonds.blocks import WIDE
from vv.engines.dem.bulk.grains import Short
from vv.engines.dem.bulk.near import Near
from vv.engines.kernels.bundles import bundle
from vv.engines.kernels.compiled import called, lent
from vv.scene import Vector

CHUNKS, LEAST = 8, 1000  # at most; spheres in a chunk, at least
PLACES = 33  # numbers of a contact in scratch (`press.py`)
NORMAL, SPRUNG, LOST, KINETIC, BEHIND, AHEAD, FAR, SUMS = 0, 1, 2, 3, 4, 5, 6, 8


@bundle
class Batches(NamedTuple):
    """Batch b has spheres first[b] to first[b + 1], which list about as many pairs as fill scratch.

    share (c + 1,): the batches of a chunk. head (c,): the sphere after the last of a chunk that
    spheres of the chunk before list: all before it are pushed from both. Both depend on where the
    spheres are, not on who computes them. scratch (c, PLACES x WIDE), ends (c, 4 WIDE): the
    spheres and slots of the pairs computed, and which slip; sums (c, SUMS).
    """

    first: Short
    share: Short
    head: Short
    scratch: Vector
    ends: Short
    sums: Vector


@called
def batches(pairs: Near) -> Batches:
    """Batches and chunks of the spheres of a list of pairs."""
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
    while chunks > 1 and overreach(pairs, first, many, chunks):
        chunks -= 1
    share, head = shared_out(pairs, first, many, chunks)
    return Batches(
        first,
        share,
        head,
        np.zeros((chunks, PLACES * WIDE)),
        np.zeros((chunks, 4 * WIDE), np.uint32),
        np.zeros((chunks, SUMS)),
    )


@called
def shared_out(pairs: Near, first: Short, many: int, chunks: int) -> tuple[Short, Short]:
    """share and head of so many batches in so many chunks."""
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
def overreach(pairs: Near, first: Short, many: int, chunks: int) -> bool:
    """Whether some sphere lists one that lies beyond the next chunk."""
    share, head = shared_out(pairs, first, many, chunks)
    found = False
    for c in range(1, chunks):
        found = found or head[c] > first[share[c + 1]]
    return found


@lent
def reset(sums: Vector) -> None:
    """Nothing summed up yet."""
    for c in range(len(sums)):
        for k in range(SUMS):
            sums[c, k] = 0.0


@lent
def total(sums: Vector, which: int) -> float:
    """A sum over all chunks, in their order."""
    whole = 0.0
    for c in range(len(sums)):
        whole += sums[c, which]
    return whole


@lent
def farthest(sums: Vector) -> float:
    """The largest of FAR in all chunks."""
    far = 0.0
    for c in range(len(sums)):
        far = max(far, sums[c, FAR])
    return far
