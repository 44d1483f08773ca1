"""What the template sees: the page, its cases, their variants, the schemes in each."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from reports.costs import Costs, Profile
from reports.findings import Finding
from reports.gallery import Figure
from reports.marks import Mark
from reports.outcomes import Outcome
from reports.tables import Absent, Cell, Group
from vv.insight.history import Point
from vv.records.finding import Finding as Change


@dataclass(frozen=True)
class Recorded:
    """A recorded result of a code that is not installed: never a live one. days: its age."""

    version: str
    date: str
    days: int
    error: float | None


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
    """A variant: what was asked, and all that came of it. like: the variant whose figures fit.

    costs: None where nothing was timed.
    """

    name: str
    anchor: str
    facts: Mapping[str, Any]
    settings: Mapping[str, float]
    modified: bool
    cells: Mapping[str, Cell]
    recorded: Mapping[str, Recorded]
    schemes: Sequence[Scheme]
    groups: Sequence[Group]
    absent: Sequence[Absent]
    figures: Sequence[Figure]
    like: str
    has_series: bool
    costs: Costs | None


@dataclass(frozen=True)
class Case:
    """A case: its prose and its variants.

    beside: our errors at the step of the tolerances. baseline: what was accepted, why and where;
    None if nothing was. past: the case over commits, oldest first.
    """

    name: str
    anchor: str
    facts: Mapping[str, Any]
    quantities: Sequence[tuple[Mapping[str, Any], Sequence[str]]]
    variants: Sequence[Variant]
    beside: Mapping[str, Mapping[str, float | None]]
    beside_dt: float | None
    baseline: Mapping[str, Any] | None
    past: Sequence[Point]


@dataclass(frozen=True)
class Stable:
    """One kind of finding on stability, and its lines: schemes that say the same share one."""

    title: str
    caption: str
    lines: Sequence[tuple[str, str, Sequence[tuple[Sequence[Mark], str]]]]


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
    since: Sequence[Change]
    trouble: Sequence[Finding]
    known: Sequence[Finding]
    idle: Sequence[Finding]
    legend: Sequence[Outcome]
    norms: Mapping[str, str]
    profiles: Sequence[Profile]
    stability: Sequence[Stable]
    factors: Sequence[float]
