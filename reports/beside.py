"""Data that a report shows in addition to the records: papers and the inputs of codes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from vv.case.published import Paper
from vv.insight.papers import Row
from vv.records.job_record import Record


def no_input(record: Record) -> str:
    """The empty input: that of no code is known."""
    return ""


@dataclass(frozen=True, eq=False)
class Beside:
    """papers: each with the rows of its statements.

    native: the native input of a code for a record; empty if it is unknown.
    """

    papers: Sequence[tuple[Paper, Sequence[Row]]] = ()
    native: Callable[[Record], str] = no_input


NOTHING = Beside()
