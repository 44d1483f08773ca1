"""Quantities that are computed from a run and judged: Series over time, Scalar, Count."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from vv.ask import Run
from vv.case.code_to_code import CodeToCode
from vv.case.judges import Exact, Interval, Invariant, Judge
from vv.case.measured import Measured
from vv.scene import Vector

Number = float | Callable[[], float]  # a function is called only when a run is measured


def evaluated(value: Number) -> float:
    """The value of a number that may be given as a function, because it is costly to compute."""
    return value() if callable(value) else value


def error_scale(name: str, scale: Number) -> float:
    """The scale that errors of a quantity are relative to; raises ValueError unless positive."""
    size = evaluated(scale)
    if not (math.isfinite(size) and size > 0):
        raise ValueError(f"quantity '{name}' has scale = {size!r}; it must be positive")
    return size


REST = 1e-12  # fraction of `still`: a reference that is smaller throughout is rest with rounding


def at_rest(largest: float, still: float | None) -> bool:
    """Whether a reference of this largest size is zero except for rounding; still: see `Series`."""
    return largest == 0 or (still is not None and largest <= REST * still)


@dataclass(frozen=True)
class Series:
    """A quantity over time: observe(run) -> (k,) at run.times; reference(t (k,) [s]) -> (k,).

    scale: what errors are relative to, in place of max|reference|. still: the scale of errors if
    the reference is zero throughout, or no larger than the rounding of `still`, as it can be at
    some parameters.
    """

    name: str
    symbol: str
    unit: str
    meaning: str
    observe: Callable[[Run], Vector]
    reference: Callable[[Vector], Vector] | None
    judge: Judge
    scale: Number | None = None
    still: float | None = None

    def __post_init__(self) -> None:
        _require_answer(self.name, self.reference, self.judge)
        if self.still is not None:
            error_scale(self.name, self.still)
        if isinstance(self.judge, Interval | Measured | CodeToCode):
            raise ValueError(f"quantity '{self.name}': a series cannot be judged by an interval")
        if self.scale is not None and not callable(self.scale):
            error_scale(self.name, self.scale)


@dataclass(frozen=True)
class Scalar:
    """A number computed from a run; its error is relative to `scale`, which is positive.

    is_reported(run): whether the code reported what the number is computed from, such as a ledger;
    if not, the quantity is not judged.
    """

    name: str
    symbol: str
    unit: str
    meaning: str
    observe: Callable[[Run], float]
    reference: Number | None
    scale: Number
    judge: Judge
    is_reported: Callable[[Run], bool] = lambda run: True

    def __post_init__(self) -> None:
        _require_answer(self.name, self.reference, self.judge)
        if not callable(self.scale):
            error_scale(self.name, self.scale)


@dataclass(frozen=True)
class Count:
    """A whole number from a run, such as a number of collisions; compared exactly."""

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
    """Raise ValueError for a quantity that is judged by its error but has no reference."""
    if reference is None and isinstance(judge, Exact | Invariant):
        raise ValueError(f"quantity '{name}' is judged by its error and has no reference")
    if reference is not None and isinstance(judge, Measured):
        raise ValueError(f"quantity '{name}' has an exact reference beside its measurement")
    if reference is not None and isinstance(judge, CodeToCode):
        raise ValueError(f"quantity '{name}' has an exact reference beside another code's answer")
