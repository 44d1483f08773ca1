"""Known breaches: which conservation laws a code is known to violate, where, and by how much."""

from __future__ import annotations

import dataclasses
import datetime
import fnmatch
import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from vv.ask import Ledger, Status
from vv.gate.expiry import by_code_and_case, expiring, in_force
from vv.gate.judgement import Breach, breaches
from vv.records.finding import Aspect, Bit, Finding
from vv.records.job_record import Record
from vv.records.reading import ran, rung

CREATED = "energy created [J]"
WIDEST = 10.0  # largest over smallest breach of a band: more than a decade says nothing


@dataclass(frozen=True)
class KnownBreach:
    """A law that a code is known to violate in its own energy ledger, with a band on the breach.

    schemes, versions, variants, law and rungs are globs; rungs are written as for `--rung`,
    dt=0.2,kn=1000000. breach: the smallest and the largest known breach, in the law's unit. At each
    such rung the breach must lie within the band; otherwise this is reported. elsewhere: the
    largest breach at parameters other than those of the case, over what the law allows; if the law
    is in J, over the largest energy stored, or over the energy turned over if a dissipation is
    negative; a run that diverged there has created energy, which the same entry knows. An entry
    without `breach` applies to such parameters alone, unless it has rounding: there rounding
    decides at the parameters of the case too whether the law is broken, and `elsewhere` limits the
    breach. expires: ISO date. Raises ValueError naming the field, the value and the rule.
    """

    code: str
    schemes: str
    versions: str
    case: str
    variants: tuple[str, ...]
    law: str
    rungs: tuple[str, ...]
    reason: str
    expires: str
    breach: tuple[float, float] | None = None
    elsewhere: float | None = None
    rounding: bool = False

    def __post_init__(self) -> None:
        low, high = self.breach or (self.elsewhere or 0.0,) * 2
        if not 0 < low <= high <= WIDEST * low:
            rule = f"a band must be positive and end within a factor of {WIDEST:g}"
            raise ValueError(f"breach = [{low:g}, {high:g}]; {rule}")
        if self.rounding and self.breach:
            rule = "the breach is limited by `elsewhere` then, and no `breach` is given"
            raise ValueError(f"rounding = true; {rule}")
        if not self.reason.strip():
            raise ValueError("reason is empty; say why the law is broken")
        datetime.date.fromisoformat(self.expires)

    @property
    def subject(self) -> tuple[Aspect, Bit, str]:
        """The check, the exit bit that it sets once it has expired, and its law."""
        return Aspect.CONSERVATION, Bit.CONSERVATION, self.law

    def is_limited(self, record: Record) -> bool:
        """Whether `elsewhere` limits a record's breach, rather than that the band must have it."""
        return record.modified or self.rounding

    def covers(self, record: Record) -> bool:
        """Whether this entry applies to a record, with the parameters of the case or others."""
        pairs = (
            (record.code, self.code),
            (record.scheme, self.schemes),
            (record.code_version, self.versions),
            (record.case, self.case),
        )
        several = ((record.variant, self.variants), (rung(record), self.rungs))
        return (
            (ran(record) or (self.is_limited(record) and record.status is Status.DIVERGED))
            and (self.elsewhere if self.is_limited(record) else self.breach) is not None
            and all(fnmatch.fnmatchcase(name, glob) for name, glob in pairs)
            and all(any(fnmatch.fnmatchcase(n, glob) for glob in globs) for n, globs in several)
        )

    def knows(self, breach: Breach, record: Record) -> bool:
        """Whether a breach that a covered record shows is of this law and not larger than known."""
        law, seen, allowed = breach
        if not fnmatch.fnmatchcase(law, self.law):
            return False
        if not self.is_limited(record):
            low, high = self.breach or (0.0, 0.0)
            return low <= seen <= high
        if record.ledger is None or not ran(record):
            return law == CREATED
        scale = record.ledger.peak if law.endswith("[J]") else allowed
        if law.startswith("negative "):
            scale = turned_over(record.ledger)
        return seen <= (self.elsewhere or 0.0) * scale


def turned_over(ledger: Ledger) -> float:
    """The energy [J] that a run holds, has dissipated or given away in the end, or held at most.

    A dissipation that is negative by more would break the balance.
    """
    return max(ledger.peak, sum(max(term, 0.0) for term in ledger.terms.values()))


def judge(
    records: Iterable[Record], known: Sequence[KnownBreach], today: datetime.date
) -> tuple[Record, ...]:
    """The records, each with the laws that entries in force say it breaks."""
    entries = by_code_and_case(in_force(known, today))
    return tuple(_judged(record, entries(record.code, record.case)) for record in records)


def _judged(record: Record, known: Iterable[KnownBreach]) -> Record:
    entries = [entry for entry in known if entry.covers(record)]
    found = [
        (breach[0], entry.reason)
        for breach in (_broken(record) if entries else ())
        for entry in entries
        if entry.knows(breach, record)
    ]
    if not found:
        return record
    reasons = (f"{law}, a known breach: {reason}" for law, reason in found)
    return dataclasses.replace(
        record,
        known_breaches=tuple(dict.fromkeys(law for law, _ in found)),
        reason="; ".join(filter(None, (record.reason, *reasons))),
    )


def _broken(record: Record) -> Iterator[Breach]:
    """The laws that a record breaks; one that diverged created energy."""
    return breaches(record.ledger) if ran(record) else iter(((CREATED, math.inf, 0.0),))


def not_broken(
    records: Iterable[Record], known: Sequence[KnownBreach], today: datetime.date
) -> Iterator[Finding]:
    """A finding for each setting at which a law holds although an entry says that it is broken."""
    entries = by_code_and_case(in_force(known, today))
    for record in records:
        for entry in entries(record.code, record.case):
            if record.modified or not entry.breach or not entry.covers(record):
                continue
            if not any(entry.knows(breach, record) for breach in breaches(record.ledger)):
                low, high = entry.breach
                yield Finding(
                    check=Aspect.CONSERVATION,
                    kind="not as known",
                    text=f"{entry.law} should be {low:g} to {high:g}: {entry.reason}",
                    case=record.case,
                    variant=record.variant,
                    label=record.label,
                    rung=rung(record),
                    bit=Bit.CONSERVATION,
                )


def expiry_findings(
    records: Sequence[Record], known: Iterable[KnownBreach], today: datetime.date
) -> list[Finding]:
    """A finding for each entry on these records that expires soon or has expired."""
    return expiring(known, "breach", lambda one: any(map(one.covers, records)), today)
