"""Accepted results of a case: what was accepted, when, where and why."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field

from vv.records.fields import optional, spread

NUMBER = re.compile(r"[0-9]{1,9}")
NAME = re.compile(r"\S+ \S+/\S+( \S+)?")  # of a result: variant, code/scheme, setting


@dataclass(frozen=True, slots=True)
class Place:
    """The processor and the system that results were made on."""

    processor: str
    system: str


@dataclass(frozen=True, slots=True)
class Acceptance:
    """An acceptance of results, with the reason why they are right."""

    commit: str
    dirty: bool
    machine: Place
    reason: str
    utc: str
    versions: Mapping[str, str]


@dataclass(frozen=True, slots=True)
class AcceptedQuantity:
    """The accepted data of a quantity: its error, its scale, and a few figures of its value.

    rounding: by how much a figure over the scale, or the error, moved at most when the last digits
    of the scene were changed; None if that is too little to matter.
    """

    error: float | None
    scale: float | None
    figures: Mapping[str, float | None] = spread()
    rounding: float | None = optional(None)


@dataclass(frozen=True, slots=True)
class AcceptedResult:
    """The accepted data of a record.

    by: the number of its acceptance. cost: in calibration kernels, the smallest and the largest of
    the rounds.
    """

    by: str
    cost: tuple[float, float] | None = optional(None)
    quantities: Mapping[str, AcceptedQuantity] = spread()


@dataclass(frozen=True, slots=True)
class Baseline:
    """The accepted results of a case, by name; parameters: variant -> the parameters of its runs.

    Raises ValueError for an acceptance without a number, and for a result whose name lacks its
    variant or scheme, or that belongs to none of the acceptances.
    """

    case: str
    acceptances: Mapping[str, Acceptance] = field(default_factory=dict)
    parameters: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    results: Mapping[str, AcceptedResult] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for number in self.acceptances:
            if not NUMBER.fullmatch(number):
                raise ValueError(f"acceptances.{number!r}: an acceptance must have a number")
        for name, result in self.results.items():
            if not NAME.fullmatch(name):
                raise ValueError(f"results.{name!r}: expected VARIANT CODE/SCHEME SETTING")
            if result.by not in self.acceptances:
                raise ValueError(f"results.{name}.by = {result.by!r}; there is no such acceptance")


@dataclass(frozen=True, slots=True)
class AcceptanceSummary:
    """An acceptance, and the number of results in a baseline that belong to it."""

    commit: str
    dirty: bool
    machine: Place
    reason: str
    utc: str
    versions: Mapping[str, str]
    results: int


@dataclass(frozen=True, slots=True)
class BaselineSummary:
    """The origin of a baseline: the number of its results, and its acceptances, newest last."""

    results: int
    acceptances: tuple[AcceptanceSummary, ...]
