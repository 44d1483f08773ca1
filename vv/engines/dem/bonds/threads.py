"""Shares the chunks of bonds out to threads; compiled only where threads are asked for."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from vv.engines.dem.bonds.bend import Like
from vv.engines.dem.bonds.blocks import Ends
from vv.engines.dem.bonds.law import Frail
from vv.engines.dem.bonds.sweep import sweep
from vv.engines.dem.rows import Index
from vv.engines.dem.space.neighbours import State
from vv.engines.kernels.compiled import shared
from vv.scene import Vector

if TYPE_CHECKING:
    import numba

SPINS = "3000000"


@shared
def sweep_shared(
    push: Vector,
    turn: Vector,
    scratch: Vector,
    held: Vector,
    u: Vector,
    v: Vector,
    w: Vector | None,
    dt: float,
    ends: Ends,
    table: Vector,
    like: Like | None,
    share: Index,
    window: Index,
    many: int,
    ks: Vector | None,
    frail: Frail | None,
    state: State,
) -> None:
    """`sweep` of all chunks by as many threads as numba was told to use."""
    for c in numba.prange(len(held)):
        sweep(
            push, turn, scratch, held, c, u, v, w, dt,
            ends, table, like, share, window, many, ks, frail, state,
        )  # fmt: skip


def on_threads(threads: int, kernel: Callable[..., int], arguments: tuple[Any, ...]) -> int:
    """Call a kernel with so many threads to share; raises ValueError if numba may not have them."""
    import numba

    before = _threads_that_spin()
    numba.set_num_threads(threads)
    try:
        return kernel(*arguments)
    finally:
        numba.set_num_threads(before)


def _threads_that_spin() -> int:
    """Start numba's threads, unless they run; how many of them share at present.

    They are OpenMP's, which share chunks out evenly and can wait awake for some milliseconds: to
    wake one costs as much as a step. A user's own choice of either stands.
    """
    import numba

    config: Any = numba.config
    if config.THREADING_LAYER_PRIORITY == ["tbb", "omp", "workqueue"]:  # numba's own
        config.THREADING_LAYER_PRIORITY = ["omp", "tbb", "workqueue"]
    chosen = os.environ.get("GOMP_SPINCOUNT")
    os.environ["GOMP_SPINCOUNT"] = chosen or SPINS  # read once, as the first thread starts
    try:
        return int(numba.get_num_threads())
    finally:
        if chosen is None:
            del os.environ["GOMP_SPINCOUNT"]
