"""The record of a job: what was asked of which code, the result, and its cost."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Mapping
from dataclasses import dataclass

from vv.ask import Knobs, Ledger, Method, Status
from vv.records.fields import optional
from vv.records.outcomes import CostKind, StudyKind
from vv.records.quantity import MeasuredQuantity

WORD = re.compile("[A-Za-z0-9-]*")


@dataclass(frozen=True, slots=True)
class JobCost:
    """The seconds spent on a job, with the fields of `vv.ask.Cost`, and how they were measured.

    relative: solve_cpu in calibration kernels, the smallest and the largest of the rounds; session:
    the timing session; only costs of one session may be compared.
    """

    startup: float
    setup: float
    solve_cpu: float
    solve_wall: float
    output: float
    repeats: int
    spread: float
    whole: bool = optional(False)
    relative: tuple[float, float] | None = optional(None)
    session: str = optional("")
    kind: CostKind = CostKind.INDICATIVE

    @property
    def timed(self) -> bool:
        """Whether the cost was measured alone on one core."""
        return self.kind is CostKind.TIMED

    @property
    def elapsed(self) -> float:
        """The wall seconds from the start of the program to the last output."""
        return self.startup + self.setup + self.solve_wall + self.output


@dataclass(frozen=True, slots=True)
class ModelSummary:
    """The model that a code built of a scene: unknowns, names of terms, and a description."""

    unknowns: int
    terms: tuple[str, ...]
    note: str


@dataclass(frozen=True, slots=True)
class RunSummary:
    """The summary of a run in a record: status and reason, cost, model, energy [J], quantities.

    largest_step: the largest step [s] of a search below all unstable ones; None of other studies.
    """

    status: Status
    reason: str
    cost: JobCost
    steps: int
    model: ModelSummary | None
    ledger: Ledger | None
    quantities: tuple[MeasuredQuantity, ...]
    largest_step: float | None = optional(None)


@dataclass(frozen=True, slots=True)
class Record:
    """A job and its result. modified: parameters were changed; key: of its series in the store.

    Raises ValueError for a key that could name a file elsewhere. largest_step: see RunSummary.
    known_breaches: the laws that its ledger breaks, but is known to break. changed: the names of
    the changed parameters; empty in older records, of which only `modified` tells.
    """

    case: str
    variant: str
    study: StudyKind
    parameters: Mapping[str, float]
    modified: bool
    code: str
    scheme: str
    code_version: str
    method: Method
    rung: Knobs
    key: str
    status: Status
    reason: str
    cost: JobCost
    steps: int
    model: ModelSummary | None
    ledger: Ledger | None
    quantities: tuple[MeasuredQuantity, ...]
    largest_step: float | None = optional(None)
    known_breaches: tuple[str, ...] = optional(())
    changed: tuple[str, ...] = optional(())

    def __post_init__(self) -> None:
        if not WORD.fullmatch(self.key):
            raise ValueError(f"Record.key = {self.key!r}; it must consist of letters, digits and -")

    @property
    def label(self) -> str:
        """The code and scheme as CODE/SCHEME."""
        return f"{self.code}/{self.scheme}"

    def quantity(self, name: str) -> MeasuredQuantity | None:
        """The quantity of that name; None if the record has none."""
        return next((one for one in self.quantities if one.name == name), None)


SUMMARY = tuple(field.name for field in dataclasses.fields(RunSummary))


def summary_of(record: Record) -> RunSummary:
    """The summary of the run of a record."""
    return RunSummary(*(getattr(record, name) for name in SUMMARY))
