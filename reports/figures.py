"""Draws charts as SVG with matplotlib, which is imported only if something is not yet drawn."""

from __future__ import annotations

import functools
import hashlib
import io
import multiprocessing
import re
from collections.abc import Iterable
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np

from reports.axes import draw_axes
from reports.charts import Chart, Curve, Rim
from reports.maps import HeatMap, draw_map
from reports.marks import Mark
from vv.base.digest import digest
from vv.base.files import write_whole
from vv.base.notices import notice
from vv.insight import stability_summary
from vv.output.safe_svg import is_drawing

SIZE = (4.7, 3.2)  # inches; a viewer scales it
BOX = (0.145, 0.13, 0.83, 0.84)  # the axes: left, bottom, width, height of the figure
FEW, CHUNK = 8, 4  # drawings not worth a second process; handed to one at a time
SMALL, LARGE = 6.0, 11.0  # points across a marker
INK, PALE, REFERENCE, ALARM = "#333333", "#e3e6e9", "#b4bac1", "#b3200c"
STYLE: dict[Any, Any] = {
    "svg.fonttype": "none",  # text stays text: small, sharp and searchable
    "text.parse_math": False,
    "font.family": ["sans-serif"],
    "font.sans-serif": ["DejaVu Sans"],
    "font.size": 9,
    "axes.edgecolor": "#8a9199",
    "axes.labelcolor": INK,
    "xtick.color": INK,
    "ytick.color": INK,
    "axes.linewidth": 0.7,
    "axes.axisbelow": True,
    "grid.color": PALE,
    "grid.linewidth": 0.7,
    "lines.linewidth": 1.2,
}


def draw_missing(charts: Iterable[Chart | HeatMap], folder: Path) -> None:
    """Put the SVG of each chart into the folder, on all cores, but for those that are there."""
    wanted = {f"{digest(chart, _sources())}.svg": chart for chart in charts}
    missing = [(chart, folder / n) for n, chart in wanted.items() if not _kept(folder / n)]
    if len(missing) < FEW:
        for chart, path in missing:
            _keep(chart, path)
    else:
        with ProcessPoolExecutor(mp_context=multiprocessing.get_context("fork")) as pool:
            list(pool.map(_keep, *zip(*missing, strict=True), chunksize=CHUNK))


def _keep(chart: Chart | HeatMap, path: Path) -> None:
    write_whole(path, draw(chart, salt=path.stem[:8]).encode())


def drawn_before(chart: Chart | HeatMap, folder: Path) -> str:
    """The SVG of a chart if the folder has it, else nothing."""
    if not folder.is_dir():
        return ""
    return _kept(folder / f"{digest(chart, _sources())}.svg")


def _kept(path: Path) -> str:
    """What is kept of a figure, if that is a drawing; else nothing, and it is removed."""
    if not path.is_file():
        return ""
    text = path.read_text(encoding="utf-8", errors="replace")
    if is_drawing(text):
        return text
    notice(f"{path}: no drawing of ours; it is removed, and `vv report` draws it anew")
    path.unlink(missing_ok=True)
    return ""


@functools.cache
def _sources() -> str:
    own = [Path(__file__).with_name(f"{name}.py") for name in ("axes", "figures", "maps", "text")]
    files = [*own, Path(stability_summary.__file__)]  # which says what is wrong in a map
    return hashlib.sha256(b"".join(path.read_bytes() for path in files)).hexdigest()


def draw(chart: Chart | HeatMap, salt: str) -> str:
    """The chart as an <svg> element; the same chart and salt give the same bytes.

    salt: goes into the names of what the drawing defines, so that two may stand in one page.
    """
    import matplotlib as mpl
    from matplotlib.backends.backend_svg import FigureCanvasSVG
    from matplotlib.figure import Figure

    with mpl.rc_context({**STYLE, "svg.hashsalt": salt}):
        figure = Figure(figsize=SIZE)
        FigureCanvasSVG(figure)
        if isinstance(chart, HeatMap):
            draw_map(figure, chart)
        else:
            _draw_chart(figure.add_axes(BOX), chart)
        text = io.StringIO()
        nothing = dict.fromkeys(("Date", "Creator", "Format", "Type"))
        figure.savefig(text, format="svg", transparent=True, metadata=nothing)
    return _lean(text.getvalue())


