"""What one chunk of the bulk model does in a step; parts of kernels.

A sphere is kicked as soon as all that pushes it is known, while it is in the cache: those that it
lists come later, and those that list it came before. The head of a chunk is pushed from the chunk
before, too, and is kicked when all chunks are through. Until then no other chunk's spheres are
changed but for what is put aside for its head, so that chunks may be computed at the same time.
"""

from __future__ import annotations

from vv.engines.dem.bonds.blocks import WIDE
from vv.engines.dem.bulk.advance import kick
from vv.engines.dem.bulk.contacts.edges import lean
from vv.engines.dem.bulk.contacts.press import press
from vv.engines.dem.bulk.crowd import Crowd
from vv.engines.dem.bulk.grains import ACTS
from vv.engines.kernels.compiled import inlined, lent


@inlined
def batch(b: int, c: int, crowd: Crowd, told: bool) -> None:
    """Add all forces of batch b of chunk c; told: whether energies of springs are summed, too."""
    pairs, edges, work, rules = crowd.pairs, crowd.edges, crowd.work, crowd.rules
    begun, ended = work.first[b], work.first[b + 1]
    beyond = work.first[work.share[c + 1]], len(crowd.grains.mass) + 1
    last = pairs.start[ended]
    for first in range(pairs.start[begun], last, WIDE):
        some = first, min(first + WIDE, last)
        press(crowd, c, some, beyond, told, rules.law, rules.friction, rules.viscous)
    leaning = edges.start[begun], edges.start[ended]
    lean(crowd, c, leaning, told, rules.law, rules.friction)


@lent
def push_chunk(c: int, crowd: Crowd, told: bool) -> None:
    """Add all forces of chunk c."""
    work = crowd.work
    for b in range(work.share[c], work.share[c + 1]):
        batch(b, c, crowd, told)


@lent
def step_chunk(c: int, crowd: Crowd, told: bool, way: float) -> None:
    """Add all forces of chunk c, and kick all of its spheres but its head; way: as for `kick`."""
    work = crowd.work
    for b in range(work.share[c], work.share[c + 1]):
        batch(b, c, crowd, told)
        kick(crowd, c, max(work.first[b], work.head[c]), work.first[b + 1], way)


@lent
def gather(c: int, crowd: Crowd) -> None:
    """Add to the head of chunk c what was put aside for it."""
    work, acting, aside = crowd.work, crowd.grains.acting, len(crowd.grains.mass) + 1
    for i in range(work.first[work.share[c]], work.head[c]):
        for k in range(ACTS):
            acting[i, k] += acting[i + aside, k]
            acting[i + aside, k] = 0.0


@lent
def step_head(c: int, crowd: Crowd, way: float) -> None:
    """Kick the head of chunk c, when all chunks have pushed."""
    gather(c, crowd)
    kick(crowd, c, crowd.work.first[crowd.work.share[c]], crowd.work.head[c], way)
