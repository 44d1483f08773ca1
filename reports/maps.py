"""The map of an error over step and stiffness: a panel for each code, as data and drawn."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from reports.collect import Ladder
from reports.marks import Mark
from reports.text import brief, power
from vv.base.metrics import Vector
from vv.insight.stability_summary import WRONG

LEAST = 3  # stiffnesses and steps without which there is no map
ACROSS = 3  # panels side by side
Mask = npt.NDArray[np.bool_]
Critical = Mapping[float | None, float]
NO_CRITICAL: Critical = {}
COLOURS = "viridis_r"  # dark is wrong
GREY = "#8a9199"
BOX = (0.125, 0.115, 0.745, 0.81)  # the panels: left, bottom, width, height of the figure
BAR = (0.895, 0.115, 0.025, 0.81)
GAP = (0.03, 0.065)


@dataclass(frozen=True, eq=False)
class Panel:
    """One code/scheme: steps (n,) and stiffnesses (m,) [N/m] ascending, errors (m, n).

    dt: [s], or over the critical step of each stiffness. An error that is not finite is nan;
    refused (m, n) says where it is so because the code did not take the step, too_long where
    that is for the number of steps.
    """

    mark: Mark
    dt: Vector
    kn: Vector
    error: Vector
    refused: Mask
    too_long: Mask

    def best(self) -> float:
        """The stiffness [N/m] of the smallest error at the finest step that has any."""
        columns = np.isfinite(self.error).any(axis=0)
        return float(self.kn[np.nanargmin(self.error[:, int(np.argmax(columns))])])

    def lost(self) -> Mask:
        """(m, n) where it blew up, or gave an answer off by as much as the answer itself."""
        return np.asarray(~self.refused & ~(self.error < WRONG))


@dataclass(frozen=True, eq=False)
class HeatMap:
    """All panels, on one scale of colours; critical: steps are multiples of a critical one."""

    panels: tuple[Panel, ...]
    critical: bool


def error_map(ladders: Sequence[Ladder], critical: Critical = NO_CRITICAL) -> HeatMap | None:
    """The map, if every stiffness of some code was run at one and the same few steps.

    critical: stiffness [N/m] -> what steps are multiples of [s]; where empty, they are as such.
    """
    piles: dict[str, list[Ladder]] = {}
    for ladder in ladders:
        if ladder.kn is not None and (not critical or ladder.kn in critical):
            piles.setdefault(ladder.mark.label, []).append(ladder)
    panels = [panel for pile in piles.values() if (panel := _panel(pile, critical)) is not None]
    return HeatMap(tuple(panels), bool(critical)) if panels else None


def _panel(pile: Sequence[Ladder], critical: Critical) -> Panel | None:
    cells = {
        (ladder.kn, _ratio(p.dt, critical.get(ladder.kn))): p
        for ladder in pile
        for p in ladder.points
        if ladder.kn is not None and p.dt is not None
    }
    if not cells:  # a code without a step
        return None
    stiffnesses, steps = (sorted(set(parts)) for parts in zip(*cells, strict=True))
    whole = len(cells) == len(stiffnesses) * len(steps)
    if not whole or sorted((len(stiffnesses), len(steps)))[0] < LEAST - 1:
        return None
    if max(len(stiffnesses), len(steps)) < LEAST:
        return None
    rows = [[cells[kn, step] for step in steps] for kn in stiffnesses]
    error = np.array([[np.nan if p.error is None else p.error for p in row] for row in rows])
    refused = np.array([[p.refused for p in row] for row in rows])
    too_long = np.array([[p.too_long for p in row] for row in rows])
    if not (error > 0).any():
        return None
    return Panel(pile[0].mark, np.array(steps), np.array(stiffnesses), error, refused, too_long)


def _ratio(dt: float, critical: float | None) -> float:
    """A step as it is, or over the critical one, without the roundings of that."""
    return dt if critical is None else float(f"{dt / critical:.6g}")


def draw_map(figure: Any, heat: HeatMap) -> None:
    """Draw the panels in rows, and the scale beside them.

    A cell that blew up is crossed, one that was refused has a dash, one too long to run a dot.
    """
    from matplotlib.colors import LogNorm

    known = np.concatenate([panel.error.ravel() for panel in heat.panels])
    known = np.minimum(known[np.isfinite(known) & (known > 0)], WRONG)
    ends = math.floor(np.log10(known.min())), math.ceil(np.log10(known.max()))
    scale = LogNorm(10.0 ** ends[0], 10.0 ** ends[1])
    columns = min(ACROSS, len(heat.panels))
    rows = math.ceil(len(heat.panels) / columns)
    width = (BOX[2] - GAP[0] * (columns - 1)) / columns
    height = (BOX[3] - GAP[1] * (rows - 1)) / rows
    for place, panel in enumerate(heat.panels):
        row, column = divmod(place, columns)
        left = BOX[0] + column * (width + GAP[0])
        bottom = BOX[1] + (rows - 1 - row) * (height + GAP[1])
        lowest = place + columns >= len(heat.panels)
        axes = figure.add_axes((left, bottom, width, height))
        axes.tick_params(length=0, pad=2, labelsize=6 if rows < ACROSS else 5)
        mesh = _draw_panel(axes, panel, scale)
        _label(axes, panel, column == 0, lowest, STEP[heat.critical])
    bar = figure.colorbar(mesh, cax=figure.add_axes(BAR))
    ticks = range(ends[0], ends[1] + 1)
    bar.set_ticks([10.0**n for n in ticks], labels=[power(n) for n in ticks], fontsize=7)
    bar.set_ticks([], minor=True)
    bar.outline.set_visible(False)


def _draw_panel(axes: Any, panel: Panel, scale: Any) -> Any:
    shown = np.ma.masked_invalid(np.where(panel.error > 0, panel.error, np.nan))
    axes.set_facecolor("#e3e6e9")
    refused = panel.refused & ~panel.too_long
    signs = ((panel.lost(), "x", "#e0452b"), (refused, "_", GREY), (panel.too_long, ".", GREY))
    for cells, sign, colour in signs:
        for i, j in np.argwhere(cells):
            axes.plot(j + 0.5, i + 0.5, sign, color=colour, markersize=4)
    return axes.pcolormesh(shown, cmap=COLOURS, norm=scale, edgecolors="white", linewidth=0.4)


STEP = {True: "dt / critical step", False: "dt [s]"}


def _label(axes: Any, panel: Panel, left: bool, lowest: bool, step: str) -> None:
    """Name the panel; write steps below the lowest row and stiffnesses beside the first column."""
    axes.set_title(panel.mark.label, fontsize=7, pad=2)
    steps, stiffnesses = np.arange(len(panel.dt)), np.arange(len(panel.kn))
    axes.set_xticks(steps + 0.5, [brief(dt) for dt in panel.dt] if lowest else [], rotation=45)
    axes.set_yticks(stiffnesses + 0.5, [brief(kn) for kn in panel.kn] if left else [])
    if lowest:
        axes.set_xlabel(step, fontsize=7, labelpad=1)
    if left:
        axes.set_ylabel("kn [N/m]", fontsize=7, labelpad=1)
