"""Calls a kernel that shares its loops out to threads."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import Any

SPINS = "3000000"


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

    They are OpenMP's, which share loops out evenly and can wait awake for some milliseconds: to
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
