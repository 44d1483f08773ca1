"""Judges the records of an invocation by all checks: references, baselines, speed, known errors."""

from __future__ import annotations

import dataclasses
import datetime
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from vv.case import Check
from vv.gate import (
    answers,
    baseline,
    disagreement,
    independence,
    known_breaches,
    recorded,
    regression,
    speed,
)
from vv.gate.ledger_file import read_breaches, read_disagreements
from vv.gate.regression import Strictness
from vv.plan.plan import Plan
from vv.plan.project import Project
from vv.records.accepted import AcceptanceSummary, Baseline, BaselineSummary
from vv.records.finding import Aspect, Bit, Finding
from vv.records.job_record import Record
from vv.records.manifest import Machine
from vv.records.recorded import RecordedResult
from vv.store.provenance import machine


@dataclass(frozen=True)
class GateOptions:
    """What a judgement depends on besides the records: the date, and how strict it is.

    timer: the machine on which costs were timed. against: a folder of baselines that must have
    every result. timing: speed is enforced.
    """

    today: datetime.date
    timer: Machine = field(default_factory=machine)
    against: Path | None = None
    timing: bool = False


@dataclass(frozen=True)
class Judged:
    """The parts of a manifest that a judgement produces, with the same names."""

    records: tuple[Record, ...]
    findings: tuple[Finding, ...]
    baselines: Mapping[str, BaselineSummary]
    recorded: tuple[RecordedResult, ...]


def baselines_of(project: Project) -> Path:
    """The folder of a project's own baselines."""
    return project.root / "cases" / "baselines"


def baseline_of(project: Project, case: str) -> Baseline | None:
    """The baseline of a case: the project's own, else the one that came with the case, or None."""
    found = (baseline.read(root / "cases" / "baselines", case) for root in project.roots)
    return next((one for one in found if one is not None), None)


def recorded_of(project: Project) -> Path:
    """The folder of a project's recorded results."""
    return project.root / "cases" / "recorded"


def judged(project: Project, plan: Plan, records: Sequence[Record], options: GateOptions) -> Judged:
    """The records with their final verdicts, and what baselines and known disagreements add."""
    folders = [root / "cases" for root in project.roots]
    ledgers = [folder / "disagreements.toml" for folder in folders]
    known = tuple(entry for path in ledgers for entry in read_disagreements(path))
    broken = tuple(entry for path in ledgers for entry in read_breaches(path))
    independent = independence.fail_dependent(records, independence.shared_sources(project, plan))
    final = known_breaches.judge(
        disagreement.judge(independent, known, options.today), broken, options.today
    )
    against = options.against
    accepted = {
        case: baseline.read(against, case) if against else baseline_of(project, case)
        for case in plan.cases
    }
    findings = (
        *disagreement.expiry_findings(final, known, options.today),
        *known_breaches.not_broken(final, broken, options.today),
        *known_breaches.expiry_findings(final, broken, options.today),
        *_since(project, plan, final, accepted, options),
        *_untimed(final, options),
    )
    summaries = {case: _summary(found) for case, found in accepted.items() if found}
    past = [
        one
        for folder in folders
        for one in recorded.shown(folder / "recorded", final, options.today)
    ]
    return Judged(final, findings, summaries, tuple(past))


def _since(
    project: Project,
    plan: Plan,
    records: Sequence[Record],
    accepted: Mapping[str, Baseline | None],
    options: GateOptions,
) -> list[Finding]:
    """What changed since the baselines were accepted: results and speed of each case."""
    external = {code for code, found in plan.found.items() if found.files}
    labels = {f"{name}/{s.name}" for name, code in plan.adapters.items() for s in code.schemes}
    asked = {record.code for record in records}
    demanded = options.against is not None
    by_case: dict[str, list[Record]] = {name: [] for name in plan.cases}
    for record in records:
        by_case[record.case].append(record)
    found: list[Finding] = []
    for name, case in plan.cases.items():
        was, enforced = accepted[name], Check.REGRESSION in case.enforced
        found += regression.compare(
            name, by_case[name], was, Strictness(external, enforced, demanded)
        )
        variants = {variant.name for variant in case.variants}
        removed = regression.removed_results(name, was, variants, labels, asked)
        found += [dataclasses.replace(one, enforced=enforced) for one in removed]
        found += answers.compare(
            name, by_case[name], answers.accepted(project, name) or {}, enforced
        )
        strict = options.timing and Check.SPEED in case.enforced
        found += speed.compare(name, by_case[name], was, options.timer.processor, strict)
    return found


def _untimed(records: Sequence[Record], options: GateOptions) -> list[Finding]:
    """A finding if a timing session was requested and nothing was timed."""
    if not options.timing or any(record.cost.timed for record in records):
        return []
    return [Finding(Aspect.SPEED, "nothing timed", "nothing was timed", bit=Bit.INCOMPLETE)]


def _summary(found: Baseline) -> BaselineSummary:
    """The acceptances of a baseline, newest last, and how many results came by each."""
    counts: dict[str, int] = {}
    for result in found.results.values():
        counts[result.by] = counts.get(result.by, 0) + 1
    taken = [(found.acceptances[n], counts.get(n, 0)) for n in sorted(found.acceptances, key=int)]
    return BaselineSummary(
        len(found.results),
        tuple(
            AcceptanceSummary(a.commit, a.dirty, a.machine, a.reason, a.utc, a.versions, count)
            for a, count in taken
        ),
    )
