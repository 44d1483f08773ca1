"""Writes the pieces of HTML of which a report has thousands: a template would take seconds."""

from __future__ import annotations

import functools

from markupsafe import Markup, escape

from reports.marks import Mark
from reports.outcomes import ShownOutcome
from reports.tables import NORM_NAMES, Rung
from reports.text import NONE, brief, ratio, sci, short
from vv.case import Norm


@functools.cache
def glyph(mark: Mark) -> Markup:
    """The look of a code/scheme: a line with its marker on it."""
    dash = f' stroke-dasharray="{" ".join(map(str, mark.dash))}"' if mark.dash else ""
    return Markup(
        '<svg class="glyph" viewBox="-13 -7.5 26 15" aria-hidden="true" focusable="false">'
        f'<line x1="-13" x2="13" y1="0" y2="0" stroke="{mark.colour}" stroke-width="1.8"{dash}/>'
        f'<polygon points="{mark.points}" fill="{mark.colour}" stroke="#fff" stroke-width="0.6"/>'
        "</svg>"
    )


@functools.cache
def tag(outcome: ShownOutcome, count: int | None = None) -> Markup:
    """An outcome as symbol and word, and how many of it there are."""
    symbol = f'<span class="symbol" aria-hidden="true">{escape(outcome.symbol)}</span>'
    many = "" if count is None else f" {escape(count)}"
    return Markup(
        f'<span class="tag {escape(outcome.look)}">{symbol} {escape(outcome.word)}{many}</span>'
    )


def numbers(rung: Rung, stiffness: bool, values: bool) -> Markup:
    """The cells of a rung that hold numbers. stiffness, values: whether there are columns of it."""
    knobs, one, cost = rung.record.rung, rung.quantity, rung.record.cost
    first = [knobs.dt, *([knobs.kn] if stiffness else [])]
    first += [one.value, one.reference] if values else []
    judging = one.norm or Norm.MAX
    repeated = 1 + cost.spread if cost.repeats > 1 else None
    times = (cost.startup, cost.setup, cost.solve_wall, cost.output)
    order = NONE if rung.order is None else f"{rung.order:.2f}"
    cells = [
        *(("n", brief(number)) for number in first),
        *(("n judged" if n is judging else "n", sci(one.errors.get(n))) for n in NORM_NAMES),
        *(("n", text) for text in (sci(one.tolerance, 1), ratio(rung.margin), order)),
        ("n", short(cost.solve_cpu)),
        ("name", f"● {cost.repeats}" if cost.timed else "○"),
        ("n", ratio(repeated)),
        *(("n", short(time)) for time in times),
        ("n", rung.record.steps),
    ]
    return Markup("".join(f'<td class="{kind}">{escape(text)}</td>' for kind, text in cells))
