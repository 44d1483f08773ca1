"""Draws in which region of a plane each scheme finds points; one panel for each scheme."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from markupsafe import Markup

from reports.drawing.axes import Axis, linear_axis
from reports.drawing.svg import drawing, number, path, text
from reports.marks import Mark
from vv.case.region_map import Place, RegionMap

ACROSS = 3  # panels side by side
WIDTH, LEFT, GAP, HEAD, HEIGHT, FOOT = 470.0, 40.0, 12.0, 16.0, 118.0, 34.0
SIGNS = (
    "m-2.2-2.2h4.4v4.4h-4.4z",
    "m-3.4 0h6.8",
    "m0-3l3 5.2h-6z",
    "m0-3.2l3.2 3.2-3.2 3.2-3.2-3.2z",
)
MORE = "m-2.2 0h4.4m-2.2-2.2v4.4"  # of a mode beyond these


@dataclass(frozen=True)
class Found:
    """The results of a scheme: (point, mode, whether it is the exact one)."""

    mark: Mark
    points: Sequence[tuple[Place, int, bool]]

    @property
    def right(self) -> int:
        """The number of points at which it finds the exact mode."""
        return sum(right for _, _, right in self.points)


def draw_regions(chart: RegionMap, found: Sequence[Found]) -> Markup:
    """A panel for each scheme: the exact borders, and each point with the sign of its mode."""
    columns = min(ACROSS, len(found))
    width = (WIDTH - LEFT - GAP * (columns - 1)) / columns
    parts = []
    for place, one in enumerate(found):
        row, column = divmod(place, columns)
        corner = LEFT + column * (width + GAP), HEAD + row * (HEIGHT + HEAD)
        lowest = place + columns >= len(found)
        parts += _panel(chart, one, (*corner, width), column == 0, lowest)
    whole = HEAD + math.ceil(len(found) / columns) * (HEIGHT + HEAD) - HEAD
    parts.append(text((LEFT + WIDTH) / 2, whole + FOOT - 6, chart.x, "mid"))
    upright = f'<g transform="translate(9 {number((HEAD + whole) / 2)}) rotate(-90)">'
    parts.append(f"{upright}{text(0, 0, chart.y, 'mid')}</g>")
    return drawing(WIDTH, whole + FOOT, parts)


def key(chart: RegionMap) -> Markup:
    """The signs of the modes with their words."""
    parts = []
    for mode, word in enumerate(chart.modes):
        x = 12 + mode * WIDTH / len(chart.modes)
        parts += [_signs([(x, 8.0)], mode, "mode"), text(x + 8, 11, word)]
    return drawing(WIDTH, 16, parts)


def _panel(
    chart: RegionMap, one: Found, box: tuple[float, float, float], first: bool, lowest: bool
) -> list[str]:
    left, top, width = box
    x, y = _axes(chart, left, top, width)
    share = f"{one.mark.label}: {one.right} of {len(one.points)}"
    parts = [text(left + width / 2, top - 4, share, "mid")]
    frame = f"M{number(left)} {number(top)}h{number(width)}v{number(HEIGHT)}h{number(-width)}z"
    parts.append(f'<path class="grid" d="{frame}"/>')
    lines = (np.array(border).T for border in chart.borders)
    parts.append(f'<path class="border" d="{"".join(path(x.at(a), y.at(b)) for a, b in lines)}"/>')
    for mode in sorted({mode for _, mode, _ in one.points}):
        for right, kind in ((True, "mode"), (False, "mode wrong")):
            spots = [p for p, found, well in one.points if found == mode and well is right]
            if spots:
                parts.append(
                    _signs([(float(x.at(a)), float(y.at(b))) for a, b in spots], mode, kind)
                )
    if first:
        parts += [text(left - 4, float(y.at(at)) + 3, shown, "end tick") for at, shown in y.ticks]
    if lowest:
        parts += [
            text(float(x.at(at)), top + HEIGHT + 11, shown, "mid tick") for at, shown in x.ticks
        ]
    return parts


def _axes(chart: RegionMap, left: float, top: float, width: float) -> tuple[Axis, Axis]:
    places = [*chart.points.values(), *(place for border in chart.borders for place in border)]
    across, up = np.array(places, float).T
    return linear_axis(across, left, left + width), linear_axis(up, top + HEIGHT, top)


def _signs(spots: Sequence[tuple[float, float]], mode: int, kind: str) -> str:
    sign = SIGNS[mode] if mode < len(SIGNS) else MORE
    drawn = "".join(f"M{number(x)} {number(y)}{sign}" for x, y in spots)
    return f'<path class="{kind}" d="{drawn}"/>'


def modes_found(
    points: Mapping[str, Place], values: Mapping[str, tuple[float | None, float | None]]
) -> list[tuple[Place, int, bool]]:
    """(point, mode, whether it is the exact one); values: quantity -> its value and reference."""
    known = ((points[name], *pair) for name, pair in values.items() if name in points)
    return [(at, int(value), value == exact) for at, value, exact in known if value is not None]
