"""Draws a chart as SVG; colours come from the page's style, by classes."""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence

import numpy as np
from markupsafe import Markup, escape

from reports.drawing.axes import Axis, linear_axis, log_axis
from reports.drawing.charts import Chart, Curve, Mask, Rim
from reports.drawing.svg import (
    BUCKETS,
    ROUGH,
    drawing,
    number,
    path,
    placed,
    text,
    thinned,
    title,
)
from reports.marks import UNNUMBERED, Mark
from vv.base.metrics import Vector

WIDTH, HEIGHT = 470.0, 290.0
LEFT, RIGHT, TOP, BOTTOM = 52.0, 356.0, 10.0, 248.0  # of the axes; names of curves to the right,
# where the page's style moves them
SMALL, LARGER = 3.0, 0.2  # radius of a marker, and how much larger each next size is
SIZES = 8  # beyond the least, which the page's style knows: the first curve has the largest markers
LEADING = 10.5  # between names at the ends of curves
NAMED, LETTERS = 104, 19  # room for a name, and how many letters surely fit it; longer ones yield


def draw(chart: Chart) -> Markup:
    """The chart as an <svg> element; the same chart gives the same bytes."""
    x, y = _axes(chart)
    parts = [*_frame(chart, x, y), *_guides(chart, x, y)]
    if chart.exact:
        line = path(*thinned(x.at(chart.exact[0]), y.at(chart.exact[1])))
        parts.append(f'<path class="exact" d="{line}"/>')
    sizes = np.linspace(SIZES, 0, len(chart.curves)) if chart.x_log else [0] * 99
    names = _names({curve.mark.label: _end(curve, x, y) for curve in chart.curves})
    buckets = ROUGH if chart.y_log and not chart.x_log else BUCKETS
    for curve, size in zip(chart.curves, sizes, strict=False):
        name = names.pop(curve.mark.label, "")
        parts.append(_curve(curve, x, y, round(float(size)), name, buckets))
    parts += [_rim(rim, x, place) for place, rim in enumerate(chart.rims)]
    return drawing(WIDTH, HEIGHT, parts, attributes=_zoom_data(chart, x, y))


def _zoom_data(chart: Chart, x: Axis, y: Axis) -> str:
    """The axes for the zoom of the page; empty where a curve turns back, which it cannot draw."""
    if not (chart.x_log or all(np.all(np.diff(curve.x) >= 0) for curve in chart.curves)):
        return ""
    grey = f' data-grey="{escape(chart.grey)}"' if chart.exact else ""
    return f' data-x="{x.limits()}" data-y="{y.limits()}"{grey}'


def _axes(chart: Chart) -> tuple[Axis, Axis]:
    """The axes, with limits around all data."""
    steps = [rim.x for rim in chart.rims if rim.x]
    across = _values(chart, "x", steps)
    if chart.x_log:
        x = log_axis(across[across > 0], 0.06, LEFT, RIGHT)
    else:
        x = linear_axis(across, LEFT, RIGHT, 0.0)
    up = _values(chart, "y", [])
    if not chart.y_log:
        more = chart.exact[1] if chart.exact else up
        return x, linear_axis(np.concatenate([up, more[np.isfinite(more)]]), BOTTOM, TOP)
    up = up[up > 0]
    if not chart.x_log and len(up):  # dips where an error changes sign are meaningless
        up = up[up >= np.percentile(up, 4)]
    return x, log_axis(up, 0.06, BOTTOM, TOP)


def _values(chart: Chart, axis: str, others: list[float]) -> Vector:
    joined = np.concatenate([*(getattr(c, axis) for c in chart.curves), np.array(others, float)])
    return np.asarray(joined[np.isfinite(joined)], float)


def _frame(chart: Chart, x: Axis, y: Axis) -> list[str]:
    """The grid, ticks and labels of both axes."""
    columns = [(x.place(tick), shown) for tick, shown in x.ticks]
    rows = [(y.place(tick), shown) for tick, shown in y.ticks]
    grid = [f"M{number(p)} {TOP:g}V{BOTTOM:g}" for p, _ in columns]
    grid += [f"M{LEFT:g} {number(p)}H{RIGHT:g}" for p, _ in rows]
    across = "".join(f'<text x="{number(p)}">{escape(shown)}</text>' for p, shown in columns)
    up = "".join(f'<text y="{number(p)}">{escape(shown)}</text>' for p, shown in rows)
    return [
        f'<path class="grid" d="{"".join(grid)}"/>',
        f'<g class="mid" transform="translate(0 {BOTTOM + 13:g})">{across}</g>',
        f'<g class="end" transform="translate({LEFT - 5:g} 3)">{up}</g>',
        text((LEFT + RIGHT) / 2, HEIGHT - 10, chart.x_label, "mid"),
        f'<text class="up">{escape(chart.y_label)}</text>',
    ]


def _curve(curve: Curve, x: Axis, y: Axis, size: int, name: str, buckets: int) -> str:
    """The group of a curve: line, markers, rings around those out of bounds, and name."""
    px, py = x.at(curve.x), np.clip(y.at(curve.y), TOP - 4, BOTTOM + 4)
    parts = []
    if curve.joined.sum() > 1:
        line = path(*thinned(px[curve.joined], py[curve.joined], buckets))
        parts.append(f'<path class="line" d="{line}"/>')
    for kind, chosen in (("dots", ~curve.hollow), ("holes", curve.hollow)):
        parts.append(_markers(curve, px, py, chosen & curve.marked, kind))
    if curve.ringed.any():
        round_it = [
            _ring(*spot, SMALL + LARGER * size + 3)
            for spot in zip(px, py, curve.ringed, strict=True)
        ]
        parts.append(f'<path class="ring" d="{"".join(round_it)}"/>')
    return _group(curve.mark, "".join([*parts, name]), size)


