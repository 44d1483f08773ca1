"""Shows how far an invocation has got: a bar on a terminal, plain lines elsewhere."""

from __future__ import annotations

import contextlib
import sys
import time
from collections import Counter
from collections.abc import Callable, Iterator

from vv.ask import Status
from vv.gate.judgement import blew_up, outcome
from vv.output.terminal import note
from vv.records.job_record import Record
from vv.records.reading import rung

EVERY = 2.0  # s between two plain lines
Shown = Callable[[Record], None]


@contextlib.contextmanager
def progress(total: int) -> Iterator[Shown]:
    """A function to call with each record: a bar on a terminal, plain lines elsewhere."""
    with _bar(total) if sys.stderr.isatty() else _lines(total) as shown:
        yield shown


@contextlib.contextmanager
def _bar(total: int) -> Iterator[Shown]:
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

    columns = (BarColumn(), TextColumn("{task.description}"), TimeElapsedColumn())
    counts: Counter[str] = Counter()
    with Progress(*columns, auto_refresh=False, transient=True) as bars:
        task = bars.add_task("running", total=total)

        def shown(record: Record) -> None:
            counts[record.status.value] += 1
            bars.update(task, advance=1, description=_counted(counts, total), refresh=True)

        yield shown


@contextlib.contextmanager
def _lines(total: int) -> Iterator[Shown]:
    counts: Counter[str] = Counter()
    last = time.monotonic()

    def shown(record: Record) -> None:
        nonlocal last
        counts[record.status.value] += 1
        lost = record.status in (Status.ERROR, Status.TIMEOUT, Status.DIVERGED)
        if lost and not blew_up(record):
            job = f"{record.case}:{record.variant} {record.label} {rung(record)}".rstrip()
            note(f"{job}: {outcome(record).value}: {record.reason}")
        if time.monotonic() - last > EVERY:
            last = time.monotonic()
            note(_counted(counts, total))

    yield shown


def _counted(counts: Counter[str], total: int) -> str:
    return f"{counts.total()} of {total}: " + ", ".join(f"{n} {w}" for w, n in counts.items())
