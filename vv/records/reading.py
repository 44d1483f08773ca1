"""Helpers that read records: the setting in words, whether the job ran, sort keys."""

from __future__ import annotations

from vv.ask import Knobs, Status
from vv.records.job_record import Record

UNTRIED = (Status.REFUSED, Status.NOT_INSTALLED, Status.TOO_LONG)


def in_words(knobs: Knobs) -> str:
    """Knobs as text of twelve digits, dt=0.001,kn=1000000000; empty if there are none."""
    return ",".join(f"{name}={value:.12g}" for name, value in _named(knobs))


def to_the_last_digit(knobs: Knobs) -> str:
    """Knobs as text that gives the same numbers when it is read."""
    return ",".join(f"{name}={value!r}" for name, value in _named(knobs))


def _named(knobs: Knobs) -> list[tuple[str, float]]:
    every = (("dt", knobs.dt), ("kn", knobs.kn), ("dd", knobs.dd))
    return [(name, value) for name, value in every if value is not None]


def label(record: Record) -> str:
    """CODE/SCHEME of a record."""
    return record.label


def rung(record: Record) -> str:
    """The knobs of a record as text; empty if it has none."""
    return in_words(record.rung)


def fineness(rung: Knobs) -> tuple[float, float]:
    """A key to sort rungs: softest contact first, then the largest step."""
    return rung.kn or 0.0, -(rung.dt or 0.0)


def by_fineness(record: Record) -> tuple[float, float]:
    """A key to sort records by rung."""
    return fineness(record.rung)


def changed(record: Record) -> dict[str, float]:
    """The parameters that a user changed; all, if an older record does not say which."""
    names = record.changed or record.parameters if record.modified else ()
    return {name: record.parameters[name] for name in names}


def settings(record: Record) -> list[str]:
    """The changed parameters as --set takes them, NAME=VALUE, exact to the last digit."""
    return [f"{name}={shortest(value)}" for name, value in changed(record).items()]


def shortest(value: float) -> str:
    """A number in the fewest digits that read back as the same."""
    return short if float(short := f"{value:g}") == value else repr(value)


def ran(record: Record) -> bool:
    """Whether the run of a record reached its end."""
    return record.status is Status.RAN


def tried(record: Record) -> bool:
    """Whether the code attempted the job, which it did if it is installed and did not refuse."""
    return record.status not in UNTRIED


def too_long(record: Record) -> bool:
    """Whether a job was left out because it would take too many steps."""
    return record.status is Status.TOO_LONG
