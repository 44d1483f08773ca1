"""Measures solves one at a time, on one core, in rounds that visit every scheme in turn."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from vv.ask import Cost, Status
from vv.gate.speed import calibration
from vv.run.runner import Batch, run_batches

# CPU seconds spent on each point over all rounds: eighty blocks of a millisecond, of which the
# least counts; 0.2 s lowered none of 13 figures by more than 6 %, and cost half a minute more
REPEAT = 0.08
ROUNDS = 2  # every code is visited that often, so that drift of the machine hits all alike
Timed = tuple[int, Cost, float]  # job, what a solve cost, and that over the calibration kernel


def rounds(batches: Sequence[Batch], timeout: float, scratch: Callable[[], Path]) -> list[Timed]:
    """Costs of repeated solves: one for each round and job that ran."""
    seen: list[Timed] = []
    for _ in range(ROUNDS):
        for batch in batches:
            before = calibration()
            answers = list(run_batches([batch], 1, timeout, scratch))
            unit = min(before, calibration())
            for number, run in answers:
                if run.status is Status.RAN and run.cost.solve_cpu > 0:
                    seen.append((number, run.cost, run.cost.solve_cpu / unit))
    return seen
