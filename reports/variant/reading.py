"""Reads from a record the error and the quantity by which tables rank it."""

from __future__ import annotations

from reports.text import slug
from vv.records.job_record import Record
from vv.records.outcomes import JudgeKind
from vv.records.quantity import MeasuredQuantity

TARGET = 1e-3  # the error for which codes are recommended


def anchor(record: Record) -> str:
    """The place in a page where a scheme in a variant stands."""
    return slug(record.case, record.variant, record.label)


def margin(one: MeasuredQuantity) -> float | None:
    """Tolerance over error; None where either is missing or the error is zero."""
    return one.tolerance / one.error if one.error and one.tolerance else None


def judged_error(one: MeasuredQuantity | None) -> float | None:
    """The error of a quantity; None where its value is judged by an interval, not its error."""
    return None if one is None or one.judge is JudgeKind.INTERVAL else one.error


def nearest(record: Record) -> MeasuredQuantity | None:
    """The quantity of a record that is nearest to its tolerance, or farthest outside."""
    return min(record.quantities, key=lambda q: margin(q) or float("inf"), default=None)
