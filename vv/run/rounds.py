"""Times solves one at a time on one core, in one or two rounds over all schemes."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass
from pathlib import Path

from vv.ask import Cost, Run, Status
from vv.gate.speed import calibration
from vv.run.process import Batch
from vv.run.runner import run_batches

# CPU seconds spent on each point in a visit: forty blocks of a millisecond, of which the least
# counts. On a busy machine a second visit lowered none of 174 figures of three repeats or more by
# more than 9 %, but 56 of fewer by up to 15 %: these are visited again.
REPEAT = 0.04
ENOUGH = 3  # with this many repeats the smallest cost is accepted
# Nor does a visit stand where the calibration kernel took more than this times its least of the
# session: the machine was slower then than for the other schemes.
DRIFT = 1.1
Timed = tuple[int, Cost, float]  # job, cost of a solve, and its CPU time in calibration kernels


@dataclass(frozen=True)
class _Visit:
    """The measurements of a batch; least, most: CPU time of the calibration kernel meanwhile."""

    batch: Batch
    seen: tuple[Timed, ...]
    least: float
    most: float

    def unsure(self, best: float) -> Batch:
        """The asks to be timed again; best: the smallest kernel time of the session."""
        stands = {number for number, cost, _ in self.seen if cost.repeats >= ENOUGH}
        return _without(self.batch, () if self.most > DRIFT * best else stands)


def rounds(batches: Sequence[Batch], timeout: float, scratch: Callable[[], Path]) -> list[Timed]:
    """The costs of the repeated solves of batches, from one visit or two for each job."""
    first = _visits(batches, timeout, scratch)
    best = min((visit.least for visit in first), default=0.0)
    again = [batch for visit in first if (batch := visit.unsure(best)).asks]
    second = _visits(again, timeout, scratch)
    return [one for visit in (*first, *second) for one in visit.seen]


def _visits(batches: Sequence[Batch], timeout: float, scratch: Callable[[], Path]) -> list[_Visit]:
    """A visit to each batch, with the calibration kernel before and after it.

    The next batch starts, in the same worker or a new one, only when the kernel has been timed. A
    batch whose worker died is completed after the others; it is compared with all kernel times
    since it began.
    """
    batch_of = {number: batch for batch in batches for number in batch.numbers}
    answers: dict[Batch, list[tuple[int, Run]]] = {}
    begun: dict[Batch, int] = {}
    units, visits = [calibration()], []
    for number, run in run_batches(batches, 1, timeout, scratch):
        batch = batch_of[number]
        begun.setdefault(batch, len(units) - 1)
        answers.setdefault(batch, []).append((number, run))
        if len(answers[batch]) == len(batch.numbers):
            units.append(calibration())
            visits.append(_visit(batch, answers[batch], units[begun[batch] :]))
            if len(visits) < len(batches):
                units.append(calibration())
    return visits


def _without(batch: Batch, numbers: Collection[int]) -> Batch:
    """The asks of a batch except those with these numbers."""
    left = [place for place, number in enumerate(batch.numbers) if number not in numbers]
    return dataclasses.replace(
        batch,
        numbers=tuple(batch.numbers[place] for place in left),
        asks=tuple(batch.asks[place] for place in left),
    )


def _visit(batch: Batch, answers: Sequence[tuple[int, Run]], units: Collection[float]) -> _Visit:
    """The measurements in the answers to a batch; units: kernel times meanwhile."""
    least = min(units)
    seen = (
        (number, run.cost, run.cost.solve_cpu / least)
        for number, run in answers
        if run.status is Status.RAN and run.cost.solve_cpu > 0
    )
    return _Visit(batch, tuple(seen), least, max(units))
