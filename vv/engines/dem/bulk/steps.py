"""The step of the bulk model, by chunks in turn or in threads; parts of its kernel."""

from __future__ import annotations

from vv.engines.dem.bulk.batches import reset
from vv.engines.dem.bulk.chunks import gather, push_chunk, step_chunk, step_head
from vv.engines.dem.bulk.crowd import Crowd
from vv.engines.dem.bulk.threads import push_shared, step_shared
from vv.engines.kernels.compiled import lent


@lent
def push_all(crowd: Crowd, with_energy: bool, threads: int | None) -> None:
    """Reset all sums and add all forces.

    with_energy: whether the energies of springs are summed; threads: None for one core.
    """
    reset(crowd.work.sums)
    if threads is None:
        for c in range(len(crowd.work.head)):
            push_chunk(c, crowd, with_energy)
        for c in range(len(crowd.work.head)):
            gather(c, crowd)
    else:
        push_shared(crowd, with_energy)


@lent
def step_all(crowd: Crowd, with_energy: bool, span: float, threads: int | None) -> None:
    """Reset all sums, add all forces and kick all spheres, as `push_all` and `kick` do."""
    reset(crowd.work.sums)
    if threads is None:
        for c in range(len(crowd.work.head)):
            step_chunk(c, crowd, with_energy, span)
        for c in range(len(crowd.work.head)):
            step_head(c, crowd, span)
    else:
        step_shared(crowd, with_energy, span)
