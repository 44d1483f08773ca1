"""Recorded results of external codes, which are shown where the codes are not installed."""

from __future__ import annotations

import datetime
from collections.abc import Mapping
from dataclasses import dataclass, field

from vv.ask import Knobs
from vv.records.accepted import Place
from vv.records.fields import optional, spread


@dataclass(frozen=True, slots=True)
class RecordedQuantity:
    """Figures and errors of a quantity, and of the finest rung some points (t [s], y)."""

    figures: Mapping[str, float | None] = spread()
    t: tuple[float | None, ...] | None = optional(None)
    y: tuple[float | None, ...] | None = optional(None)


@dataclass(frozen=True, slots=True)
class RecordedRun:
    """One recorded result. cpu: seconds of the stepping loop."""

    cpu: float | None
    quantities: Mapping[str, RecordedQuantity] = spread()


@dataclass(frozen=True, slots=True)
class RecordedFile:
    """The results of a code on a case, by name, and their origin.

    utc: the time in ISO form; raises ValueError for any other.
    """

    code: str
    case: str
    version: str
    utc: str
    commit: str
    dirty: bool
    machine: Place
    executables: Mapping[str, str] = field(default_factory=dict)
    parameters: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    results: Mapping[str, RecordedRun] = field(default_factory=dict)

    def __post_init__(self) -> None:
        datetime.datetime.fromisoformat(self.utc)


@dataclass(frozen=True, slots=True)
class RecordedResult:
    """A recorded result shown with a record. days: its age; knobs: its rung in words."""

    case: str
    variant: str
    code: str
    scheme: str
    rung: Knobs
    knobs: str
    version: str
    utc: str
    days: int
    cpu: float | None
    quantities: Mapping[str, RecordedQuantity]

    @property
    def label(self) -> str:
        """The code and scheme as CODE/SCHEME."""
        return f"{self.code}/{self.scheme}"
