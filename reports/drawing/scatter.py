"""Draws computed over measured values as SVG, with the error bars of the measurements."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence

import numpy as np
from markupsafe import Markup, escape

from reports.drawing.axes import linear_axis
from reports.drawing.svg import drawing, number, text, title
from reports.marks import Mark
from vv.insight.against_measurements import Compared

SIZE, EDGE = 340.0, 44.0  # of the picture and its margins [px]
Points = Mapping[Mark, Sequence[Compared]]


def draw_scatter(points: Points, quantity: str) -> Markup:
    """Computed over measured values of one quantity; bars are two standard uncertainties."""
    every = [point for own in points.values() for point in own]
    values = [value for point in every for value in (point.computed, point.measured)]
    spread = max(max(values) - min(values), 2 * max(point.uncertainty for point in every))
    ends = np.array([min(values) - 0.08 * spread, max(values) + 0.08 * spread])
    axis = linear_axis(ends, EDGE, SIZE - EDGE, 0.0)

    def at(value: float) -> float:
        return min(max(axis.place(value), EDGE), SIZE - EDGE)

    parts = [*_frame(EDGE, SIZE - EDGE, quantity)]
    for value, tip in axis.ticks:
        parts.append(text(at(value), SIZE - EDGE + 16, tip, "mid"))
        parts.append(text(EDGE - 6, SIZE - at(value) + 4, tip, "end"))
    for mark, own in points.items():
        parts += _points(mark, own, at)
    return drawing(SIZE, SIZE, parts, "chart square")


def _frame(first: float, last: float, quantity: str) -> Iterator[str]:
    """The axes with labels, and the line of equality."""
    low, high, top = number(first), number(SIZE - first), number(SIZE - last)
    far = number(last)
    yield f'<path class="frame" d="M{low} {top}H{far}V{high}H{low}zM{low} {high}L{far} {top}"/>'
    yield text(SIZE / 2, SIZE - 8, f"measured {quantity}", "mid")
    upright = f"translate(10 {number(SIZE / 2)}) rotate(-90)"
    yield f'<g transform="{upright}">{text(0, 0, f"computed {quantity}", "mid")}</g>'


def _points(mark: Mark, points: Sequence[Compared], at: Callable[[float], float]) -> Iterator[str]:
    """The points: filled if a band judges them, hollow if they are only shown."""
    yield f'<g class="c{mark.colour}" data-k="{escape(mark.label)}">'
    for point in points:
        x, y = number(at(point.measured)), number(SIZE - at(point.computed))
        ends = [number(at(point.measured + sign * point.uncertainty)) for sign in (-2, 2)]
        kind = "open" if point.band is None else "full"
        tip = (
            f"{mark.label}, {point.quantity}: computed {point.computed:.4g}, measured "
            f"{point.measured:.4g} ± {point.uncertainty:.2g}"
        )
        dot = f'<circle class="{kind}" cx="{x}" cy="{y}" r="3">{title(tip)}</circle>'
        yield f'<path class="line" d="M{ends[0]} {y}H{ends[1]}"/>{dot}'
    yield "</g>"
