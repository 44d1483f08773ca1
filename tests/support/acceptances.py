"""Results that ran and were accepted, for tests of what the gate decides."""

from typing import Any

from tests.support.fabricated import changed, entry, record
from vv.gate import acceptance
from vv.records.accepted import Acceptance, Baseline, Place
from vv.records.job_record import Record

ACCEPTANCE = Acceptance("c", False, Place("P", "S"), "r", "u", {})


def ran(error: float | None = 1e-4, **changes: Any) -> Record:
    """A result that passed with this error."""
    figures = {"final": 3.0, "mean": 1.0}
    quantity = entry("pass", {"max": error}, scale=2.0, figures=figures)
    return changed(record("dem/default", "T1", 1e-3, quantities=[quantity]), **changes)


def accepted(*records: Record, old: Baseline | None = None) -> Baseline:
    """The baseline that accepting these records makes."""
    return acceptance.accepted("bounce", old, records, ACCEPTANCE, ())
