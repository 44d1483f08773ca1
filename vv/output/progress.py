"""Shows the progress of an invocation: a bar on a terminal, plain lines elsewhere.

Only jobs that run count; stored and unsupported ones need no time.
"""

from __future__ import annotations

import contextlib
import sys
import time
from collections.abc import Iterator
from typing import TYPE_CHECKING

from vv.ask import Status
from vv.gate.judgement import blew_up, outcome
from vv.output.terminal import note
from vv.output.wording import in_words
from vv.records.job_record import Record
from vv.records.reading import rung

if TYPE_CHECKING:
    from rich.progress import Progress as Bars

EVERY = 2.0  # seconds between two plain lines
LOST = (Status.ERROR, Status.TIMEOUT, Status.DIVERGED)
EARLY = 0.1  # fraction of runs before which estimates of the remaining time are far too long
FEWEST = 3  # runs before which they are, since kernels compile and programs start
EACH = 0.2  # expected seconds per timed setting, with the start of its code
NAMED = 6  # failed jobs that are reported at once; all are listed at the end


@contextlib.contextmanager
def progress() -> Iterator[_Bar | _Lines]:
    """The display of progress: a bar on a terminal, plain lines elsewhere."""
    if not sys.stderr.isatty():
        yield _Lines()
        return
    from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

    left = (TimeRemainingColumn(compact=True), TextColumn("left"))
    columns = (BarColumn(), TextColumn("{task.completed:.0f} of {task.total:.0f} runs"), *left)
    with Progress(*columns, auto_refresh=False, transient=True) as bars:
        yield _Bar(bars)


class _Bar:
    """A progress bar."""

    def __init__(self, bars: Bars) -> None:
        self.bars = bars

    def begin(self, jobs: int) -> None:
        """Show the bar if there are jobs to run."""
        if jobs:
            self.bars.add_task("", total=jobs)

    def done(self, record: Record) -> None:
        """Advance the bar by one run."""
        for task in self.bars.task_ids:
            self.bars.update(task, advance=1, refresh=True)

    def timing(self, settings: int) -> None:
        """Say that settings are timed; the bar does not advance."""
        self.bars.console.print(_timing(settings))


class _Lines:
    """Prints a line at intervals, and one for each of the first runs that fail."""

    def __init__(self) -> None:
        self.jobs = self.count = self.lost = 0
        self.begun = self.last = time.monotonic()

    def begin(self, jobs: int) -> None:
        """Start the count and the clock."""
        self.jobs = jobs
        self.begun = self.last = time.monotonic()

    def done(self, record: Record) -> None:
        """Count a run; print the progress if the last line was long enough ago."""
        if not self.jobs:
            return
        self.count += 1
        if record.status in LOST and not blew_up(record):
            self.lost += 1
            self._name(record)
        now = time.monotonic()
        if now - self.last > EVERY and self.count < self.jobs:
            self.last = now
            note(f"{self.count} of {self.jobs} runs{self._left(now)}")

    def _left(self, now: float) -> str:
        """The remaining time in words; empty while kernels compile at the start."""
        if self.count < max(FEWEST, EARLY * self.jobs):
            return ""
        return f", about {_round((now - self.begun) / self.count * (self.jobs - self.count))} left"

    def timing(self, settings: int) -> None:
        """Say that settings are timed."""
        note(_timing(settings))

    def _name(self, record: Record) -> None:
        if self.lost <= NAMED:
            job = f"{record.case}:{record.variant} {record.label} {rung(record)}".rstrip()
            note(f"{job}: {in_words(outcome(record))}: {record.reason}")


def _round(seconds: float) -> str:
    """A time that is only estimated: 8 s, 3 min."""
    return f"{seconds:.0f} s" if seconds < 99.5 else f"{seconds / 60:.0f} min"


def _timing(settings: int) -> str:
    many = f"{settings} settings" if settings != 1 else "one setting"
    about = _round(EACH * settings)
    return f"timing {many}, one after the other on one core: about {about} on an idle machine"
