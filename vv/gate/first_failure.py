"""Decides which record ends a run that is to stop at the first failure."""

from __future__ import annotations

import datetime
from collections.abc import Callable

from vv.gate import known_breaches
from vv.gate.expiry import in_force
from vv.gate.judgement import record_findings
from vv.gate.ledger_file import read_breaches, read_disagreements
from vv.plan.project import Project
from vv.records.job_record import Record
from vv.records.outcomes import JudgeKind


def is_failure(project: Project) -> Callable[[Record], bool]:
    """The test whether a record by itself turns the gate red.

    A quantity that a known disagreement covers does not count: whether it stays within its band is
    known only when all settings have run.
    """
    ledgers = [root / "cases" / "disagreements.toml" for root in project.roots]
    today = datetime.date.today()
    known = in_force([one for path in ledgers for one in read_disagreements(path)], today)
    broken = [entry for path in ledgers for entry in read_breaches(path)]

    def failed(record: Record) -> bool:
        names = [one.name for one in record.quantities if one.judge is JudgeKind.EXACT]
        covered = {name for name in names if any(entry.covers(record, name) for entry in known)}
        enforced = {record.case: project.load_case(record.case).enforced}
        judged = known_breaches.judge([record], broken, today)
        found = record_findings(judged, enforced=enforced)
        return any(one.case and one.red and one.quantity not in covered for one in found)

    return failed
