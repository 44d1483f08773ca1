"""Judges the records of an invocation by all there is: references, ledger, baselines, speed."""

from __future__ import annotations

import datetime
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from vv.case import Check
from vv.gate import answers, baseline, disagreement, independence, recorded, regression, speed
from vv.plan.plan import Plan
from vv.plan.project import Project
from vv.records.finding import Bit, Finding
from vv.store.provenance import machine

Record = dict[str, Any]


@dataclass(frozen=True)
class Terms:
    """What a judgement depends on besides records and project: the day, and what was demanded.

    against: a folder of baselines that must have every result. timing: speed is enforced.
    """

    today: datetime.date
    against: Path | None = None
    timing: bool = False


def baselines_of(project: Project) -> Path:
    """The folder of a project's own baselines."""
    return project.root / "cases" / "baselines"


def baseline_of(project: Project, case: str) -> Record | None:
    """The baseline of a case: the project's own, else that which came with the case, or None."""
    found = (baseline.read(root / "cases" / "baselines", case) for root in project.roots)
    return next((one for one in found if one is not None), None)


def recorded_of(project: Project) -> Path:
    """The folder of a project's recorded results."""
    return project.root / "cases" / "recorded"


def judged(project: Project, plan: Plan, records: Sequence[Record], terms: Terms) -> dict[str, Any]:
    """The parts of a manifest that judge: records, findings, baselines, recorded results."""
    ledgers = [root / "cases" / "disagreements.toml" for root in project.roots]
    known = tuple(entry for path in ledgers for entry in disagreement.read_disagreements(path))
    independent = independence.disowned(records, independence.shared(project, plan))
    final = disagreement.judge(independent, known, terms.today)
    accepted = {
        case: baseline.read(terms.against, case) if terms.against else baseline_of(project, case)
        for case in plan.cases
    }
    findings = [
        *disagreement.dated(final, known, terms.today),
        *_since(project, plan, final, accepted, terms),
        *_untimed(final, terms),
    ]
    return {
        "records": final,
        "findings": [finding.as_data() for finding in findings],
        "baselines": {case: _acceptances(found) for case, found in accepted.items() if found},
        "recorded": [
            one
            for root in project.roots
            for one in recorded.shown(root / "cases" / "recorded", final, terms.today)
        ],
    }


def _since(
    project: Project,
    plan: Plan,
    records: Sequence[Record],
    accepted: Mapping[str, Record | None],
    terms: Terms,
) -> list[Finding]:
    """What moved since the baselines were accepted: results and speed of each case."""
    external = {code for code, found in plan.found.items() if found.files}
    adapters = {name: project.load_adapter(name) for name in project.adapter_names()}
    labels = {f"{name}/{s.name}" for name, adapter in adapters.items() for s in adapter.schemes}
    asked = {record["code"] for record in records}
    found: list[Finding] = []
    for name, case in plan.cases.items():
        was, enforced = accepted[name], Check.REGRESSION in case.enforced
        demanded = terms.against is not None
        found += regression.compare(name, records, was, external, enforced, demanded)
        variants = {variant.name for variant in case.variants}
        found += regression.gone(name, was, variants, labels, asked, enforced)
        found += answers.compare(name, records, answers.accepted(project, name) or {}, enforced)
        strict = terms.timing and Check.SPEED in case.enforced
        found += speed.compare(name, records, was, machine()["processor"], strict)
    return found


def _untimed(records: Sequence[Record], terms: Terms) -> list[Finding]:
    """A timing session was asked for and nothing was timed: that must not look like success."""
    if not terms.timing or any(r["cost"]["kind"] == "timed" for r in records):
        return []
    return [Finding("speed", "nothing timed", "nothing was timed", bit=Bit.INCOMPLETE)]


def _acceptances(found: Record) -> dict[str, Any]:
    """Why a baseline is as it is, newest last: reason, date, commit, platform, how many results."""
    counts: dict[str, int] = {}
    for result in found["results"].values():
        counts[result["by"]] = counts.get(result["by"], 0) + 1
    order = sorted(found["acceptances"], key=int)
    return {
        "results": len(found["results"]),
        "acceptances": [{**found["acceptances"][n], "results": counts[n]} for n in order],
    }
