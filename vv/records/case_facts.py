"""The description of a case that is stored with its results, for reports of past runs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from vv.case import Check, Parameter, RegionMap, Source
from vv.records.fields import optional
from vv.records.outcomes import JudgeKind
from vv.scene.picture.moved import Moved
from vv.scene.picture.sketch import Sketch


@dataclass(frozen=True, slots=True)
class ToleranceFacts:
    """A tolerance at the time of the judgement, with the fields of `vv.case.Tolerance`."""

    value: float
    reason: str
    dt: float | None = None
    order: int = 0
    floor: float = 0.0
    slack: str = ""
    kn: float | None = None
    softness: float = 0.0
    late: float = optional(0.0)


@dataclass(frozen=True, slots=True)
class QuantityFacts:
    """A quantity, with the way in which it is judged.

    If it is judged by its error: norm, tolerances by class of method, and the reasons for methods
    that are only shown. Otherwise: reason.
    """

    name: str
    symbol: str
    unit: str
    meaning: str
    judge: JudgeKind
    norm: str | None = optional(None)
    tolerances: Mapping[str, ToleranceFacts] | None = optional(None)
    shown: Mapping[str, str] | None = optional(None)
    reason: str | None = optional(None)


@dataclass(frozen=True, slots=True)
class VariantFacts:
    """A variant: its physics in words, its terms, and its quantities.

    critical: (kn [N/m] or None, step [s]), the critical steps in whose multiples the steps of a map
    are given. sketch: of the scene, None in old manifests; moved: quantity -> the motion of a body
    in the sketch. regions: the map in which some quantities are points. phase: two quantities, of
    which the second is drawn over the first.
    """

    summary: str
    formula: str
    inert: tuple[str, ...]
    terms: tuple[str, ...]
    unknowns: int
    quantities: tuple[QuantityFacts, ...]
    critical: tuple[tuple[float | None, float], ...] = optional(())
    sketch: Sketch | None = optional(None)  # noqa: RUF009  # None is frozen
    moved: Mapping[str, Moved] | None = optional(None)
    regions: RegionMap | None = optional(None)  # noqa: RUF009
    phase: tuple[str, str] | None = optional(None)


@dataclass(frozen=True, slots=True)
class CaseFacts:
    """A case: title, source, published results, enforced checks, parameters and variants."""

    title: str
    source: Source
    published: Mapping[str, str]
    enforced: tuple[Check, ...]
    parameters: tuple[Parameter, ...]
    variants: Mapping[str, VariantFacts]