def _group(mark: Mark, inner: str, size: int = 0) -> str:
    """What belongs to a code/scheme; size: of its markers, 0 is the least."""
    large = f" s{size}" if size else ""
    if mark.number == UNNUMBERED:
        return f'<g class="key c{mark.colour}" data-k="{escape(mark.label)}">{inner}</g>'
    return f'<g class="k{mark.number}{large}">{inner}</g>'


def _markers(curve: Curve, px: Vector, py: Vector, chosen: Mask, kind: str) -> str:
    """The markers of one kind: a path through their places, on which the page's style puts them.

    What is known of each stands beside it for who points at it.
    """
    known = np.flatnonzero(chosen & np.isfinite(px) & np.isfinite(py))
    if not len(known):
        return ""
    tips = "|".join(curve.tips[i] for i in known) if curve.tips else ""
    tip = f' data-tip="{escape(tips)}"' if tips else ""
    return f'<path class="{kind}" d="{placed(px[known], py[known])}"{tip}/>'


def _ring(x: float, y: float, ringed: bool, r: float) -> str:
    if not ringed:
        return ""
    return (
        f"M{number(x - r)} {number(y)}a{r:.3g} {r:.3g} 0 1 0 {2 * r:.3g} 0"
        f"a{r:.3g} {r:.3g} 0 1 0 {-2 * r:.3g} 0"
    )


def _rim(rim: Rim, x: Axis, place: int) -> str:
    """A mark at the upper edge, crossed out, or at the lower one, with an arrow down."""
    px = x.place(rim.x) if rim.x else RIGHT - 12 - 14 * (place % 18)
    py = TOP if rim.above else BOTTOM
    a, b = number(px), number(py)
    sign = (
        f"M{number(px - 4)} {number(py - 4)}l8 8m-8 0l8-8"
        if rim.above
        else f"M{a} {b}v9m-3-4l3 4l3-4"
    )
    shown = f"{rim.mark.label}: {'no result' if rim.above else 'error below the axis'}"
    cross = "lost" if rim.above else "sunk"
    shape = placed(np.array([px]), np.array([py]))
    inner = f'{title(shown)}<path class="holes" d="{shape}"/><path class="{cross}" d="{sign}"/>'
    return _group(rim.mark, inner)


def _end(curve: Curve, x: Axis, y: Axis) -> tuple[float, float]:
    """The point at which a curve is named: its rightmost one."""
    px, py = x.at(curve.x), np.clip(y.at(curve.y), TOP, BOTTOM)
    finite = np.flatnonzero(np.isfinite(px) & np.isfinite(py))
    if not len(finite):
        return RIGHT, BOTTOM
    last = finite[np.argmax(px[finite])]
    return float(px[last]), float(py[last])


def _names(ends: Mapping[str, tuple[float, float]]) -> dict[str, str]:
    """Label -> its name beside the axes, led to by a thin line; none stands over another."""
    ordered = sorted(ends.items(), key=lambda end: (end[1][1], end[0]))
    places = _apart([spot[1] for _, spot in ordered])
    made = {}
    for (label, spot), y in zip(ordered, places, strict=True):
        lead = f"M{number(spot[0] + 4)} {number(spot[1])}L{RIGHT + 5:g} {number(y)}"
        near = spot[0] > RIGHT - 4 and abs(spot[1] - y) < 2
        line = "" if near else f'<path d="{lead}"/>'
        narrow = f' textLength="{NAMED}" lengthAdjust="spacingAndGlyphs"'
        fitted = narrow if len(label) > LETTERS else ""
        made[label] = f'{line}<text y="{number(y + 3)}"{fitted}>{escape(label)}</text>'
    return made


def _apart(wanted: Sequence[float]) -> list[float]:
    """Ascending positions, a line apart, and as close to the wanted ones as possible."""
    room = BOTTOM + 30 - TOP
    step = min(LEADING, room / max(1, len(wanted)))
    found: list[float] = []
    for place in wanted:
        found.append(max(place, found[-1] + step) if found else max(place, TOP))
    over = max(0.0, found[-1] - (BOTTOM + 30)) if found else 0.0
    for i in range(len(found) - 1, -1, -1):
        above = found[i + 1] - step if i + 1 < len(found) else found[i] - over
        found[i] = min(found[i], above)
    return found


WIDE, HIGH = 48.0, 13.0  # of the text on a guide [px], with space


def _guides(chart: Chart, x: Axis, y: Axis) -> list[str]:
    """Faint lines with their slope written on: rising ones from the upper right, others left."""
    if not chart.guides or not chart.curves:
        return []
    parts, taken = [], list[tuple[float, float]]()
    top = max(float(curve.y.max()) for curve in chart.curves)
    for slope in chart.guides:
        ends = [float(c.x.max() if slope > 0 else c.x.min()) for c in chart.curves]
        at = max(ends) if slope > 0 else min(ends)
        heights_of_rims = (max(y.value(part) / top, sys.float_info.min) for part in (1.0, 0.0))
        rims = [at * height ** (1 / slope) for height in heights_of_rims]
        start, end = np.clip(rims, x.value(0.0), x.value(1.0)).tolist()
        spots = np.array([start, end])
        heights = top * (spots / at) ** slope
        parts.append(f'<path class="guide" d="{path(x.at(spots), y.at(heights))}"/>')
        spot = at * (end / at) ** 0.8
        across, down = float(x.at(spot)), float(y.at(top * (spot / at) ** slope))
        while any(abs(across - a) < WIDE and abs(down - b) < HIGH for a, b in taken):
            down += HIGH
        place = across, down
        taken.append(place)
        parts.append(text(*place, f"slope {slope}", "guided"))
    return parts
