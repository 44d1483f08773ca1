"""Quantities that several cases measure: a motion in several directions, a largest step."""

from __future__ import annotations

import functools
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from vv.ask import Bracket, Observable, Run
from vv.case.judges import Judge
from vv.case.quantity import Scalar, Series
from vv.scene import Vector


@dataclass(frozen=True, eq=False)
class Motion:
    """An observable [unit] along axes (d, 3), and its exact path: times (k,) [s] -> (k, d).

    times: of the outputs, which the whole path is measured at.
    """

    observable: Observable
    axes: Vector
    path: Callable[[Vector], Vector]
    times: Vector
    unit: str

    @functools.cached_property
    def size(self) -> float:
        """What every error is relative to: a part that hardly moves has no scale of its own."""
        return float(np.linalg.norm(self.path(self.times), axis=1).max())

    def part(self, i: int, name: str, meaning: str, judge: Judge) -> Series:
        """The motion along the i-th axis."""
        return Series(
            name=name,
            symbol=name,
            unit=self.unit,
            meaning=meaning,
            observe=lambda run: np.asarray(run.values[self.observable] @ self.axes[i]),
            reference=lambda t: self.path(t)[:, i],
            judge=judge,
            scale=lambda: self.size,
        )

    def distance(self, judge: Judge) -> Scalar:
        """How far the whole is off, at most over time: max|e| of vectors."""
        return Scalar(
            name="distance",
            symbol="max|e|",
            unit=self.unit,
            meaning="largest distance from the exact path",
            observe=self._farthest,
            reference=0.0,
            scale=lambda: self.size,
            judge=judge,
        )

    def _farthest(self, run: Run) -> float:
        gap = run.values[self.observable] @ self.axes.T - self.path(run.times)
        return float(np.linalg.norm(gap, axis=1).max())


def largest_step(name: str, theory: float, what: str, bracket: Bracket, judge: Judge) -> Scalar:
    """The largest step of a search that was stable, as all below it were, over `theory` [s]."""
    return Scalar(
        name=name,
        symbol=f"dt_max/({what})",
        unit="",
        meaning=f"largest stable step over {what}",
        observe=lambda run: last_stable(run, bracket) / theory,
        reference=1.0,
        scale=1.0,
        judge=judge,
    )


def last_stable(run: Run, bracket: Bracket) -> float:
    """The last step [s] before the least that was not stable; 0 if that was the first."""
    return bracket.limits(run.tried)[0]
