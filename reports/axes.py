"""Lays out the axes of a chart: limits around the data, few readable ticks, guides."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from reports.charts import Chart
from reports.text import brief, power
from vv.base.metrics import Vector

PLAIN = 1e-2  # numbers below it are written with a power of ten, each with its own
DECADES = 6  # labels on a logarithmic axis, at most about this many


def draw_axes(axes: Any, chart: Chart) -> None:
    """Limits, ticks, grid and labels; the limits are fixed before anything is drawn."""
    axes.set_xlabel(chart.x_label, labelpad=2)
    axes.set_ylabel(chart.y_label, labelpad=3)
    axes.grid(True)
    axes.tick_params(length=0, pad=4)
    for axis, log in ((axes.xaxis, chart.x_log), (axes.yaxis, chart.y_log)):
        if not log and _largest(chart, axis.axis_name) < PLAIN:
            axis.set_major_formatter(lambda tick, _: brief(tick))
    if chart.x_log:
        steps = [rim.x for rim in chart.rims if rim.x]
        _log_axis(axes.xaxis, axes.set_xlim, _positive(chart, "x", steps), 0.08)
    if chart.y_log:
        values = _positive(chart, "y", [])
        if not chart.x_log and len(values):  # dips where an error changes sign tell nothing
            values = values[values >= np.percentile(values, 4)]
        _log_axis(axes.yaxis, axes.set_ylim, values, 0.06)
    _draw_guides(axes, chart)


def _largest(chart: Chart, axis: str) -> float:
    return max((float(np.nanmax(np.abs(getattr(c, axis)))) for c in chart.curves), default=1.0)


def _positive(chart: Chart, axis: str, others: list[float]) -> Vector:
    values = [np.asarray(getattr(curve, axis), float) for curve in chart.curves]
    joined = np.concatenate([*values, np.array(others, float)])
    return np.asarray(joined[np.isfinite(joined) & (joined > 0)], float)


def _log_axis(axis: Any, set_limits: Any, values: Vector, margin: float) -> None:
    """A logarithmic axis around the values, with a label at each decade or every few."""
    low, high = (np.log10([values.min(), values.max()])) if len(values) else (-1.0, 0.0)
    pad = max(0.12, margin * (high - low))
    low, high = low - pad, high + pad
    axis.axes.set(**{f"{axis.axis_name}scale": "log"})
    set_limits(10**low, 10**high)
    ticks = _ticks(low, high)
    axis.set_ticks(list(ticks), labels=list(ticks.values()))
    axis.set_ticks([], minor=True)


def _ticks(low: float, high: float) -> dict[float, str]:
    """Tick -> label between two powers of ten; within a decade or so also 2 and 5."""
    decades = range(math.ceil(low), math.floor(high) + 1)
    if len(decades) >= 3:
        stride = math.ceil(len(decades) / DECADES)
        return {10.0**n: power(n) for n in decades if n % stride == 0}
    fine = [m * 10.0**n for n in range(math.floor(low), math.ceil(high) + 1) for m in (1, 2, 5)]
    return {tick: brief(tick) for tick in fine if low <= math.log10(tick) <= high}


def _draw_guides(axes: Any, chart: Chart) -> None:
    """Faint lines with their slope written on: rising ones from the upper right, others left."""
    if not chart.guides or not chart.curves:
        return
    (left, right), (bottom, _) = axes.get_xlim(), axes.get_ylim()
    y = max(float(curve.y.max()) for curve in chart.curves)
    for slope in chart.guides:
        ends = [float(curve.x.max() if slope > 0 else curve.x.min()) for curve in chart.curves]
        x, start = (max(ends), right) if slope > 0 else (min(ends), left)
        end = min(right, max(left, x * (bottom / y) ** (1 / slope)))
        axes.plot([start, end], [y * (p / x) ** slope for p in (start, end)], "--", color="#9aa1a9")
        spot = x * (end / x) ** 0.8
        axes.annotate(
            f"slope {slope}",
            (spot, y * (spot / x) ** slope),
            ha="center",
            va="center",
            fontsize=8,
            color="#5d656d",
            bbox={"boxstyle": "round,pad=0.15", "facecolor": "white", "edgecolor": "none"},
        )
