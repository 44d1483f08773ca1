"""What the template sees: the page, its cases, their variants, the schemes in each."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from reports.costs import Costs, Profile
from reports.findings import Finding
from reports.gallery import Figure
from reports.marks import Mark
from reports.outcomes import ShownOutcome
from reports.tables import Absent, Cell, Group
from vv.ask import Ledger
from vv.insight.history import Point
from vv.records.accepted import BaselineSummary
from vv.records.case_facts import CaseFacts, QuantityFacts, VariantFacts
from vv.records.finding import Finding as Change
from vv.records.job_record import ModelSummary
from vv.records.provenance import Provenance


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
    model: ModelSummary | None
    orders: Sequence[Group]
    ledger: Ledger | None
    reason: str


@dataclass(frozen=True)
class Variant:
    """A variant: what was asked, and all that came of it. like: the variant whose figures fit.

    costs: None where nothing was timed.
    """

    name: str
    anchor: str
    facts: VariantFacts
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
    facts: CaseFacts
    quantities: Sequence[tuple[QuantityFacts, Sequence[str]]]
    variants: Sequence[Variant]
    beside: Mapping[str, Mapping[str, float | None]]
    beside_dt: float | None
    baseline: BaselineSummary | None
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
    provenance: Provenance
    marks: Mapping[str, Mark]
    versions: Mapping[str, str]
    counts: Sequence[tuple[ShownOutcome, int]]
    cases: Sequence[Case]
    since: Sequence[Change]
    trouble: Sequence[Finding]
    known: Sequence[Finding]
    idle: Sequence[Finding]
    legend: Sequence[ShownOutcome]
    norms: Mapping[str, str]
    profiles: Sequence[Profile]
    stability: Sequence[Stable]
    factors: Sequence[float]
