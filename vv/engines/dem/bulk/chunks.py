"""The step of one chunk of the bulk model; parts of kernels.

A sphere is kicked as soon as all forces on it are known, while it is in the cache: the spheres that
it lists come later, those that list it came before. The head of a chunk also gets forces from the
chunk before, and is kicked after all chunks are computed. Until then a chunk writes only to its own
spheres and to spare rows for the next head, so that chunks can be computed at the same time.
"""

from __future__ import annotations

from vv.engines.dem.bonds.blocks import WIDE
from vv.engines.dem.bulk.advance import kick
from vv.engines.dem.bulk.contacts.pairs import add_pair_forces
from vv.engines.dem.bulk.contacts.walls import add_wall_forces
from vv.engines.dem.bulk.crowd import Crowd
from vv.engines.dem.bulk.grains import ACTS
from vv.engines.kernels.compiled import inlined, lent


@inlined
def add_batch_forces(b: int, c: int, crowd: Crowd, with_energy: bool) -> None:
    """Add all forces of batch b of chunk c; sum the energies of springs if `with_energy`."""
    pairs, edges, work, rules = crowd.pairs, crowd.edges, crowd.work, crowd.rules
    begun, ended = work.first[b], work.first[b + 1]
    beyond = work.first[work.share[c + 1]], len(crowd.grains.mass) + 1
    last = pairs.start[ended]
    for first in range(pairs.start[begun], last, WIDE):
        some = first, min(first + WIDE, last)
        add_pair_forces(
            crowd, c, some, beyond, with_energy, rules.law, rules.friction, rules.viscous
        )
    leaning = edges.start[begun], edges.start[ended]
    add_wall_forces(crowd, c, leaning, with_energy, rules.law, rules.friction)


@lent
def add_chunk_forces(c: int, crowd: Crowd, with_energy: bool) -> None:
    """Add all forces of chunk c, without a kick."""
    work = crowd.work
    for b in range(work.share[c], work.share[c + 1]):
        add_batch_forces(b, c, crowd, with_energy)


@lent
def step_chunk(c: int, crowd: Crowd, with_energy: bool, span: float) -> None:
    """Add all forces of chunk c, and kick its spheres except the head; span: as for `kick`."""
    work = crowd.work
    for b in range(work.share[c], work.share[c + 1]):
        add_batch_forces(b, c, crowd, with_energy)
        kick(crowd, c, max(work.first[b], work.head[c]), work.first[b + 1], span)


@lent
def add_spare_rows(c: int, crowd: Crowd) -> None:
    """Add to the head of chunk c the forces from the chunk before, which are in spare rows."""
    work, acting, aside = crowd.work, crowd.grains.acting, len(crowd.grains.mass) + 1
    for i in range(work.first[work.share[c]], work.head[c]):
        for k in range(ACTS):
            acting[i, k] += acting[i + aside, k]
            acting[i + aside, k] = 0.0


@lent
def kick_head(c: int, crowd: Crowd, span: float) -> None:
    """Kick the head of chunk c, after all chunks have been computed."""
    add_spare_rows(c, crowd)
    kick(crowd, c, crowd.work.first[crowd.work.share[c]], crowd.work.head[c], span)
