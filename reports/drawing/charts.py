"""Makes charts from records: plain arrays, one frozen Chart per figure."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from reports.drawing.collect import History, Ladder, Point
from reports.marks import Mark
from reports.text import brief, sci, seconds
from vv.base.metrics import Vector, pointwise_history
from vv.insight.accuracy_cost import unbeaten

Mask = npt.NDArray[np.bool_]
MARKERS = 6  # per curve over time
SUNK = 1e-3  # an error without a step that is smaller than the others by this goes on the rim


@dataclass(frozen=True, eq=False)
class Curve:
    """One code/scheme: points (k,), and which are marked, hollow, ringed, joined by a line.

    tips: what is tips of each point to who points at it; empty if nothing.
    """

    mark: Mark
    x: Vector
    y: Vector
    marked: Mask
    hollow: Mask
    ringed: Mask
    joined: Mask
    tips: tuple[str, ...] = ()


@dataclass(frozen=True)
class Rim:
    """A point outside the axes: above (no finite error) or below (too small).

    x None: its place along the axis is unknown.
    """

    mark: Mark
    x: float | None
    above: bool


@dataclass(frozen=True, eq=False)
class Chart:
    """A figure as data. guides: slopes to compare with.

    exact: the reference (x, y) as a grey line, or what `grey` says that it is.
    """

    x_label: str
    y_label: str
    x_log: bool
    y_log: bool
    curves: tuple[Curve, ...]
    exact: tuple[Vector, Vector] | None = None
    rims: tuple[Rim, ...] = ()
    guides: tuple[int, ...] = ()
    grey: str = "exact"


def trajectory(histories: Sequence[History], label: str) -> Chart | None:
    """Every code as markers on the reference; as lines where there is no reference."""
    if not histories:
        return None
    known = next((h for h in histories if h.reference is not None), None)
    curves = tuple(
        _over_time(h, h.value, place, len(histories), line=h.reference is None)
        for place, h in enumerate(histories)
    )
    exact = (known.t, known.reference) if known and known.reference is not None else None
    return Chart("t [s]", label, False, False, curves, exact)


def relative_errors(histories: Sequence[History]) -> tuple[Chart | None, dict[str, float]]:
    """|value/reference - 1| over time, and label -> largest of those too small to be drawn."""
    found = [(h, np.abs(error)) for h in histories if (error := _relative(h)) is not None]
    largest = {h.mark.label: float(np.nanmax(error)) for h, error in found}
    stepped = [largest[h.mark.label] for h, _ in found if h.dt is not None]
    sunk = {
        h.mark.label: largest[h.mark.label]
        for h, _ in found
        if h.dt is None and stepped and largest[h.mark.label] < SUNK * min(stepped)
    }
    drawn = [
        (h, error) for h, error in found if h.mark.label not in sunk and largest[h.mark.label] > 0
    ]
    curves = tuple(
        _over_time(h, error, place, len(drawn), line=True) for place, (h, error) in enumerate(drawn)
    )
    if not curves:
        return None, {}
    return Chart("t [s]", "|value / reference - 1|", False, True, curves), sunk


def error_against_step(ladders: Sequence[Ladder], label: str) -> Chart | None:
    """The judged error against dt; a scheme without dt as a level line. None without errors."""
    steps = [p.dt for ladder in ladders for p in ladder.points if p.dt is not None]
    if not steps:
        return None
    low = _sinking(ladders)
    curves = tuple(_against_step(ladders, low, (min(steps), max(steps))))
    rims = _rims(ladders, low, "dt")
    if not curves and not rims:
        return None
    return Chart("dt [s]", label, True, True, curves, rims=rims, guides=(1, 2))


def error_against_cost(ladders: Sequence[Ladder], label: str) -> Chart:
    """The judged error against the CPU seconds of the stepping loop."""
    low = _sinking(ladders)
    curves = []
    for ladder in ladders:
        inside = [p for p in ladder.points if _inside(p, low) and p.cpu > 0]
        if inside:
            hollow = [not p.timed for p in inside]
            curves.append(_curve(ladder.mark, [p.cpu for p in inside], inside, hollow))
    rims, steps = _rims(ladders, low, "cpu"), _front(ladders, low)
    name = "CPU of the stepping loop [s]"
    return Chart(
        name, label, True, True, tuple(curves), steps, rims, guides=(-1, -2), grey="the front"
    )


def _front(ladders: Sequence[Ladder], low: float) -> tuple[Vector, Vector] | None:
    """The Pareto front of error and cost as stairs; None if no point inside is timed."""
    inside = [p for ladder in ladders for p in ladder.points if _inside(p, low) and p.timed]
    front = unbeaten(sorted((p.cpu, p.error or 0.0) for p in inside if p.cpu > 0))
    if not front:
        return None
    cpu, error = np.repeat(front, 2, axis=0).T
    return cpu[1:], error[:-1]


def shares(rows: Sequence[tuple[Mark, Sequence[float]]], label: str) -> Chart | None:
    """Performance profiles: the share of entries up to a factor, as stairs; inf never counts."""
    finite = [ratio for _, row in rows for ratio in row if np.isfinite(ratio)]
    if not finite:
        return None
    end = 2.0 * max(finite)
    curves = tuple(_stairs(mark, row, end) for mark, row in rows if np.isfinite(row).any())
    name = "CPU time over that of the cheapest scheme"
    return Chart(name, label, True, False, curves)


def _stairs(mark: Mark, row: Sequence[float], end: float) -> Curve:
    ratios = sorted(ratio for ratio in row if np.isfinite(ratio))
    levels = np.arange(1, len(ratios) + 1) / len(row)
    x = np.array([*np.repeat(ratios, 2)[1:], end])
    y = np.repeat(levels, 2)
    marked = np.zeros(len(x), bool)
    marked[0::2] = True
    none = np.zeros(len(x), bool)
    return Curve(mark, x, y, marked, none, none, ~none)


def _relative(history: History) -> Vector | None:
    """The pointwise relative error; None if the reference is zero throughout."""
    if history.reference is None or not np.abs(history.reference).max() > 0:
        return None
    return pointwise_history(history.value, history.reference)


def _over_time(history: History, y: Vector, place: int, places: int, line: bool) -> Curve:
    """A curve over time, with few markers, which are offset from those of other curves."""
    stride = max(1, len(y) // MARKERS)
    marked = np.zeros(len(y), bool)
    marked[place * stride // places :: stride] = True
    none = np.zeros(len(y), bool)
    return Curve(history.mark, history.t, y, marked, none, none, none | line)


def _sinking(ladders: Iterable[Ladder]) -> float:
    """The limit below which errors are drawn on the rim: 0, or far below errors with a step."""
    stepped = [p.error for ladder in ladders for p in ladder.points if p.dt and p.error]
    return SUNK * min(stepped) if stepped else 0.0


def _inside(point: Point, low: float) -> bool:
    if point.error is None or point.error <= 0:
        return False
    return point.dt is not None or point.error > low


def _against_step(
    ladders: Sequence[Ladder], low: float, span: tuple[float, float]
) -> Iterator[Curve]:
    for ladder in ladders:
        inside = [p for p in ladder.points if _inside(p, low)]
        stepped = [p for p in inside if p.dt is not None]
        if stepped:
            steps = [p.dt for p in stepped if p.dt is not None]
            tips = [_tip(p).rpartition(";")[0] for p in stepped]  # the cost has its own chart
            curve = _curve(ladder.mark, steps, stepped, [False] * len(stepped))
            yield dataclasses.replace(curve, tips=tuple(tips))
        for point in inside:
            if point.dt is None:
                yield _curve(ladder.mark, list(span), [point, point], [False, False])


def _curve(mark: Mark, x: list[float], points: Sequence[Point], hollow: list[bool]) -> Curve:
    ringed = np.array([p.troubling for p in points])
    y = np.array([p.error for p in points], float)
    empty = np.array(hollow)
    joined = ~empty if (~empty).sum() > 1 else np.ones(len(y), bool)
    tips = tuple(map(_tip, points))
    return Curve(mark, np.array(x), y, np.ones(len(y), bool), empty, ringed, joined, tips)


def _tip(point: Point) -> str:
    """A setting, its error and its cost, from which the page's script makes the tooltip."""
    marks = ("" if point.timed else " ○") + (" ◻" if point.whole else "")
    cost = f"{seconds(point.cpu)}{marks}" if point.cpu else ""
    return f"{brief(point.dt) if point.dt else ''};{sci(point.error)};{cost}"


def _rims(ladders: Sequence[Ladder], low: float, axis: str) -> tuple[Rim, ...]:
    """The points outside the axes: failed ones above, those with too small errors below."""
    found = []
    for ladder in ladders:
        for p in ladder.points:
            x = p.dt if axis == "dt" else (p.cpu if p.cpu > 0 else None)
            if p.error is None and p.troubling:
                found.append(Rim(ladder.mark, x, above=True))
            elif p.error is not None and not _inside(p, low):
                found.append(Rim(ladder.mark, x, above=False))
    return tuple(found)
