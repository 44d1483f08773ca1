"""What the template sees: the page, its cases, their variants, the schemes in each."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from reports.findings import Finding
from reports.gallery import Figure
from reports.marks import Mark
from reports.outcomes import Outcome
from reports.tables import Absent, Cell, Group


@dataclass(frozen=True)
class Scheme:
    """A line on one code/scheme in one variant: what it built and what came of it."""

    mark: Mark
    cell: Cell
    version: str
    method: str
    model: Mapping[str, Any] | None
    orders: Sequence[Group]
    ledger: Mapping[str, Any] | None
    reason: str


@dataclass(frozen=True)
class Variant:
    """A variant: what was asked, and all that came of it. like: the variant whose figures fit."""

    name: str
    anchor: str
    facts: Mapping[str, Any]
    settings: Mapping[str, float]
    modified: bool
    cells: Mapping[str, Cell]
    schemes: Sequence[Scheme]
    groups: Sequence[Group]
    absent: Sequence[Absent]
    figures: Sequence[Figure]
    like: str
    has_series: bool


@dataclass(frozen=True)
class Case:
    """A case: its prose and its variants. beside: our errors at the step of the tolerances."""

    name: str
    anchor: str
    facts: Mapping[str, Any]
    quantities: Sequence[tuple[Mapping[str, Any], Sequence[str]]]
    variants: Sequence[Variant]
    beside: Mapping[str, Mapping[str, float | None]]
    beside_dt: float | None


@dataclass(frozen=True)
class Page:
    """The whole report."""

    digest: str
    name: str
    provenance: Mapping[str, Any]
    marks: Mapping[str, Mark]
    versions: Mapping[str, str]
    counts: Sequence[tuple[Outcome, int]]
    cases: Sequence[Case]
    trouble: Sequence[Finding]
    known: Sequence[Finding]
    idle: Sequence[Finding]
    legend: Sequence[Outcome]
    norms: Mapping[str, str]
