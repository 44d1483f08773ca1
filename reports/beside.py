"""Data that a report shows in addition to the records: papers and the inputs of codes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from vv.case.published import Paper
from vv.insight.papers import Row
from vv.records.job_record import Record


def no_input(record: Record) -> str:
    """The input of no code is known."""
    return ""


@dataclass(frozen=True, eq=False)
class Beside:
    """papers: each with what became of its statements. native: the input that a code was given
    for a record, in the code's own language; empty where that cannot be said."""

    papers: Sequence[tuple[Paper, Sequence[Row]]] = ()
    native: Callable[[Record], str] = no_input


NOTHING = Beside()
