"""Times a solve: once, or over again until a share of CPU time is spent."""

import time
from collections.abc import Callable
from typing import TypeVar

from vv.ask import Cost

T = TypeVar("T")


BLOCK = 1e-3  # CPU seconds of solves between two looks at the clock, which cost a microsecond


def timed(solve: Callable[[], T], repeat: float) -> tuple[T, Cost]:
    """Call `solve` and return its result with the cost of one call.

    repeat: 0 for one call; else calls are repeated until about that many CPU seconds have
    passed, in blocks long against the clock. The CPU and wall seconds stated are a call's share
    of the cheapest block; the first call only fills caches unless it spent all of `repeat`.
    """
    result, cpu, wall = _block(solve, 1)
    if cpu >= repeat:
        return result, Cost(solve_cpu=cpu, solve_wall=wall)
    calls = max(1, int(BLOCK / max(cpu, 1e-9)))
    shares: list[tuple[float, float]] = []
    spent = 0.0
    while spent < repeat:
        result, cpu, wall = _block(solve, calls)
        shares.append((cpu / calls, wall / calls))
        spent += cpu
    least, most = min(shares)[0], max(shares)[0]
    return result, Cost(
        solve_cpu=least,
        solve_wall=min(wall for _, wall in shares),
        repeats=calls * len(shares),
        spread=(most - least) / least if least > 0 else 0.0,
    )


def _block(solve: Callable[[], T], calls: int) -> tuple[T, float, float]:
    """The last result of some calls, with the CPU and wall seconds of all of them."""
    begun, started = time.perf_counter(), time.process_time()
    for _ in range(calls):
        result = solve()
    return result, time.process_time() - started, time.perf_counter() - begun
