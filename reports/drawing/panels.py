"""Draws a map of errors as SVG: a panel for each code, all with the same colour scale."""

from __future__ import annotations

import math

import numpy as np
from markupsafe import Markup

from reports.drawing.maps import HeatMap, Panel
from reports.drawing.svg import drawing, number, text, title
from reports.text import brief, power, sci
from vv.insight.stability_summary import WRONG

ACROSS = 3  # panels in a row
WIDTH, LEFT, BAR, GAP, HEAD, FOOT = 470.0, 46.0, 44.0, 10.0, 16.0, 46.0
LEAST, MOST = 66.0, 150.0  # heights of a panel
# viridis (van der Walt and Smith 2015) in eleven steps; dark is wrong
SCALE = (
    "#fde725", "#bddf26", "#7ad151", "#44bf70", "#22a884", "#21918c", "#2a788e", "#355f8d",
    "#414487", "#482475", "#440154",
)  # fmt: skip


def draw_map(heat: HeatMap) -> Markup:
    """The panels in rows, and the scale beside them.

    A diverged cell has a cross, a refused one a dash, one with too many steps a dot.
    """
    ends = _ends(heat)
    columns = min(ACROSS, len(heat.panels))
    rows = math.ceil(len(heat.panels) / columns)
    width = (WIDTH - LEFT - BAR - GAP * (columns - 1)) / columns
    height = max(LEAST, MOST / rows)
    parts = []
    for place, panel in enumerate(heat.panels):
        row, column = divmod(place, columns)
        x, y = LEFT + column * (width + GAP), HEAD + row * (height + HEAD)
        lowest = place + columns >= len(heat.panels)
        parts += _panel(panel, (x, y, width, height), ends, column == 0, lowest)
    whole = HEAD + rows * (height + HEAD) - HEAD
    parts += _bar(ends, HEAD, whole)
    step = "dt / critical step" if heat.critical else "dt [s]"
    parts.append(text((LEFT + WIDTH - BAR) / 2, whole + FOOT - 4, step, "mid"))
    upright = f'<g transform="translate(9 {(HEAD + whole) / 2:g}) rotate(-90)">'
    parts.append(f"{upright}{text(0, 0, 'kn [N/m]', 'mid')}</g>")
    return drawing(WIDTH, whole + FOOT, parts)


def _ends(heat: HeatMap) -> tuple[int, int]:
    """The powers of ten that enclose all errors below 100 %."""
    known = np.concatenate([panel.error.ravel() for panel in heat.panels])
    known = np.minimum(known[np.isfinite(known) & (known > 0)], WRONG)
    low, high = math.floor(np.log10(known.min())), math.ceil(np.log10(known.max()))
    return low, max(high, low + 1)


def _colour(error: float, ends: tuple[int, int]) -> str:
    part = (math.log10(min(error, WRONG)) - ends[0]) / (ends[1] - ends[0])
    return SCALE[round(part * (len(SCALE) - 1))]


def _panel(
    panel: Panel,
    box: tuple[float, float, float, float],
    ends: tuple[int, int],
    first: bool,
    lowest: bool,
) -> list[str]:
    """A panel with its cells and name; steps are labelled below the last row, stiffnesses left."""
    x, y, width, height = box
    wide, high = width / len(panel.dt), height / len(panel.kn)
    lost = panel.lost()
    parts = [text(x + width / 2, y - 4, panel.mark.label, "mid")]
    for i, kn in enumerate(panel.kn.tolist()):
        top = y + height - (i + 1) * high
        if first:
            parts.append(text(x - 4, top + high / 2 + 3, brief(kn), "end tick"))
        for j, dt in enumerate(panel.dt.tolist()):
            error = float(panel.error[i, j])
            cell = x + j * wide, top, wide, high
            tip = f"kn {brief(kn)}, dt {brief(dt)}: {_in_words(panel, i, j)}"
            fill = f' fill="{_colour(error, ends)}"' if error > 0 else ' class="none"'
            parts.append(_cell(cell, fill, tip, _sign(panel, i, j, bool(lost[i, j]))))
    if lowest:
        for j, dt in enumerate(panel.dt.tolist()):
            spot = f"translate({number(x + (j + 0.5) * wide + 3)} {number(y + height + 5)})"
            parts.append(
                f'<g transform="{spot} rotate(-45)">{text(0, 5, brief(dt), "end tick")}</g>'
            )
    return parts


def _in_words(panel: Panel, i: int, j: int) -> str:
    if panel.too_long[i, j]:
        return "not run, since it would need too many steps"
    if panel.refused[i, j]:
        return "not supported"
    error = float(panel.error[i, j])
    return f"error {sci(error)}" if np.isfinite(error) else "it blew up"


def _sign(panel: Panel, i: int, j: int, lost: bool) -> str:
    """The mark on a cell: a cross, a dash or a dot at its centre."""
    if panel.too_long[i, j]:
        return '<path class="idle" d="M{x} {y}h.1"/>'
    if panel.refused[i, j]:
        return '<path class="idle" d="M{a} {y}h6"/>'
    return '<path class="lost" d="M{a} {b}l6 6m-6 0l6-6"/>' if lost else ""


def _cell(box: tuple[float, float, float, float], fill: str, tip: str, sign: str) -> str:
    x, y, width, height = box
    px, py = x + width / 2, y + height / 2
    drawn = sign.format(x=number(px), y=number(py), a=number(px - 3), b=number(py - 3))
    place = f'x="{number(x)}" y="{number(y)}" width="{number(width)}" height="{number(height)}"'
    return f"<g>{title(tip)}<rect {place}{fill}/>{drawn}</g>"


def _bar(ends: tuple[int, int], top: float, bottom: float) -> list[str]:
    """The colour scale with its powers of ten."""
    x, each = WIDTH - BAR + 10, (bottom - top) / len(SCALE)
    parts = [
        f'<rect x="{x:g}" y="{number(bottom - (i + 1) * each)}" width="8" '
        f'height="{number(each + 0.3)}" fill="{colour}"/>'
        for i, colour in enumerate(SCALE)
    ]
    stride = math.ceil((ends[1] - ends[0]) / 8)
    for n in range(ends[0], ends[1] + 1, stride):
        y = bottom - (n - ends[0]) / (ends[1] - ends[0]) * (bottom - top)
        parts.append(text(x + 11, y + 3, power(n), "tick"))
    return parts
