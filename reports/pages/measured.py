"""The page of measurements: what codes compute over what was measured, with bands."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

from markupsafe import Markup, escape

from reports.book import Book
from reports.marks import Mark
from vv.insight.against_measurements import Agreement, Compared, agreements

SIZE, EDGE = 340.0, 44.0  # of the picture and its margins [px]
TICKS = 4  # along an axis


@dataclass(frozen=True)
class Line:
    """A scheme: its figures, and of how many points it is within how many bands."""

    mark: Mark
    agreement: Agreement
    within: int


@dataclass(frozen=True)
class MeasuredPart:
    """A variant: its lines, and pictures of computed over measured values."""

    link: str
    name: str
    lines: Sequence[Line]
    pictures: Sequence[Markup]


def measured(book: Book) -> list[MeasuredPart]:
    """A part for each variant with measurements."""
    found: dict[tuple[str, str], list[Agreement]] = {}
    for one in agreements(book.manifest):
        found.setdefault((one.case, one.variant), []).append(one)
    return [
        MeasuredPart(
            book.to_case(case, variant),
            f"{case}: {variant}",
            [_line(book, one) for one in group],
            _pictures(book, group),
        )
        for (case, variant), group in found.items()
    ]


def _line(book: Book, one: Agreement) -> Line:
    return Line(book.marks[one.label], one, sum(point.within for point in one.held))


def _pictures(book: Book, group: Sequence[Agreement]) -> list[Markup]:
    """A picture for each unit in which something was measured."""
    units = dict.fromkeys(point.unit for one in group for point in one.points)
    return [_picture(book, group, unit) for unit in units]


def _picture(book: Book, group: Sequence[Agreement], unit: str) -> Markup:
    """Computed over measured values of one unit; bars are two standard uncertainties."""
    every = [point for one in group for point in one.points if point.unit == unit]
    values = [value for point in every for value in (point.computed, point.measured)]
    spread = max(max(values) - min(values), 2 * max(point.uncertainty for point in every))
    low, high = min(values) - 0.08 * spread, max(values) + 0.08 * spread

    def at(value: float) -> float:
        return EDGE + (SIZE - 2 * EDGE) * min(max((value - low) / (high - low), 0.0), 1.0)

    parts = [*_frame(at(low), at(high), unit)]
    for k in range(TICKS):
        value = low + (high - low) * (k + 0.5) / TICKS
        parts.append(_text(at(value), SIZE - EDGE + 16, f"{value:.3g}", "middle"))
        parts.append(_text(EDGE - 6, SIZE - at(value) + 4, f"{value:.3g}", "end"))
    for one in group:
        shown = [point for point in one.points if point.unit == unit]
        parts += _points(book.marks[one.label], shown, at)
    title = "Computed over measured; on the line they are equal, bars are 2 standard uncertainties"
    body = "".join(parts)
    return Markup(
        f'<svg viewBox="0 0 {SIZE:g} {SIZE:g}" width="{SIZE:g}" role="img">'
        f"<title>{escape(title)}</title>{body}</svg>"
    )


def _frame(first: float, last: float, unit: str) -> Iterator[str]:
    """Axes, the line on which both are equal, and what is along them."""
    style = 'fill="none" stroke="currentColor" stroke-opacity=".5"'
    yield f'<rect x="{first:.1f}" y="{SIZE - last:.1f}" width="{last - first:.1f}" '
    yield f'height="{last - first:.1f}" {style}/>'
    yield f'<path d="M{first:.1f} {SIZE - first:.1f}L{last:.1f} {SIZE - last:.1f}" {style}/>'
    yield _text(SIZE / 2, SIZE - 8, f"measured [{unit}]" if unit else "measured", "middle")
    yield (
        f'<text transform="translate(12 {SIZE / 2:g}) rotate(-90)" text-anchor="middle" '
        'font-size="12" fill="currentColor">computed</text>'
    )


def _text(x: float, y: float, text: str, anchor: str) -> str:
    return (
        f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" font-size="12" '
        f'fill="currentColor">{escape(text)}</text>'
    )


def _points(mark: Mark, points: Sequence[Compared], at: Callable[[float], float]) -> Iterator[str]:
    """Filled where a band holds them, hollow where they are shown."""
    yield f'<g class="c{mark.colour}" style="stroke:var(--c);fill:var(--c)">'
    for point in points:
        x, y = at(point.measured), SIZE - at(point.computed)
        ends = (at(point.measured + sign * point.uncertainty) for sign in (-2, 2))
        bar = f"M{next(ends):.1f} {y:.1f}H{next(ends):.1f}"
        tip = escape(
            f"{mark.label}, {point.quantity}: computed {point.computed:.4g}, measured "
            f"{point.measured:.4g} +- {point.uncertainty:.2g}"
        )
        hollow = ' style="fill:none"' if point.band is None else ""
        yield f'<path d="{bar}"/><circle cx="{x:.1f}" cy="{y:.1f}" r="3"{hollow}>'
        yield f"<title>{tip}</title></circle>"
    yield "</g>"
