"""Quantities that several cases share: motion along several axes, largest stable step."""

from __future__ import annotations

import functools
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from vv.ask import Bracket, Observable, Run
from vv.case.judges import Judge
from vv.case.motion_readers import ComponentAlong
from vv.case.quantity import Scalar, Series, at_rest
from vv.case.remembered import remembered
from vv.scene import Vector


@dataclass(frozen=True, eq=False)
class Motion:
    """An observable [unit] along axes (d, 3), and its exact history: path(t (k,) [s]) -> (k, d).

    times: (k,) [s] at which the largest norm of the exact history is searched. still [unit]: the
    scale of errors if there is no motion at the chosen parameters; see `Series`.
    """

    observable: Observable
    axes: Vector
    path: Callable[[Vector], Vector]
    times: Vector
    unit: str
    still: float | None = None

    @functools.cached_property
    def exact(self) -> Callable[[Vector], Vector]:
        """The exact history, which all components ask for."""
        return remembered(self.path)

    @functools.cached_property
    def size(self) -> float:
        """The scale of all errors: the largest norm of the exact vector over time."""
        largest = float(np.linalg.norm(self.exact(self.times), axis=1).max())
        return self.still if self.still is not None and at_rest(largest, self.still) else largest

    def component(self, i: int, name: str, meaning: str, judge: Judge) -> Series:
        """The history along the i-th axis as a quantity."""
        return Series(
            name=name,
            symbol=name,
            unit=self.unit,
            meaning=meaning,
            observe=ComponentAlong(self.observable, self.axes[i]),
            reference=lambda t: self.exact(t)[:, i],
            judge=judge,
            scale=lambda: self.size,
            still=self.still,
        )

    def distance(self, judge: Judge) -> Scalar:
        """The largest norm of the error vector over time as a quantity."""
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
        gap = run.values[self.observable] @ self.axes.T - self.exact(run.times)
        return float(np.linalg.norm(gap, axis=1).max())


def largest_step(name: str, theory: float, what: str, bracket: Bracket, judge: Judge) -> Scalar:
    """The largest stable step of a search, below all unstable ones, over `theory` [s].

    what: the name of `theory`, such as `2/w`.
    """
    return Scalar(
        name=name,
        symbol=f"dt_max/({what})",
        unit="",
        meaning=f"largest stable step over {what}",
        observe=lambda run: last_stable_step(run, bracket) / theory,
        reference=1.0,
        scale=1.0,
        judge=judge,
    )


def last_stable_step(run: Run, bracket: Bracket) -> float:
    """The largest step [s] below all unstable ones; 0 if the first was unstable."""
    return bracket.stability_limits(run.tried)[0]
