"""Decides which record ends a run that is to stop at the first failure."""

from __future__ import annotations

import datetime
from collections.abc import Callable

from vv.gate import known_breaches
from vv.gate.judgement import record_findings
from vv.gate.ledger_file import read_breaches, read_disagreements
from vv.plan.project import Project
from vv.records.job_record import Record


def is_failure(project: Project) -> Callable[[Record], bool]:
    """The test whether a record by itself turns the gate red.

    A record that a known disagreement covers does not count: whether it stays within its band is
    known only when all settings have run.
    """
    ledgers = [root / "cases" / "disagreements.toml" for root in project.roots]
    known = [entry for path in ledgers for entry in read_disagreements(path)]
    broken = [entry for path in ledgers for entry in read_breaches(path)]

    def failed(record: Record) -> bool:
        if any(entry.covers(record, one.name) for one in record.quantities for entry in known):
            return False
        enforced = {record.case: project.load_case(record.case).enforced}
        judged = known_breaches.judge([record], broken, datetime.date.today())
        found = record_findings(judged, enforced=enforced)
        return any(finding.case and finding.red for finding in found)

    return failed
