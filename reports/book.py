"""The data from which all pages of a report are made, each part computed once."""

from __future__ import annotations

import functools
import itertools
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from reports.beside import NOTHING, Beside
from reports.marks import Mark, marks
from reports.outcomes import ShownOutcome, shown_outcome
from reports.text import slug
from vv.base.metrics import Vector
from vv.gate.judgement import judgement
from vv.insight.against_measurements import Agreement, agreements
from vv.insight.diagnosis import Diagnosis, diagnoses
from vv.insight.effort import Effort, every_effort
from vv.insight.history import Point
from vv.insight.stability_summary import StabilityStatement, stability
from vv.records.finding import Finding
from vv.records.job_record import Record
from vv.records.manifest import Manifest
from vv.records.reading import by_fineness, rung, tried

Arrays = Callable[[str], Mapping[str, Vector]]
Place = tuple[str, str]  # case and variant


@dataclass(frozen=True, eq=False)
class Book:
    """A manifest, its series and its past. whole: whether all pages are parts of one file."""

    manifest: Manifest
    arrays: Arrays
    past: Mapping[str, Sequence[Point]]
    whole: bool = False
    beside: Beside = NOTHING

    @functools.cached_property
    def marks(self) -> dict[str, Mark]:
        """The marks of all schemes in the manifest."""
        return marks(record.label for record in self.manifest.records)

    @functools.cached_property
    def places(self) -> list[Place]:
        """Every variant, in the order of the cases."""
        return [(c, v) for c, facts in self.manifest.cases.items() for v in facts.variants]

    @functools.cached_property
    def records(self) -> dict[Place, dict[str, list[Record]]]:
        """(case, variant) -> label -> its records, coarsest first; labels sorted."""
        found: dict[Place, dict[str, list[Record]]] = {place: {} for place in self.places}
        ordered = sorted(self.manifest.records, key=by_fineness)
        for record in sorted(ordered, key=lambda r: r.label):
            piles = found.setdefault((record.case, record.variant), {})
            piles.setdefault(record.label, []).append(record)
        return found

    @functools.cached_property
    def of_case(self) -> dict[str, list[Record]]:
        """Case -> its records, in the order of the manifest."""
        found: dict[str, list[Record]] = {case: [] for case in self.manifest.cases}
        for record in self.manifest.records:
            found.setdefault(record.case, []).append(record)
        return found

    @functools.cached_property
    def ran(self) -> dict[Place, dict[str, list[Record]]]:
        """As `records`, but only jobs that a code attempted."""
        return {
            place: {
                label: taken
                for label, pile in piles.items()
                if (taken := list(filter(tried, pile)))
            }
            for place, piles in self.records.items()
        }

    @functools.cached_property
    def by_setting(self) -> dict[tuple[str, str, str, str], Record]:
        """(case, variant, scheme, setting) -> the record, for jobs that a code attempted."""
        piles = (pile for own in self.ran.values() for pile in own.values())
        return {(r.case, r.variant, r.label, rung(r)): r for pile in piles for r in pile}

    @functools.cached_property
    def shown(self) -> list[tuple[Record, ShownOutcome]]:
        """Every record with its outcome."""
        return [(record, shown_outcome(record)) for record in self.manifest.records]

    @functools.cached_property
    def findings(self) -> list[Finding]:
        """The findings of the gate."""
        return judgement(self.manifest)

    @functools.cached_property
    def red(self) -> list[Finding]:
        """The findings that turn the gate red."""
        return [finding for finding in self.findings if finding.red]

    @functools.cached_property
    def stability(self) -> list[StabilityStatement]:
        """The statements of the records on largest steps, drift and counts."""
        return stability(self.manifest)

    @functools.cached_property
    def patterns(self) -> list[Diagnosis]:
        """The patterns of failures, including known ones, of each scheme in a case."""
        return diagnoses(self.manifest)

    def quiet(self, case: str = "", variant: str = "", label: str = "") -> bool:
        """Whether no finding on a case, variant or scheme is red; '' means all.

        label: a scheme, or `CODE/` for all of a code.
        """
        return (case, variant, label) not in self._loud

    @functools.cached_property
    def _loud(self) -> set[tuple[str, str, str]]:
        """The places with red findings, each also with '' for all."""
        names = (
            (("", f.case), ("", f.variant), ("", f.label, f"{f.label.partition('/')[0]}/"))
            for f in self.red
        )
        return {place for choices in names for place in itertools.product(*choices)}

    @functools.cached_property
    def efforts(self) -> dict[Place, list[Effort]]:
        """(case, variant) -> errors and costs of each scheme."""
        found: dict[Place, list[Effort]] = {}
        for effort in every_effort(self.manifest):
            found.setdefault((effort.case, effort.variant), []).append(effort)
        return found

    def page_of(self, case: str) -> str:
        """The file of a case's page."""
        return f"case-{slug(case)}.html"

    @functools.cached_property
    def has_measurements(self) -> bool:
        """Whether a quantity was compared with a measurement."""
        return any(one.measurement for r in self.manifest.records for one in r.quantities)

    @functools.cached_property
    def agreements(self) -> dict[Place, list[Agreement]]:
        """(case, variant) -> each scheme compared with the measurements."""
        found: dict[Place, list[Agreement]] = {}
        for one in agreements(self.manifest):
            found.setdefault((one.case, one.variant), []).append(one)
        return found

    def page_of_code(self, code: str) -> str:
        """The file of a code's page."""
        return f"code-{slug(code)}.html"

    def to(self, page: str, anchor: str = "") -> str:
        """A link to a place on a page."""
        if self.whole:
            return f"#{anchor or page.removesuffix('.html')}"
        return f"{page}#{anchor}" if anchor else page

    def to_case(self, case: str, *names: str) -> str:
        """A link to a case, a variant of it, or a scheme in that."""
        return self.to(self.page_of(case), slug(case, *names))

    def to_code(self, label: str) -> str:
        """A link to the page of a code."""
        return self.to(self.page_of_code(label.partition("/")[0]))
