"""What a benchmark is: a Case with its variants, parameters, quantities and source."""

from __future__ import annotations

import enum
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

from vv.case.quantity import Quantity
from vv.case.study import Level, Study

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
