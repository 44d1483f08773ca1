"""What a benchmark is: a Case with its variants, quantities, tolerances and source."""

from __future__ import annotations

import enum
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

from vv.ask import Knobs, Method, Run
from vv.scene import Vector
from vv.study import Level, Study

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


class Norm(enum.Enum):
    """How a series is compared with its reference."""

    MAX = "max|e| / max|ref|"
    FINAL = "|e| / |ref| at the final time"
    POINTWISE = "max |e/ref| where |ref| >= 1 % of max|ref|"
    L2 = "||e||_2 / ||ref||_2"


LOOSEST = 0.1  # relative error that no tolerance exceeds, however coarse the step


@dataclass(frozen=True)
class Tolerance:
    """A bound on an error and why: value at the step dt [s], growing as dt**order above floor.

    With kn [N/m], it is the value at that stiffness of springs that stand in for rigid contact,
    and falls as kn**-softness. It grows to LOOSEST at most: an answer farther off than that is
    wrong at any step.

    slack: why the bound is more than a hundred times what codes reach, where it is.
    """

    value: float
    reason: str
    dt: float | None = None
    order: int = 0
    floor: float = 0.0
    slack: str = ""
    kn: float | None = None
    softness: float = 0.0

    def __post_init__(self) -> None:
        if not 0 < self.value <= LOOSEST:
            raise ValueError(
                f"Tolerance.value = {self.value!r}; it must be positive and {LOOSEST:g} at most"
            )
        for name, unit in (("dt", "s"), ("kn", "N/m")):
            at = getattr(self, name)
            if at is not None and not 0 < at < math.inf:
                raise ValueError(f"Tolerance.{name} = {at!r} {unit}; it must be positive")
        for power, knob in (("order", "dt"), ("softness", "kn")):
            exponent, given = getattr(self, power), getattr(self, knob) is not None
            if not (exponent == 0 or (exponent > 0 and given)):
                rule = f"it must not be negative, and needs the {knob} it grows from"
                raise ValueError(f"Tolerance.{power} = {exponent!r}; {rule}")
        if not 0 <= self.floor <= self.value:
            raise ValueError(
                f"Tolerance.floor = {self.floor!r}; it must lie in [0, {self.value!r}]"
            )

    def at(self, knobs: Knobs) -> float:
        """The bound for a run with these knobs."""
        bound = self.value
        if self.dt is not None and knobs.dt is not None:
            bound *= (knobs.dt / self.dt) ** self.order
        if self.kn is not None and knobs.kn is not None:
            bound *= (self.kn / knobs.kn) ** self.softness
        return min(LOOSEST, max(self.floor, bound))


@dataclass(frozen=True)
class Exact:
    """Judge: the error against a reference, in a norm, within the tolerance of the method.

    shown: why methods that promise no answer here are not judged; their result is shown.
    """

    tolerances: Mapping[Method, Tolerance]
    norm: Norm = Norm.MAX
    shown: Mapping[Method, str] = field(default_factory=dict)


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


def judge_of(judge: Judge, method: Method) -> Judge:
    """How a quantity with that judge is judged in a method."""
    if isinstance(judge, Exact) and method in judge.shown:
        return Shown(judge.shown[method])
    return judge


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
