"""Executors of batches: processes of this machine, or the workers of a cluster."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from vv.ask import Run
from vv.plan.plan import Job
from vv.records.manifest import Machine
from vv.run.process import Batch
from vv.run.rounds import Timed, rounds
from vv.run.runner import run_batches
from vv.store.provenance import machine


class Executor(Protocol):
    """An executor answers batches and yields runs in any order, each once it is complete."""

    def shares(self, jobs: Sequence[Job], schemes: int) -> Iterator[tuple[int, ...]]:
        """Yield the indices of the jobs that form a batch; schemes: the number of waiting ones."""

    def run(self, batches: Iterable[Batch], timeout: float) -> Iterator[tuple[int, Run]]:
        """Yield (number, run) for every ask; timeout: seconds for each."""

    def timer(self) -> Machine:
        """The machine on which `timed` measures."""

    def timed(self, batches: Sequence[Batch], timeout: float) -> list[Timed]:
        """The costs of solves as in `vv.run.rounds`, while nothing else of this invocation runs."""


@dataclass(frozen=True)
class Local:
    """Processes of this machine; scratch: makes an empty folder."""

    workers: int
    scratch: Callable[[], Path]

    def shares(self, jobs: Sequence[Job], schemes: int) -> Iterator[tuple[int, ...]]:
        """One batch, or, if there are fewer schemes than processes, as many as keep all busy."""
        pieces = max(1, self.workers // max(1, schemes))
        yield from (tuple(range(one, len(jobs), pieces)) for one in range(min(pieces, len(jobs))))

    def run(self, batches: Iterable[Batch], timeout: float) -> Iterator[tuple[int, Run]]:
        """As `vv.run.runner.run_batches`."""
        return run_batches(batches, self.workers, timeout, self.scratch)

    def timer(self) -> Machine:
        """This machine."""
        return machine()

    def timed(self, batches: Sequence[Batch], timeout: float) -> list[Timed]:
        """As `vv.run.rounds.rounds`."""
        return rounds(batches, timeout, self.scratch)
