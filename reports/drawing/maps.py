"""The map of an error over step and stiffness: a panel for each code, as data."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from reports.drawing.collect import Ladder
from reports.marks import Mark
from vv.base.metrics import Vector
from vv.insight.stability_summary import WRONG

LEAST = 3  # the fewest stiffnesses and steps of a map
Mask = npt.NDArray[np.bool_]
Critical = Mapping[float | None, float]
NO_CRITICAL: Critical = {}


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
        """A mask (m, n) of points that diverged or have an error of 100 % or more."""
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
    """A step, or its rounded ratio to the critical step."""
    return dt if critical is None else float(f"{dt / critical:.6g}")
