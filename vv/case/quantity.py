"""What is judged of a run: a series over time, a number, or a count."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from vv.ask import Run
from vv.case.judges import Exact, Interval, Invariant, Judge
from vv.scene import Vector

Number = float | Callable[[], float]  # a function is called where a run is measured, not before


def number(value: Number) -> float:
    """A number that may take its time to be found."""
    return value() if callable(value) else value


def size_of(name: str, scale: Number) -> float:
    """What errors of a quantity are relative to; raises ValueError if it is not positive."""
    size = number(scale)
    if not (math.isfinite(size) and size > 0):
        raise ValueError(f"quantity '{name}' has scale = {size!r}; it must be positive")
    return size


@dataclass(frozen=True)
class Series:
    """A quantity over time: observe(run) -> (k,) values at run.times; reference(t) -> (k,).

    scale: what errors are relative to where the reference itself may be zero throughout.
    """

    name: str
    symbol: str
    unit: str
    meaning: str
    observe: Callable[[Run], Vector]
    reference: Callable[[Vector], Vector] | None
    judge: Judge
    scale: Number | None = None

    def __post_init__(self) -> None:
        _require_answer(self.name, self.reference, self.judge)
        if isinstance(self.judge, Interval):
            raise ValueError(f"quantity '{self.name}': a series has no single value to bound")
        if self.scale is not None and not callable(self.scale):
            size_of(self.name, self.scale)


@dataclass(frozen=True)
class Scalar:
    """A number from a run; scale (never zero) turns its error into a relative one.

    told(run): whether a code tells what it is taken from, such as a ledger; where it does not, the
    quantity is not judged.
    """

    name: str
    symbol: str
    unit: str
    meaning: str
    observe: Callable[[Run], float]
    reference: Number | None
    scale: Number
    judge: Judge
    told: Callable[[Run], bool] = lambda run: True

    def __post_init__(self) -> None:
        _require_answer(self.name, self.reference, self.judge)
        if not callable(self.scale):
            size_of(self.name, self.scale)


@dataclass(frozen=True)
class Count:
    """A whole number from a run, such as collisions; compared exactly."""

    name: str
    symbol: str
    meaning: str
    observe: Callable[[Run], int]
    reference: int | Callable[[], int] | None
    judge: Judge

    def __post_init__(self) -> None:
        _require_answer(self.name, self.reference, self.judge)


Quantity = Series | Scalar | Count


def _require_answer(name: str, reference: object, judge: Judge) -> None:
    """A quantity that is judged by its error must have something to be compared with."""
    if reference is None and isinstance(judge, Exact | Invariant):
        raise ValueError(f"quantity '{name}' is judged by its error and has no reference")
