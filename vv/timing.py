"""Times a solve: once, or over again until a share of CPU time is spent."""

import time
from collections.abc import Callable
from typing import TypeVar

from vv.ask import Cost

T = TypeVar("T")


def timed(solve: Callable[[], T], repeat: float) -> tuple[T, Cost]:
    """Call `solve` and return its result with the cost of one call.

    repeat: 0 for one call; else calls are repeated until about that many CPU seconds have
    passed. The CPU and wall seconds stated are the least seen. The first of several calls is not
    counted, since it fills caches; nothing is left out if the budget allowed only one.
    """
    cpu: list[float] = []
    wall: list[float] = []
    while not cpu or sum(cpu) < repeat:
        begun, started = time.perf_counter(), time.process_time()
        result = solve()
        cpu.append(time.process_time() - started)
        wall.append(time.perf_counter() - begun)
    counted = slice(1 if len(cpu) > 1 else 0, None)
    cpu, wall = cpu[counted], wall[counted]
    least = min(cpu)
    spread = (max(cpu) - least) / least if least > 0 else 0.0
    return result, Cost(solve_cpu=least, solve_wall=min(wall), repeats=len(cpu), spread=spread)
