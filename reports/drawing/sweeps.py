"""Draws measured and computed values over a condition, such as an angle."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from markupsafe import Markup, escape

from reports.drawing.svg import drawing, number, placed, text, title
from reports.marks import Mark
from vv.insight.against_measurements import Compared

WIDE, TALL, LEFT, RIGHT, EDGE = 640.0, 340.0, 58.0, 110.0, 14.0  # px
FOOT, TICKS = 44.0, 5
Curve = tuple[str, Mark, Sequence[Compared]]  # a law, who has it, and its points


def draw_sweep(curves: Sequence[Curve], quantity: str, over: str) -> Markup:
    """Measured points with bars of two standard uncertainties, and a line for each law and code."""
    seen = {one.quantity: one for _, _, points in curves for one in points}
    every = [one for _, _, points in curves for one in points]
    x = _scale([one.at or 0.0 for one in every], LEFT, WIDE - RIGHT)
    values = [value for one in every for value in (one.computed, *_ends(one))]
    y = _scale(values, TALL - FOOT, EDGE)
    parts = [*_frame(x, y, quantity, over)]
    named: set[str] = set()
    for law, mark, points in curves:
        parts += _curve(law, mark, points, x, y, law not in named)
        named.add(law)
    parts += [_bar(one, x, y) for one in seen.values()]
    return drawing(WIDE, TALL, parts)


@dataclass(frozen=True)
class Scale:
    """Values from low to high on places from first to last [px]."""

    low: float
    high: float
    first: float
    last: float

    def at(self, value: float) -> float:
        """The place of a value."""
        share = (value - self.low) / (self.high - self.low)
        return self.first + (self.last - self.first) * share

    def back(self, place: float) -> float:
        """The value at a place."""
        share = (place - self.first) / (self.last - self.first)
        return self.low + (self.high - self.low) * share


def _scale(values: Sequence[float], first: float, last: float) -> Scale:
    """A scale on which all values lie, with some room."""
    room = 0.06 * (max(values) - min(values) or 1.0)
    return Scale(min(values) - room, max(values) + room, first, last)


def _frame(x: Scale, y: Scale, quantity: str, over: str) -> Iterator[str]:
    """The axes with numbers and labels."""
    left, right, top, low = LEFT, WIDE - RIGHT, EDGE, TALL - FOOT
    yield (f'<path class="frame" d="M{number(left)} {number(top)}V{number(low)}H{number(right)}"/>')
    for k in range(TICKS):
        across = left + (right - left) * (k + 0.5) / TICKS
        up = low + (top - low) * (k + 0.5) / TICKS
        yield text(across, low + 16, f"{x.back(across):.3g}", "mid")
        yield text(left - 6, up + 4, f"{y.back(up):.3g}", "end")
    yield text((left + right) / 2, low + 36, over, "mid")
    yield text(left + 6, top + 10, quantity)


def _curve(
    law: str, mark: Mark, points: Sequence[Compared], x: Scale, y: Scale, is_first: bool
) -> Iterator[str]:
    """The line of a law in a code, with the name of the law at its first point."""
    rows = sorted(points, key=lambda one: one.at or 0.0)
    across = np.array([x.at(one.at or 0.0) for one in rows])
    up = np.array([y.at(one.computed) for one in rows])
    tip = title(f"{mark.label}, {law}")
    yield f'<g class="c{mark.colour}" data-k="{escape(mark.label)}">'
    yield f'<path class="line" d="{placed(across, up)}">{tip}</path></g>'
    if is_first:
        yield text(float(across[0]) + 4, float(up[0]) - 5, law)


def _bar(one: Compared, x: Scale, y: Scale) -> str:
    """A measured point with its bar."""
    across, up = number(x.at(one.at or 0.0)), number(y.at(one.measured))
    ends = [number(y.at(end)) for end in _ends(one)]
    tip = title(f"{one.quantity}: measured {one.measured:.4g} ± {one.uncertainty:.2g}")
    return (
        f'<path class="seen" d="M{across} {ends[0]}V{ends[1]}"/>'
        f'<circle class="seen" cx="{across}" cy="{up}" r="3">{tip}</circle>'
    )


def _ends(one: Compared) -> tuple[float, float]:
    """Two standard uncertainties below a measured value and above it."""
    return one.measured - 2 * one.uncertainty, one.measured + 2 * one.uncertainty
