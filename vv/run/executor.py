"""Where batches are answered: in processes of this machine, or by the workers of a cluster."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from vv.ask import Run
from vv.run.runner import Batch, run_batches

LOCAL = "local"


class Executor(Protocol):
    """What answers batches; the runs come back in any order, each as soon as it is there."""

    @property
    def workers(self) -> int:
        """How many batches it answers at a time."""

    def run(self, batches: Iterable[Batch], timeout: float) -> Iterator[tuple[int, Run]]:
        """Yield (number, run) for every ask; timeout: seconds for each."""


@dataclass(frozen=True)
class Local:
    """Processes of this machine; scratch: makes an empty folder."""

    workers: int
    scratch: Callable[[], Path]

    def run(self, batches: Iterable[Batch], timeout: float) -> Iterator[tuple[int, Run]]:
        """As `vv.run.runner.run_batches`."""
        return run_batches(batches, self.workers, timeout, self.scratch)
