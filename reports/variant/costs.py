"""The table of costs of errors in a variant that is timed."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from reports.book import Book, Place
from reports.marks import Mark
from reports.text import brief, sci
from vv.insight.accuracy_cost import TARGETS, ErrorCost, error_cost
from vv.insight.effort import Effort
from vv.records.job_record import Record
from vv.records.rungs import describe


@dataclass(frozen=True)
class CostRow:
    """A scheme: its cost of each error, its smallest error, floors and limits in words."""

    mark: Mark
    reached: Sequence[ErrorCost]
    best: float | None
    notes: Sequence[str]


def cost_rows(book: Book, place: Place) -> list[CostRow]:
    """The cost of each of TARGETS in every scheme; empty if nothing was timed."""
    here = book.efforts.get(place, [])
    if not any(effort.timed for effort in here):
        return []
    return [
        CostRow(
            book.marks[e.label],
            [error_cost(e, target) for target in TARGETS],
            e.best,
            [*_notes(e), *_whole(book.records[place][e.label])],
        )
        for e in here
    ]


def _whole(records: Sequence[Record]) -> list[str]:
    """A note if costs are of whole processes; else empty."""
    if any(record.cost.whole for record in records):
        return ["costs of whole processes, start and output included"]
    return []


def _notes(one: Effort) -> Iterator[str]:
    """Notes on the floor, and on the model error and the step error at each stiffness."""
    if one.floor:
        yield f"{sci(one.floor.error, 1)}: {one.floor.why}"
    for row in one.rows:
        if row.kn and (text := describe(row)):
            yield f"kn = {brief(row.kn)}: {text}"