def _draw_chart(axes: Any, chart: Chart) -> None:
    draw_axes(axes, chart)
    if chart.exact:
        axes.plot(*chart.exact, color=REFERENCE, linewidth=4.5, solid_capstyle="round")
    for curve, size in zip(chart.curves, _sizes(chart), strict=True):
        _draw_curve(axes, curve, size)
    for place, rim in enumerate(chart.rims):
        _draw_rim(axes, rim, place)


def _sizes(chart: Chart) -> list[float]:
    """Marker sizes; points that may coincide get smaller and smaller ones, so that all show."""
    if not chart.x_log:
        return [SMALL] * len(chart.curves)
    return [float(size) for size in np.linspace(LARGE, SMALL - 1, len(chart.curves))]


def _draw_curve(axes: Any, curve: Curve, size: float) -> None:
    mark = curve.mark
    if curve.joined.any():
        dash = (0, mark.dash) if mark.dash else "-"
        line = curve.x[curve.joined], curve.y[curve.joined]
        axes.plot(*line, color=mark.colour, linestyle=dash)
    if curve.ringed.any():
        spots = curve.x[curve.ringed], curve.y[curve.ringed]
        axes.plot(
            *spots, "o", markersize=size + 5, color="none", markeredgecolor=ALARM, clip_on=False
        )
    for kind, face in ((~curve.hollow, mark.colour), (curve.hollow, "white")):
        chosen = kind & curve.marked
        if chosen.any():
            axes.plot(curve.x[chosen], curve.y[chosen], **_marker(mark, face, size))


def _draw_rim(axes: Any, rim: Rim, place: int) -> None:
    """A mark on the upper rim, crossed out, or on the lower one, with an arrow down."""
    height = 1.0 if rim.above else 0.0
    known = rim.x is not None
    x = rim.x if known else 0.96 - 0.05 * (place % 18)
    frame = axes.get_xaxis_transform() if known else axes.transAxes
    axes.plot(x, height, transform=frame, clip_on=False, **_marker(rim.mark, "white"))
    sign, size = ("x", 9) if rim.above else (3, 6)  # 3: matplotlib's caret pointing down
    colour = ALARM if rim.above else rim.mark.colour
    axes.plot(x, height, transform=frame, clip_on=False, marker=sign, markersize=size, color=colour)


def _marker(mark: Mark, face: str, size: float = SMALL) -> dict[str, Any]:
    extent = max(abs(part) for corner in mark.shape for part in corner)  # drawn as size
    return {
        "linestyle": "none",
        "marker": [*mark.shape, mark.shape[0]],
        "markersize": size * extent,
        "markerfacecolor": face,
        "markeredgecolor": mark.colour if face == "white" else "white",
        "markeredgewidth": 1.1 if face == "white" else 0.5,
        "zorder": 3,
    }


NUMBER = re.compile(r"-?\d+\.\d{3,}")
DRAWN = re.compile(r'(?<= )(?:d|x|y|points|transform)="[^"]*"')
UNUSED = re.compile(r' id="(?:figure|axes|patch|line2d|text|xtick|ytick|matplotlib\.axis)_?\d*"')


def _lean(svg: str) -> str:
    """Only the <svg> element, without fixed size, unused names and digits no one can see."""
    body = svg[svg.index("<svg") :].strip()
    box = re.search(r'viewBox="[^"]*"', body)
    inner = body[body.index(">") + 1 :].replace("xlink:href=", "href=")
    inner = UNUSED.sub("", inner)
    inner = DRAWN.sub(lambda part: NUMBER.sub(_two_digits, part[0]), inner)
    inner = re.sub(r"\s*\n\s*", "\n", inner)
    opening = f'<svg xmlns="http://www.w3.org/2000/svg" {box[0] if box else ""}'
    return f'{opening} aria-hidden="true" focusable="false">{inner}'


def _two_digits(number: re.Match[str]) -> str:
    return f"{float(number[0]):.2f}"
