"""The step of the bulk model, by chunks in turn or in threads; parts of its kernel."""

from __future__ import annotations

from vv.engines.dem.bulk.batches import clear_sums
from vv.engines.dem.bulk.chunks import add_chunk_forces, add_spare_rows, kick_head, step_chunk
from vv.engines.dem.bulk.crowd import Crowd
from vv.engines.dem.bulk.threads import add_all_in_threads, step_all_in_threads
from vv.engines.kernels.compiled import lent


@lent
def add_all_forces(crowd: Crowd, with_energy: bool, threads: int | None) -> None:
    """Reset all sums and add all forces.

    with_energy: whether the energies of springs are summed; threads: None for one core.
    """
    clear_sums(crowd.work.sums)
    if threads is None:
        for c in range(len(crowd.work.head)):
            add_chunk_forces(c, crowd, with_energy)
        for c in range(len(crowd.work.head)):
            add_spare_rows(c, crowd)
    else:
        add_all_in_threads(crowd, with_energy)


@lent
def step_all(crowd: Crowd, with_energy: bool, span: float, threads: int | None) -> None:
    """Reset all sums, add all forces and kick all spheres, as `add_all_forces` and `kick` do."""
    clear_sums(crowd.work.sums)
    if threads is None:
        for c in range(len(crowd.work.head)):
            step_chunk(c, crowd, with_energy, span)
        for c in range(len(crowd.work.head)):
            kick_head(c, crowd, span)
    else:
        step_all_in_threads(crowd, with_energy, span)
