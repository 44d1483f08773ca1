"""What a benchmark is: a Case with its variants, quantities, tolerances and source."""

from __future__ import annotations

import enum
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

from vv.ask import Knobs, Method, Run
from vv.scene import Vector
from vv.study import Ladder

Parameters = Mapping[str, float]
NO_DEFAULTS: Parameters = MappingProxyType({})


@dataclass(frozen=True)
class Source:
    """Where a benchmark comes from; note: what the paper misprints or leaves out."""

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


class Norm(enum.Enum):
    """How a series is compared with its reference."""

    MAX = "max|e| / max|ref|"
    FINAL = "|e| / |ref| at the final time"
    POINTWISE = "max |e/ref| where |ref| >= 1 % of max|ref|"
    L2 = "||e||_2 / ||ref||_2"


@dataclass(frozen=True)
class Tolerance:
    """A bound on an error and why: value at the step dt [s], growing as dt**order above floor.

    slack: why the bound is more than a hundred times what codes reach, where it is.
    """

    value: float
    reason: str
    dt: float | None = None
    order: int = 0
    floor: float = 0.0
    slack: str = ""

    def at(self, knobs: Knobs) -> float:
        """The bound for a run with these knobs."""
        if self.dt is None or knobs.dt is None:
            return self.value
        return max(self.floor, self.value * (knobs.dt / self.dt) ** self.order)


@dataclass(frozen=True)
class Exact:
    """Judge: the error against a reference, in a norm, within the tolerance of the method."""

    tolerances: Mapping[Method, Tolerance]
    norm: Norm = Norm.MAX


@dataclass(frozen=True)
class Interval:
    """Judge: the value itself must lie within [low, high]."""

    low: float
    high: float
    reason: str


@dataclass(frozen=True)
class Invariant:
    """Judge: the value must be conserved: |value - reference| <= bound times the scale."""

    bound: float
    reason: str


@dataclass(frozen=True)
class Shown:
    """No judge: the value is shown, with the reason why it is not judged."""

    reason: str


Judge = Exact | Interval | Invariant | Shown


@dataclass(frozen=True)
class Series:
    """A quantity over time: observe(run) -> (k,) values at run.times; reference(t) -> (k,)."""

    name: str
    symbol: str
    unit: str
    meaning: str
    observe: Callable[[Run], Vector]
    reference: Callable[[Vector], Vector] | None
    judge: Judge


@dataclass(frozen=True)
class Scalar:
    """A number from a run; scale (never zero) turns its error into a relative one."""

    name: str
    symbol: str
    unit: str
    meaning: str
    observe: Callable[[Run], float]
    reference: float | None
    scale: float
    judge: Judge

    def __post_init__(self) -> None:
        if not (math.isfinite(self.scale) and self.scale > 0):
            raise ValueError(f"Scalar.scale = {self.scale!r} {self.unit}; it must be positive")


@dataclass(frozen=True)
class Count:
    """A whole number from a run, such as collisions; compared exactly."""

    name: str
    symbol: str
    meaning: str
    observe: Callable[[Run], int]
    reference: int | None
    judge: Judge


Quantity = Series | Scalar | Count


@dataclass(frozen=True)
class Variant:
    """A named change of a case's scene; the functions receive its name.

    defaults: parameters that differ from the case's. inert: parameters that, by the physics,
    do not enter the answer. At level quick only variants marked quick run.
    """

    name: str
    summary: str
    formula: str
    defaults: Parameters = field(default_factory=lambda: NO_DEFAULTS)
    inert: frozenset[str] = frozenset()
    quick: bool = True


@dataclass(frozen=True, eq=False)
class Trial:
    """A variant with its parameters put in: what to run and what to judge."""

    study: Ladder
    quantities: tuple[Quantity, ...]


@dataclass(frozen=True, eq=False)
class Case:
    """A benchmark, declared once. declare(variant name, parameters) -> Trial.

    published: what the source itself reports, as text, to stand beside our results.
    """

    name: str
    title: str
    source: Source
    parameters: tuple[Parameter, ...]
    variants: tuple[Variant, ...]
    declare: Callable[[str, Parameters], Trial]
    published: Mapping[str, str] = field(default_factory=dict)

    def variant(self, name: str) -> Variant:
        """The variant of that name; raises KeyError."""
        return next(v for v in self.variants if v.name == name)

    def defaults(self, variant: str) -> dict[str, float]:
        """The parameters of a variant when nothing is set."""
        own = self.variant(variant).defaults
        return {p.name: own.get(p.name, p.value) for p in self.parameters}
