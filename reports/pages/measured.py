"""The page of measurements: what codes compute over what was measured, with bands."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from reports.book import Book
from reports.drawing.gallery import Figure
from reports.marks import Mark
from reports.variant.measurements import measured_figures
from vv.insight.against_measurements import Agreement


@dataclass(frozen=True)
class Line:
    """A scheme: its figures, and of how many points it is within how many bands."""

    mark: Mark
    agreement: Agreement
    within: int


@dataclass(frozen=True)
class MeasuredPart:
    """A variant: its lines, and figures of computed over measured values."""

    link: str
    name: str
    lines: Sequence[Line]
    figures: Sequence[Figure]


def measured(book: Book) -> list[MeasuredPart]:
    """A part for each variant with measurements."""
    return [
        MeasuredPart(
            book.to_case(case, variant),
            f"{case}: {variant}",
            [_line(book, one) for one in group],
            measured_figures(book, (case, variant)),
        )
        for (case, variant), group in book.agreements.items()
    ]


def _line(book: Book, one: Agreement) -> Line:
    return Line(book.marks[one.label], one, sum(point.within for point in one.held))
