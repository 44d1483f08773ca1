"""Known disagreements: where a code is known to be wrong, and the bands of error and order."""

from __future__ import annotations

import dataclasses
import datetime
import fnmatch
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from vv.ask import Knobs
from vv.base.metrics import Order
from vv.case import LARGEST_TOLERANCE, NOTHING, Norm
from vv.gate.expiry import by_code_and_case, expiring, in_force
from vv.records.finding import Aspect, Bit, Finding
from vv.records.job_record import Record
from vv.records.outcomes import JudgeKind, Verdict
from vv.records.quantity import MeasuredQuantity
from vv.records.reading import rung
from vv.records.rungs import Key, ladder, orders

WIDEST = 10.0  # largest over smallest error of a band: more than a decade says nothing
BROADEST = 0.6  # width of a band of orders: it holds one of 0, 1 and 2 at most

ELSEWHERE = 0.5  # how far an order may leave its band at parameters other than the case's own


@dataclass(frozen=True)
class Disagreement:
    """A known error of a code, with two-sided bands on the error and the observed order.

    Patterns are globs; versions: those in which it was seen. error: (low, high) at the step dt [s];
    it is scaled to other steps with the middle of the order band, and from the stiffness kn [N/m]
    of springs that represent rigid contact to others as kn**-softness. A band that reaches below
    the tolerance expects passes too. A band is refused if it is so wide that it excludes nothing,
    or if it scales with the step although its errors exceed every possible tolerance; an error that
    does not scale may have any size. An entry without an order claims none, and its band does not
    change with the step. rungs: globs on the settings to which it applies, written
    dt=0.001,kn=100000000. elsewhere: the largest error at parameters other than those of the case;
    an entry without `error` applies to those alone. instead: the quantity of the same run whose
    exact answer the code gives instead, within that quantity's tolerance, at any parameters.
    expires: ISO date.
    """

    code: str
    schemes: str
    versions: str
    case: str
    variants: tuple[str, ...]
    quantity: str
    dt: float
    reason: str
    expires: str
    error: tuple[float, float] | None = None
    elsewhere: float | None = None
    instead: str = ""
    order: tuple[float, float] | None = None
    kn: float | None = None
    softness: float = 0.0
    rungs: tuple[str, ...] = ("*",)

    def __post_init__(self) -> None:
        for name, band in (("error", self.error), ("order", self.order)):
            if band and not band[0] <= band[1]:
                raise ValueError(f"{name} = [{band[0]:g}, {band[1]:g}]; a band must not be empty")
        least = self.elsewhere if self.error is None else self.error[0]
        if not self.dt > 0 or not (self.instead or (least is not None and least > 0)):
            told = "none" if least is None else f"from {least:g}"
            raise ValueError(f"dt = {self.dt:g} s, error {told}; both must be > 0")
        self._check_widths()
        if not self.reason.strip():
            raise ValueError("reason is empty; say what the code does otherwise")
        datetime.date.fromisoformat(self.expires)

    def _check_widths(self) -> None:
        """Raise ValueError for bands that exclude nothing."""
        low, high = self.error or (0.0, 0.0)
        if high > WIDEST * low:
            raise ValueError(
                f"error = [{low:g}, {high:g}]; a band must end within a factor of {WIDEST:g}"
            )
        if self.order is None:
            return
        if high > LARGEST_TOLERANCE and any(self.order):
            raise ValueError(
                f"error = [{low:g}, {high:g}] at dt = {self.dt:g} s; a band that is moved with the "
                f"step must end at {LARGEST_TOLERANCE:g}"
            )
        if self.order[1] - self.order[0] > BROADEST:
            raise ValueError(
                f"order = [{self.order[0]:g}, {self.order[1]:g}]; a band wider than {BROADEST:g} "
                "excludes nothing"
            )

    @property
    def subject(self) -> tuple[Aspect, Bit, str]:
        """The check, the exit bit that it sets once it has expired, and its quantity."""
        return Aspect.ACCURACY, Bit.ACCURACY, self.quantity

    def covers(self, record: Record, quantity: str) -> bool:
        """Whether this entry applies to a quantity of a record."""
        pairs = (
            (record.code, self.code),
            (record.scheme, self.schemes),
            (record.code_version, self.versions),
            (record.case, self.case),
            (quantity, self.quantity),
        )
        if not all(fnmatch.fnmatchcase(name, glob) for name, glob in pairs):
            return False  # the usual case; formatting a rung takes long
        if not (self.error or self.instead or record.modified):
            return False
        several = ((record.variant, self.variants), (rung(record), self.rungs))
        return all(any(fnmatch.fnmatchcase(n, glob) for glob in globs) for n, globs in several)

    def band(self, rung: Knobs) -> tuple[float, float]:
        """The least and the largest error expected at a rung of the case's own parameters."""
        low, high = self.error or (0.0, 0.0)
        middle = sum(self.order) / 2 if self.order else 0.0
        scale = float(((rung.dt or self.dt) / self.dt) ** middle)
        if self.kn and rung.kn:
            scale *= (self.kn / rung.kn) ** self.softness
        return low * scale, high * scale


