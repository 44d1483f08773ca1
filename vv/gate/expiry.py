"""Entries of the file of known errors: which apply to a code and a case, and when they expire."""

from __future__ import annotations

import datetime
import functools
from collections.abc import Callable, Iterable
from fnmatch import fnmatchcase
from typing import Protocol, TypeVar

from vv.records.finding import Aspect, Bit, Finding

WARNING = 30  # days before an entry expires in which the gate says so


class ExpiringEntry(Protocol):
    """What all known errors have; patterns are globs, and expires is an ISO date."""

    @property
    def code(self) -> str: ...
    @property
    def schemes(self) -> str: ...
    @property
    def case(self) -> str: ...
    @property
    def variants(self) -> tuple[str, ...]: ...
    @property
    def subject(self) -> tuple[Aspect, Bit, str]: ...
    @property
    def reason(self) -> str: ...
    @property
    def expires(self) -> str: ...


Entry = TypeVar("Entry", bound=ExpiringEntry)


def in_force(entries: Iterable[Entry], today: datetime.date) -> tuple[Entry, ...]:
    """The entries that have not expired; the day that one names is its last."""
    return tuple(entry for entry in entries if entry.expires >= today.isoformat())


def by_code_and_case(entries: Iterable[Entry]) -> Callable[[str, str], tuple[Entry, ...]]:
    """A function that returns the entries on a code and a case, and searches once for each pair.

    Most entries apply to one case, and a report has thousands of records.
    """
    given = tuple(entries)

    @functools.cache
    def of(code: str, case: str) -> tuple[Entry, ...]:
        return tuple(e for e in given if fnmatchcase(code, e.code) and fnmatchcase(case, e.case))

    return of


def expiring(
    entries: Iterable[Entry], name: str, speaks: Callable[[Entry], bool], today: datetime.date
) -> list[Finding]:
    """A finding for each entry that applies here and expires soon or has expired.

    name: what an entry is called.
    """
    left = ((one, (datetime.date.fromisoformat(one.expires) - today).days) for one in entries)
    return [_expiry(one, name, days) for one, days in left if days <= WARNING and speaks(one)]


def _expiry(entry: ExpiringEntry, name: str, days: int) -> Finding:
    """That an entry expires in so many days, or has expired where these are negative."""
    over = days < 0
    when = f"expired {-days} days ago" if over else f"expires in {days} days"
    check, bit, quantity = entry.subject
    return Finding(
        check=check,
        kind="expired" if over else "expiring",
        text=f"the known {name} '{entry.reason}' {when}: renew or remove it",
        case=entry.case,
        variant=", ".join(entry.variants),
        label=f"{entry.code}/{entry.schemes}",
        quantity=quantity,
        bit=bit if over else Bit(0),
    )
