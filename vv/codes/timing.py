"""Times a solve: once, or repeated until some CPU time is spent."""

import dataclasses
import time
from collections.abc import Callable
from typing import Protocol, TypeVar

from vv.ask import Cost, Model, Run

T = TypeVar("T")


BLOCK = 1e-3  # CPU seconds of solves between two readings of the clock, which cost a microsecond


def timed(solve: Callable[[], T], repeat: float) -> tuple[T, Cost]:
    """Call `solve` and return its result with the cost of one call.

    repeat: 0 for one call; otherwise calls are repeated until about that many CPU seconds have
    passed, in blocks that are long compared with the resolution of the clock. The cost is that of
    one call in the cheapest block; the first call only fills caches, unless it took all of
    `repeat`. A process with a limit of CPU time (`ulimit -t`) has a CPU clock that moves every few
    milliseconds: where it stands still, the wall clock says how many calls make a block, and the
    mean of all blocks is what a call takes.
    """
    result, cpu, wall = _block(solve, 1)
    if cpu >= repeat:
        return result, Cost(solve_cpu=cpu, solve_wall=wall)
    calls = max(1, int(BLOCK / max(cpu or wall, 1e-9)))
    shares: list[tuple[float, float]] = []
    spent = 0.0
    while spent < repeat:
        result, cpu, wall = _block(solve, calls)
        shares.append((cpu / calls, wall / calls))
        spent += cpu
    least, most = min(shares)[0] or spent / (calls * len(shares)), max(shares)[0]
    return result, Cost(
        solve_cpu=least,
        solve_wall=min(wall for _, wall in shares),
        repeats=calls * len(shares),
        spread=(most - least) / least if least > 0 else 0.0,
    )


class Prepared(Protocol[T]):
    """An ask that an in-house engine is ready to solve."""

    @property
    def model(self) -> Model:
        """The model that was built."""

    def warm(self) -> None:
        """Load or compile the kernel."""

    def solve(self) -> T:
        """Solve; only this is timed."""

    def run(self, rows: T, /) -> Run:
        """Collect the results of a solve."""


def run_timed(prepare: Callable[[], Prepared[T]], repeat: float) -> Run:
    """The answer of an in-house engine, with the time of each part.

    Cost: setup is building the model; startup is loading the kernel, or compiling it once per
    machine; output is collecting the results.
    """
    clock = [time.process_time()]
    prepared = prepare()
    clock.append(time.process_time())
    prepared.warm()
    clock.append(time.process_time())
    rows, cost = timed(prepared.solve, repeat)
    clock.append(time.process_time())
    run = prepared.run(rows)
    output = time.process_time() - clock[3]
    setup, startup = clock[1] - clock[0], clock[2] - clock[1]
    return dataclasses.replace(
        run, cost=dataclasses.replace(cost, setup=setup, startup=startup, output=output)
    )


def _block(solve: Callable[[], T], calls: int) -> tuple[T, float, float]:
    """The last result of some calls, with the CPU and wall seconds of all of them."""
    begun, started = time.perf_counter(), time.process_time()
    for _ in range(calls):
        result = solve()
    return result, time.process_time() - started, time.perf_counter() - begun
