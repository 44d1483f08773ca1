"""The benchmark: a Case with its source, parameters and variants."""

from __future__ import annotations

import enum
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

from vv.ask import Knobs, Method
from vv.case.judges import Tolerance
from vv.case.parameter import Parameter
from vv.case.quantity import Quantity
from vv.case.region_map import RegionMap
from vv.case.study import Level, Study

Parameters = Mapping[str, float]
NO_DEFAULTS: Parameters = MappingProxyType({})


@dataclass(frozen=True)
class Source:
    """The publication that a benchmark comes from.

    doi: without a prefix, empty if there is none. note: misprints, omissions and our choices.
    """

    citation: str
    doi: str
    note: str = ""


@dataclass(frozen=True)
class Variant:
    """A named version of a case; `Case.declare` receives its name.

    formula: the equations of the exact answer, as text. defaults: parameters whose default differs
    from that of the case. inert: parameters that do not affect the exact answer. level: the lowest
    level at which the variant runs. unseen: parameters that are not inert, but for which no
    quantity detects a change of 1 % in a code, each with the reason.
    """

    name: str
    summary: str
    formula: str
    defaults: Parameters = field(default_factory=lambda: NO_DEFAULTS)
    inert: frozenset[str] = frozenset()
    level: Level = Level.QUICK
    unseen: Mapping[str, str] = field(default_factory=dict)

    def runs_at(self, level: Level) -> bool:
        """Whether the variant runs at a level."""
        return self.level.rank <= level.rank


@dataclass(frozen=True)
class EnergyAllowance:
    """The energy that a code may leave unexplained, or gain from terms that should dissipate it.

    It replaces the bound that a scheme declares, usually rounding, where it is larger and the class
    of method has a tolerance here. The tolerances are relative to `scale` [J]. Raises ValueError
    unless the scale is positive.
    """

    scale: float
    tolerances: Mapping[Method, Tolerance]

    def __post_init__(self) -> None:
        if not 0 < self.scale < math.inf:
            raise ValueError(f"EnergyAllowance.scale = {self.scale!r} J; it must be positive")

    def at(self, method: Method, knobs: Knobs) -> float:
        """The energy [J] that a class of method is allowed at a setting; 0 without a tolerance."""
        tolerance = self.tolerances.get(method)
        return self.scale * tolerance.at(knobs) if tolerance else 0.0


@dataclass(frozen=True, eq=False)
class Trial:
    """A variant with values for all parameters: the study to run and the quantities to judge.

    regions: the map, for the report, in which some of the quantities are points. phase: names of
    two quantities over time; the report plots the second over the first.
    """

    study: Study
    quantities: tuple[Quantity, ...]
    unexplained: EnergyAllowance | None = None
    regions: RegionMap | None = None
    phase: tuple[str, str] | None = None


class Check(enum.Enum):
    """A kind of check of the gate; the value is the word shown to people."""

    ACCURACY = "accuracy"
    REGRESSION = "regression"
    SPEED = "speed"
    CONSERVATION = "conservation"


@dataclass(frozen=True, eq=False)
class Case:
    """A benchmark. declare(variant name, parameters) returns its Trial.

    published: name -> text, the results that the source reports, shown beside ours. enforced: the
    checks that can turn the gate red; findings of the others are only reported.
    """

    name: str
    title: str
    source: Source
    parameters: tuple[Parameter, ...]
    variants: tuple[Variant, ...]
    declare: Callable[[str, Parameters], Trial]
    published: Mapping[str, str] = field(default_factory=dict)
    enforced: frozenset[Check] = frozenset(Check)

    def __post_init__(self) -> None:
        for variant in self.variants:
            for one in self.parameters:
                one.checked(variant.defaults.get(one.name, one.value))

    def variant(self, name: str) -> Variant:
        """The variant of that name; raises KeyError."""
        for variant in self.variants:
            if variant.name == name:
                return variant
        raise KeyError(f"{self.name} has no variant '{name}'")

    def defaults(self, variant: str) -> dict[str, float]:
        """Name -> default value of all parameters of a variant."""
        own = self.variant(variant).defaults
        return {p.name: own.get(p.name, p.value) for p in self.parameters}
