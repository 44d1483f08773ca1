"""What a benchmark is: a Case with its variants, parameters, quantities and source."""

from __future__ import annotations

import enum
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

from vv.ask import Run
from vv.judges import LOOSEST, Exact, Interval, Invariant, Judge, Norm, Shown, Tolerance
from vv.scene import Vector
from vv.study import Level, Study

__all__ = [
    "LOOSEST",
    "Case",
    "Check",
    "Count",
    "Exact",
    "Interval",
    "Invariant",
    "Judge",
    "Norm",
    "Parameter",
    "Parameters",
    "Quantity",
    "Scalar",
    "Series",
    "Shown",
    "Source",
    "Tolerance",
    "Trial",
    "Variant",
]
Parameters = Mapping[str, float]
NO_DEFAULTS: Parameters = MappingProxyType({})


@dataclass(frozen=True)
class Source:
    """Where a benchmark comes from; note: what the paper misprints or leaves out.

    doi: without a prefix, empty if there is none.
    """

    citation: str
    doi: str
    note: str = ""


@dataclass(frozen=True)
class Parameter:
    """A physical parameter that `--set` may change: its default value in `unit`."""

    name: str
    value: float
    unit: str
    meaning: str


def _require_answer(name: str, reference: object, judge: Judge) -> None:
    """A quantity that is judged by its error must have something to be compared with."""
    if reference is None and isinstance(judge, Exact | Invariant):
        raise ValueError(f"quantity '{name}' is judged by its error and has no reference")


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


@dataclass(frozen=True)
class Variant:
    """A named change of a case's scene; the functions receive its name.

    defaults: parameters that differ from the case's. inert: parameters that, by the physics,
    do not enter the answer. level: the least at which it runs.
    """

    name: str
    summary: str
    formula: str
    defaults: Parameters = field(default_factory=lambda: NO_DEFAULTS)
    inert: frozenset[str] = frozenset()
    level: Level = Level.QUICK

    def runs_at(self, level: Level) -> bool:
        """Whether it is among the variants of a level."""
        return self.level.rank <= level.rank


@dataclass(frozen=True, eq=False)
class Trial:
    """A variant with its parameters put in: what to run and what to judge."""

    study: Study
    quantities: tuple[Quantity, ...]


class Check(enum.Enum):
    """What the gate judges a case by; the value is the word shown to people."""

    ACCURACY = "accuracy"
    REGRESSION = "regression"
    SPEED = "speed"
    CONSERVATION = "conservation"


@dataclass(frozen=True, eq=False)
class Case:
    """A benchmark, declared once. declare(variant name, parameters) -> Trial.

    published: what the source itself reports, as text, to stand beside our results. enforced:
    the checks that turn the gate red; what the others find is reported only.
    """

    name: str
    title: str
    source: Source
    parameters: tuple[Parameter, ...]
    variants: tuple[Variant, ...]
    declare: Callable[[str, Parameters], Trial]
    published: Mapping[str, str] = field(default_factory=dict)
    enforced: frozenset[Check] = frozenset(Check)

    def variant(self, name: str) -> Variant:
        """The variant of that name; raises KeyError."""
        return next(v for v in self.variants if v.name == name)

    def defaults(self, variant: str) -> dict[str, float]:
        """The parameters of a variant when nothing is set."""
        own = self.variant(variant).defaults
        return {p.name: own.get(p.name, p.value) for p in self.parameters}
