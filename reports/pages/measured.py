"""The page of measurements: computed over measured values, with bands."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from reports.book import Book
from reports.drawing.gallery import Figure
from reports.drawing.ratios import Kind, draw_biases, draw_ratios
from reports.drawing.sweeps import Curve, draw_sweep
from reports.marks import Mark
from reports.variant.measurements import measured_figures
from vv.insight.against_measurements import Agreement, Compared, Factor, Overall, overall


@dataclass(frozen=True)
class Line:
    """A scheme: its figures, and the number of its points within each number of bands."""

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


@dataclass(frozen=True)
class Together:
    """All measurements at once: each scheme's statistics, and figures of them.

    sweeps: what was measured over a condition, with every law and code of a case.
    """

    lines: Sequence[tuple[Mark, Overall]]
    figures: Sequence[Figure]
    sweeps: Sequence[Figure]


def together(book: Book) -> Together:
    """The statistics of each scheme over all measurements."""
    found = [one for group in book.agreements.values() for one in group]
    lines = [(book.marks[one.label], one) for one in overall(found)]
    rows: list[tuple[Mark, str, Factor]] = []
    for mark, one in lines:
        rows += [(mark, "held", one.held), (mark, "all", one.every)]
    ratios = Figure(
        draw_ratios(_kinds(book)), "All measurements: computed over measured values",
        "On the line both are equal. Grey: two standard uncertainties of the measurement. Filled: "
        "judged by a band; hollow: shown only. Dots of codes that agree coincide.",
        "computed over measured values of all quantities, with a column for each kind",
    )  # fmt: skip
    biases = Figure(
        draw_biases(rows), "Bias of each scheme, with an interval of two scatters on either side",
        "Grey: two standard uncertainties of the measurements. Held: where a law is meant to hold; "
        "all: where it is only shown too.",
        "bias and scatter of each scheme; the table has the numbers",
    )  # fmt: skip
    return Together(lines, (ratios, biases) if lines else (), _sweeps(book))


def _sweeps(book: Book) -> list[Figure]:
    """A figure for each kind of value that a case has over a varied condition."""
    found: dict[tuple[str, str, str, str], list[Curve]] = {}
    for (case, variant), group in book.agreements.items():
        facts = {q.name: q for q in book.manifest.cases[case].variants[variant].quantities}
        for one in group:
            kinds: dict[tuple[str, str, str, str], list[Compared]] = {}
            for point in one.points:
                if point.at is not None:
                    of = facts[point.quantity]
                    kinds.setdefault((case, of.symbol, of.unit, point.over), []).append(point)
            for kind, points in kinds.items():
                found.setdefault(kind, []).append((variant, book.marks[one.label], points))
    return [
        Figure(
            draw_sweep(curves, f"{symbol} [{unit}]" if unit else symbol, over),
            f"{case}: {symbol} over the {over}",
            "Points: measured, with two standard uncertainties. Lines: each law, in the colour of "
            "the code; its name stands at its first point.",
            f"{symbol} of {case} over the {over}, measured and by every law and code",
        )
        for (case, symbol, unit, over), curves in found.items()
    ]


def _kinds(book: Book) -> list[Kind]:
    """Measured values by variant and symbol, in the order of the cases."""
    found: dict[tuple[str, str], dict[Mark, list[Compared]]] = {}
    for (case, variant), group in book.agreements.items():
        facts = {q.name: q for q in book.manifest.cases[case].variants[variant].quantities}
        for one in group:
            for point in one.points:
                of = f"{case}: {variant}", facts[point.quantity].symbol
                own = found.setdefault(of, {}).setdefault(book.marks[one.label], [])
                own.append(point)
    return [Kind(name, symbol, points) for (name, symbol), points in found.items()]


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