def judge(
    records: Iterable[Record], disagreements: Iterable[Disagreement], today: datetime.date
) -> tuple[Record, ...]:
    """The records, with the verdicts that known disagreements change.

    A failure within its bands is known (xfail), or shown only where a band at other parameters
    holds an answer of zero. A failure outside them stays red, and a pass is
    reported (xpass). An entry that has expired excuses nothing.
    """
    given = list(records)
    entries = by_code_and_case(in_force(disagreements, today))
    fitted = orders(given)
    return tuple(_judged(record, entries(record.code, record.case), fitted) for record in given)


def _judged(record: Record, entries: Iterable[Disagreement], fitted: Mapping[Key, Order]) -> Record:
    if not entries:
        return record
    quantities = []
    for one in record.quantities:
        speaks = entries if one.judge is JudgeKind.EXACT else ()
        known = _entry_on(record, one.name, speaks)
        order = fitted.get(ladder(record, one.name))
        quantities.append(_turned(record, one, known, order) if known else one)
    if all(new is old for new, old in zip(quantities, record.quantities, strict=True)):
        return record
    return dataclasses.replace(record, quantities=tuple(quantities))


def _entry_on(
    record: Record, quantity: str, entries: Iterable[Disagreement]
) -> Disagreement | None:
    """The first entry on a quantity; at other parameters, first of all one that speaks of them.

    The settings of a rung may be the same there, so that entries on the case's own cover it too.
    """
    found = [entry for entry in entries if entry.covers(record, quantity)]
    spoken = [entry for entry in found if entry.elsewhere or entry.instead]
    return next(iter(spoken if record.modified and spoken else found), None)


def _turned(
    record: Record, one: MeasuredQuantity, known: Disagreement, order: Order | None
) -> MeasuredQuantity:
    if one.verdict is Verdict.PASS:
        return _turned_pass(record, one, known)
    if one.verdict is not Verdict.FAIL or one.note:
        return one  # not judged, or for example nothing moves: worse than any disagreement
    contrary = _not_as_known(record, one, known, order)
    if not contrary and record.modified and (known.elsewhere or 0.0) >= NOTHING:
        told = f"an error of {known.elsewhere:g} is known, so that nothing is told: {known.reason}"
        return dataclasses.replace(one, verdict=Verdict.NO_REFERENCE, note=told)
    if not contrary:
        return dataclasses.replace(one, verdict=Verdict.XFAIL, note=known.reason)
    return dataclasses.replace(one, note=f"{contrary} of the known disagreement")


def _turned_pass(record: Record, one: MeasuredQuantity, known: Disagreement) -> MeasuredQuantity:
    """A quantity that passes although an entry says that it is wrong."""
    band = known.band(record.rung)
    in_band = _in_band(record, one, known, band)
    if in_band and one.tolerance is not None and one.tolerance < band[1]:
        return one  # the band includes the tolerance, so that a pass is expected too
    if record.modified:
        return one  # how far two laws are apart depends on the parameters
    note = f"passes, though {known.reason}"
    return dataclasses.replace(one, verdict=Verdict.XPASS, note=note)


def _not_as_known(
    record: Record, one: MeasuredQuantity, known: Disagreement, order: Order | None
) -> str:
    """What of a failure is outside the band of an entry, in words; empty if nothing is."""
    low, high = known.band(record.rung)
    if record.modified and not known.instead:  # bands were measured at the case's own parameters
        low, high = 0.0, known.elsewhere or max(LARGEST_TOLERANCE, high)
    if not _in_band(record, one, known, (low, high)):
        if known.instead:
            return f"{known.instead} lacks the exact answer that is part"
        return f"outside the error band from {low:.3g} to {high:.3g}"
    if order is None or known.order is None:
        return ""
    margin = ELSEWHERE if record.modified else 0.0
    least, most = known.order[0] - margin, known.order[1] + margin
    if least <= order.order <= most:
        return ""
    return f"order {order.order:.3g} lies outside the band from {least:.3g} to {most:.3g}"


def _in_band(
    record: Record, one: MeasuredQuantity, known: Disagreement, band: tuple[float, float]
) -> bool:
    """Whether the error lies in the band, or the quantity `instead` has the exact answer."""
    if known.instead:
        return _has(record, known.instead, one.tolerance)
    return one.error is not None and band[0] <= one.error <= band[1]


def _has(record: Record, name: str, tolerance: float | None) -> bool:
    """Whether a record has the exact answer of the quantity of that name."""
    errors = [one.errors.get(Norm.MAX) for one in record.quantities if one.name == name]
    return any(tolerance is not None and e is not None and e <= tolerance for e in errors)


def expiry_findings(
    records: Sequence[Record], disagreements: Iterable[Disagreement], today: datetime.date
) -> list[Finding]:
    """A finding for each entry on these records that expires soon or has expired."""
    return expiring(disagreements, "disagreement", lambda one: _is_used(one, records), today)


def _is_used(known: Disagreement, records: Iterable[Record]) -> bool:
    return any(known.covers(r, one.name) for r in records for one in r.quantities)
