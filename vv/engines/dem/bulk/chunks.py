"""A step of the bulk model chunk by chunk; parts of kernels.

A sphere is kicked as soon as all that pushes it is known, while it is in the cache: those that it
lists come later, and those that list it came before. The head of a chunk is pushed from the chunk
before, too, and is kicked when all chunks are through.
"""

from __future__ import annotations

from vv.engines.dem.bonds.blocks import WIDE
from vv.engines.dem.bulk.advance import kick
from vv.engines.dem.bulk.batches import Batches, reset
from vv.engines.dem.bulk.edges import lean
from vv.engines.dem.bulk.grains import ACTS, Grains
from vv.engines.dem.bulk.near import Near
from vv.engines.dem.bulk.press import press
from vv.engines.dem.contact.law import Law
from vv.engines.dem.terms.drag import Drag
from vv.engines.kernels.compiled import inlined, lent
from vv.engines.kernels.triples import Triple
from vv.scene import Vector


@inlined
def batch(
    b: int,
    c: int,
    grains: Grains,
    pairs: Near,
    edges: Near,
    work: Batches,
    walls: Vector,
    law: Law,
    friction: tuple[float, float] | None,
    viscous: float | None,
    dt: float,
    told: bool,
) -> None:
    """Add all forces of batch b of chunk c."""
    begun, ended = work.first[b], work.first[b + 1]
    n = len(grains.mass)
    beyond = work.first[work.share[c + 1]], n + 1
    last = pairs.start[ended]
    for first in range(pairs.start[begun], last, WIDE):
        press(
            grains, pairs, work, c, first, min(first + WIDE, last), beyond,
            law, friction, viscous, dt, told,
        )  # fmt: skip
    lean(
        grains, edges, walls, work.sums, c, edges.start[begun], edges.start[ended],
        law, friction, dt, told,
    )  # fmt: skip


@lent
def push_all(
    c: int,
    grains: Grains,
    pairs: Near,
    edges: Near,
    work: Batches,
    walls: Vector,
    law: Law,
    friction: tuple[float, float] | None,
    viscous: float | None,
    dt: float,
    told: bool,
) -> None:
    """Add all forces of chunk c."""
    for b in range(work.share[c], work.share[c + 1]):
        batch(b, c, grains, pairs, edges, work, walls, law, friction, viscous, dt, told)


@lent
def step_on(
    c: int,
    grains: Grains,
    pairs: Near,
    edges: Near,
    work: Batches,
    walls: Vector,
    law: Law,
    friction: tuple[float, float] | None,
    dt: float,
    told: bool,
    spin: Vector | None,
    drag: Drag | None,
    lag: float,
    gravity: Triple,
    way: float,
) -> None:
    """Add all forces of chunk c, and kick all of its spheres but its head."""
    for b in range(work.share[c], work.share[c + 1]):
        batch(b, c, grains, pairs, edges, work, walls, law, friction, None, dt, told)
        first, last = max(work.first[b], work.head[c]), work.first[b + 1]
        kick(grains, work.sums, c, first, last, spin, dt, drag, lag, gravity, way)


@lent
def gather(c: int, grains: Grains, work: Batches) -> None:
    """Add to the head of chunk c what was put aside for it."""
    acting, aside = grains.acting, len(grains.mass) + 1
    for i in range(work.first[work.share[c]], work.head[c]):
        for k in range(ACTS):
            acting[i, k] += acting[aside + i, k]
            acting[aside + i, k] = 0.0


@lent
def all_forces(
    grains: Grains,
    pairs: Near,
    edges: Near,
    work: Batches,
    walls: Vector,
    law: Law,
    friction: tuple[float, float] | None,
    viscous: float | None,
    dt: float,
    told: bool,
) -> None:
    """Add all forces; all that is summed up starts from nothing."""
    reset(work.sums)
    for c in range(len(work.head)):
        push_all(c, grains, pairs, edges, work, walls, law, friction, viscous, dt, told)
    for c in range(len(work.head)):
        gather(c, grains, work)


@lent
def whole_step(
    grains: Grains,
    pairs: Near,
    edges: Near,
    work: Batches,
    walls: Vector,
    law: Law,
    friction: tuple[float, float] | None,
    dt: float,
    told: bool,
    spin: Vector | None,
    drag: Drag | None,
    lag: float,
    gravity: Triple,
    way: float,
) -> None:
    """Add all forces and kick all spheres, as `all_forces` and `kick` would."""
    reset(work.sums)
    for c in range(len(work.head)):
        step_on(
            c, grains, pairs, edges, work, walls, law, friction, dt, told,
            spin, drag, lag, gravity, way,
        )  # fmt: skip
    for c in range(len(work.head)):
        gather(c, grains, work)
        first, last = work.first[work.share[c]], work.head[c]
        kick(grains, work.sums, c, first, last, spin, dt, drag, lag, gravity, way)
