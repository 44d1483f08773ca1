"""Makes the figures of a quantity with their captions and alternative texts."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from markupsafe import Markup

from reports.drawing import charts
from reports.drawing.charts import Chart
from reports.drawing.collect import History, Ladder, Point
from reports.drawing.curves import draw
from reports.drawing.maps import NO_CRITICAL, Critical, HeatMap, error_map
from reports.drawing.panels import draw_map
from reports.norms import NORM_NAMES
from reports.text import brief, listed, sci
from vv.base.metrics import POINTWISE_THRESHOLD
from vv.case import Norm
from vv.records.case_facts import QuantityFacts

FEW = 3  # the most schemes that an alternative text lists in full


@dataclass(frozen=True)
class Figure:
    """A drawing with its caption. alt: its alternative text, with the numbers."""

    svg: Markup
    title: str
    caption: str
    alt: str


def figures(
    over_time: Sequence[History],
    steps: Sequence[Ladder],
    quantity: QuantityFacts,
    norm: Norm,
    critical: Critical = NO_CRITICAL,
) -> list[Figure]:
    """The figures of a quantity: over time, its relative error over time, and its error over step.

    Errors at every stiffness and every step of a grid are drawn as a map instead of curves;
    critical: stiffness -> the step in whose multiples the steps of the map are given.
    """
    symbol = f"{quantity.symbol} [{quantity.unit}]" if quantity.unit else quantity.symbol
    error = _error(quantity, norm)
    heat = error_map(steps, critical)
    of = quantity.symbol
    last = _step(steps, error, of) if heat is None else [_map(heat, error, of)]
    return [*_trajectory(over_time, symbol), *_relative(over_time, of), *last]


def cost_figures(
    steps: Sequence[Ladder], quantity: QuantityFacts, norm: Norm, critical: Critical = NO_CRITICAL
) -> list[Figure]:
    """The figure of error against cost, unless errors are in a map; arguments as for `figures`."""
    if error_map(steps, critical) is not None:
        return []
    return _cost(steps, _error(quantity, norm), quantity.symbol)


def _error(quantity: QuantityFacts, norm: Norm) -> str:
    """The label of the axis of errors."""
    return f"error of {quantity.symbol}, norm {NORM_NAMES[norm]}"


def _map(heat: HeatMap, error: str, of: str) -> Figure:
    """The figure of a map, with the stiffness of the smallest error at the finest step."""
    best = [f"{panel.mark.label} {brief(panel.best())} N/m" for panel in heat.panels]
    panels = heat.panels
    signs = {
        " Cross: no result, or an error of 100 % or more.": [p.lost() for p in panels],
        " Dash: not supported.": [p.refused & ~p.too_long for p in panels],
        " Dot: not run, since it would need too many steps.": [p.too_long for p in panels],
    }
    legend = "".join(text for text, cells in signs.items() if any(map(np.any, cells)))
    caption = f"Smallest error at the finest step: {listed(best)}.{legend}"
    ends = [
        f"{panel.mark.label} {sci(float(np.nanmin(panel.error)))} "
        f"to {sci(float(np.nanmax(panel.error)))}"
        for panel in heat.panels
    ]
    alt = f"{error} over step and stiffness: {', '.join(ends)}"
    return Figure(draw_map(heat), f"Error of {of} over step and contact stiffness", caption, alt)


def _trajectory(over_time: Sequence[History], symbol: str) -> list[Figure]:
    chart = charts.trajectory(over_time, symbol)
    if chart is None:
        return []
    rest = "; the grey line is the reference" if chart.exact else "; there is no reference"
    ends = {
        h.mark.label: (float(h.value[-1]), f"{h.mark.label} {sci(float(h.value[-1]), 6)}")
        for h in over_time
    }
    return [
        Figure(
            draw(chart),
            f"{symbol} over time",
            f"{_finest(over_time)}{rest}.",
            f"{symbol} over time; at the final time: {_in_short(ends)}",
        )
    ]


def _relative(over_time: Sequence[History], of: str) -> list[Figure]:
    chart, sunk = charts.relative_errors(over_time)
    if chart is None:
        return []
    low = [f"{name} (at most {sci(error, 1)})" for name, error in sunk.items()]
    below = f" Not drawn, far below: {listed(low)}." if low else ""
    drawn = {c.mark.label: float(np.nanmax(c.y)) for c in chart.curves}
    largest = {label: (error, f"{label} {sci(error)}") for label, error in drawn.items()}
    caption = (
        "Settings as before; error over reference at each time, left out where |reference| is "
        f"below {100 * POINTWISE_THRESHOLD:g} % of its maximum.{below}"
    )
    alt = f"Relative error of {of} over time; largest: {', '.join([_in_short(largest), *low])}"
    return [Figure(draw(chart), f"Relative error of {of} over time", caption, alt)]


def _step(steps: Sequence[Ladder], error: str, of: str) -> list[Figure]:
    chart = charts.error_against_step(steps, error)
    if chart is None or not (chart.curves or any(rim.above for rim in chart.rims)):
        return []  # no point has an error
    caption = f"Dashed: slopes for comparison.{_rims(chart)}"
    return [
        Figure(draw(chart), f"Error of {of} against step", caption, f"{error}: {_ranges(steps)}")
    ]


def _cost(steps: Sequence[Ladder], error: str, of: str) -> list[Figure]:
    chart = charts.error_against_cost(steps, error)
    if not (chart.curves or any(rim.above for rim in chart.rims)):
        return []  # no point has an error
    inside = [curve.hollow for curve in chart.curves]
    hollow, filled = any(h.any() for h in inside), any((~h).any() for h in inside)
    kinds = {
        (
            True,
            True,
        ): "Filled, joined: timed alone on one core; grey: the Pareto front. Hollow: indicative.",
        (True, False): "Timed alone on one core; grey: the Pareto front.",
        (False, True): "All hollow: indicative costs, measured while other jobs ran.",
    }
    free = sorted({s.mark.label for s in steps for p in s.points if p.error and not p.cpu > 0})
    lost = f" Not drawn, no cost measured at some setting: {listed(free)}." if free else ""
    caption = f"{kinds.get((filled, hollow), '')} One solve, without start-up.{_rims(chart)}{lost}"
    alt = f"{error} against CPU seconds: {_costs(steps)}"
    return [Figure(draw(chart), f"Error of {of} against cost", caption.strip(), alt)]


def _rims(chart: Chart) -> str:
    """The explanation of the marks at the edges."""
    above = sorted({rim.mark.label for rim in chart.rims if rim.above})
    below = sorted({rim.mark.label for rim in chart.rims if not rim.above})
    ringed = sorted({c.mark.label for c in chart.curves if c.ringed.any()})
    parts = [
        f" Ringed, outside the bound: {listed(ringed)}." if ringed else "",
        f" Crossed on the upper edge, without a result: {listed(above)}." if above else "",
        f" On the lower edge, below the axis: {listed(below)}." if below else "",
    ]
    return "".join(parts)


def _finest(over_time: Sequence[History]) -> str:
    """The steps of the drawn settings, in words."""
    steps = {h.mark.label: h.dt for h in over_time if h.dt is not None}
    if not steps:
        return "No code here has a time step"
    if len(set(steps.values())) == 1:
        return f"Finest setting, dt = {brief(next(iter(steps.values())))} s"
    usual = Counter(steps.values()).most_common(1)[0][0]
    others = [f"{name} {brief(dt)} s" for name, dt in steps.items() if dt != usual]
    return f"Finest setting of each, dt = {brief(usual)} s, but {listed(others)}"


def _ranges(steps: Sequence[Ladder]) -> str:
    """The errors of each scheme at its coarsest setting and at its finest, stiffest last."""
    by_scheme = {}
    for label, points in _known(steps).items():
        ends = dict.fromkeys((sci(points[0].error), sci(points[-1].error)))
        by_scheme[label] = points[-1].error, f"{label} {' to '.join(ends)}"
    return _in_short(by_scheme)


def _costs(steps: Sequence[Ladder]) -> str:
    """The error of each scheme at its finest setting, and its cost."""
    finest = {label: points[-1] for label, points in _known(steps).items()}
    by_scheme = {
        label: (p.error, f"{label} {sci(p.error)} for {sci(p.cpu)} s")
        for label, p in finest.items()
    }
    return _in_short(by_scheme)


def _known(steps: Sequence[Ladder]) -> dict[str, list[Point]]:
    """The points of each scheme that have an error, by label."""
    found: dict[str, list[Point]] = {}
    for ladder in steps:
        for point in ladder.points:
            if point.error is not None:
                found.setdefault(ladder.mark.label, []).append(point)
    return found


def _in_short(by_scheme: Mapping[str, tuple[float | None, str]]) -> str:
    """The texts of all schemes; of many, those with the smallest and the largest number.

    An alternative text with twelve schemes for each of four figures would be too long to listen to;
    the tables have all.
    """
    if len(by_scheme) <= FEW:
        return ", ".join(text for _, text in by_scheme.values())
    ordered = sorted(by_scheme.values(), key=lambda one: (one[0] or 0.0, one[1]))
    return f"of {len(by_scheme)} schemes, least {ordered[0][1]}, most {ordered[-1][1]}"
