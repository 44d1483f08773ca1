"""A step of the bulk model: all chunks in turn, or by threads; parts of its kernel."""

from __future__ import annotations

from vv.engines.dem.bulk.batches import reset
from vv.engines.dem.bulk.chunks import gather, push_chunk, step_chunk, step_head
from vv.engines.dem.bulk.crowd import Crowd
from vv.engines.dem.bulk.threads import push_shared, step_shared
from vv.engines.kernels.compiled import lent


@lent
def push_all(crowd: Crowd, told: bool, threads: int | None) -> None:
    """Add all forces; all that is summed up starts from nothing.

    told: whether energies of springs are summed, too; threads: None for one core.
    """
    reset(crowd.work.sums)
    if threads is None:
        for c in range(len(crowd.work.head)):
            push_chunk(c, crowd, told)
        for c in range(len(crowd.work.head)):
            gather(c, crowd)
    else:
        push_shared(crowd, told)


@lent
def step_all(crowd: Crowd, told: bool, way: float, threads: int | None) -> None:
    """Add all forces and kick all spheres, as `push_all` and `kick` would."""
    reset(crowd.work.sums)
    if threads is None:
        for c in range(len(crowd.work.head)):
            step_chunk(c, crowd, told, way)
        for c in range(len(crowd.work.head)):
            step_head(c, crowd, way)
    else:
        step_shared(crowd, told, way)
