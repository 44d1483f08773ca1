"""Reads records: of what scheme and rung they are, what came of them, and how far off they are."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from vv.ask import Status

Record = Mapping[str, Any]
STATUSES = {status.name.lower().replace("_", "-"): status for status in Status}
UNTRIED = (Status.REFUSED, Status.NOT_INSTALLED, Status.TOO_LONG)


def label(record: Record) -> str:
    """CODE/SCHEME of a record."""
    return f"{record['code']}/{record['scheme']}"


def rung(record: Record) -> str:
    """The knobs of a record as text, dt=0.001,kn=1e+09; empty if it has none."""
    knobs = {name: record["rung"][name] for name in ("dt", "kn")}
    return ",".join(f"{name}={value:.12g}" for name, value in knobs.items() if value)


def fineness(record: Record) -> tuple[float, float]:
    """A key to sort records by rung: softest contact first, then the largest step."""
    return record["rung"]["kn"] or 0.0, -(record["rung"]["dt"] or 0.0)


def status_of(record: Record) -> Status:
    """The status that a record names."""
    return STATUSES[record["status"]]


def ran(record: Record) -> bool:
    """Whether a record is of a run that came to its end."""
    return status_of(record) is Status.RAN


def tried(record: Record) -> bool:
    """Whether the code took the job on: it is here, and did not refuse."""
    return status_of(record) not in UNTRIED


def too_long(record: Record) -> bool:
    """Whether a job was left out for the steps it would have taken."""
    return status_of(record) is Status.TOO_LONG


def error_of(entry: Mapping[str, Any]) -> float | None:
    """The error of a record's quantity in the norm that judges; None if it has none."""
    error: float | None = entry["errors"].get(entry["norm"] or "max")
    return error
