"""Calls a kernel whose loops are distributed over threads."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import Any

SPINS = "3000000"


def on_threads(threads: int, kernel: Callable[..., int], arguments: tuple[Any, ...]) -> int:
    """Call a kernel with a number of threads; raises ValueError if numba does not allow so many."""
    import numba

    before = _threads_that_spin()
    numba.set_num_threads(threads)
    try:
        return kernel(*arguments)
    finally:
        numba.set_num_threads(before)


def _threads_that_spin() -> int:
    """Start numba's threads unless they are running; returns the number in use.

    The threads are those of OpenMP, which distribute loops evenly and can spin for some
    milliseconds while they wait: waking a thread costs as much as a step. If the user has chosen
    a threading layer or a spin count, the choice is kept.
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
