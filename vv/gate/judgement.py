"""Finds the faults of records, one finding each, and the exit bits of all."""

from __future__ import annotations

import fnmatch
from collections import Counter
from collections.abc import Container, Iterable, Iterator, Mapping, Sequence
from types import MappingProxyType

from vv.ask import Ledger, Status
from vv.case import Check
from vv.records.finding import Aspect, Bit, Finding, bits
from vv.records.job_record import Record
from vv.records.manifest import Manifest
from vv.records.outcomes import JudgeKind, Outcome, StudyKind, Verdict
from vv.records.quantity import MeasuredQuantity, MeasurementFacts, PrintedFacts
from vv.records.reading import ran, rung
from vv.scene import DISSIPATED

RUN_BITS = Bit.CRASH | Bit.TIMEOUT | Bit.INCOMPLETE | Bit.USAGE
STATUS_BITS: Mapping[
    Status, tuple[Bit, Bit]
] = {  # bits for an optional code, and for a required one
    Status.RAN: (Bit(0), Bit(0)),
    Status.REFUSED: (Bit(0), Bit(0)),
    Status.NOT_INSTALLED: (Bit(0), Bit.INCOMPLETE),
    Status.TOO_LONG: (Bit(0), Bit(0)),
    Status.NOT_RUN: (Bit.INCOMPLETE, Bit.INCOMPLETE),
    Status.ERROR: (Bit.CRASH, Bit.CRASH),
    Status.DIVERGED: (Bit.CRASH, Bit.CRASH),
    Status.TIMEOUT: (Bit.TIMEOUT, Bit.TIMEOUT),
}
WORST_FIRST = (Verdict.FAIL, Verdict.XPASS, Verdict.XFAIL, Verdict.PASS, Verdict.NO_REFERENCE)
RANKS = {verdict: rank for rank, verdict in enumerate(WORST_FIRST)}
OF_STATUS: Mapping[Status, Outcome] = {
    status: Outcome(status.value) for status in Status if status is not Status.RAN
}
OF_VERDICT = {verdict: Outcome(verdict.value) for verdict in Verdict}
SPOILED = (Outcome.FAIL, Outcome.XPASS, Outcome.NOT_REPORTED)  # regardless of its ledger
ALL = frozenset(Check)
UNEXPLAINED = "energy that no term explains"
LAWS = {  # a law of a ledger -> words for its violation, before the number
    UNEXPLAINED: "energy not conserved: unexplained",
    "energy created": "energy not conserved: created",
    **{f"negative {name}": f"energy not conserved: {name} gave" for name in DISSIPATED},
}
Breach = tuple[str, float, float]  # a law in words, the largest breach seen, the breach allowed


def judgement(manifest: Manifest, required: Iterable[str] = ()) -> list[Finding]:
    """All findings on an invocation: on its records, and on it as a whole."""
    enforced = {name: case.enforced for name, case in manifest.cases.items()}
    own = record_findings(manifest.records, required, enforced)
    return [*own, *manifest.findings]


def exit_bits(records: Iterable[Record], required: Iterable[str] = ()) -> Bit:
    """The faults of a set of records, as exit bits."""
    return bits(record_findings(list(records), required))


def record_findings(
    records: Sequence[Record],
    required: Iterable[str] = (),
    enforced: Mapping[str, Container[Check]] = MappingProxyType({}),
) -> list[Finding]:
    """The faults of a set of records; if none of them ran, that the set is incomplete.

    required: patterns CODE or CODE/SCHEME, for each of which at least one record must have run.
    enforced: case -> the checks that can turn the gate red, if not all.
    """
    patterns = tuple(p if "/" in p else f"{p}/*" for p in required)
    seen = {record.label for record in records if ran(record) or blew_up(record)}
    found = []
    if not seen:
        found.append(Finding(Aspect.RUN, "nothing ran", "nothing ran", bit=Bit.INCOMPLETE))
    for pattern in patterns:
        if not fnmatch.filter(seen, pattern):
            text, asked = "required, but none of its jobs ran", pattern.removesuffix("/*")
            missing = Finding(Aspect.RUN, "missing", text, label=asked, bit=Bit.INCOMPLETE)
            found.append(missing)
    for record in records:
        needed = any(fnmatch.fnmatchcase(record.label, pattern) for pattern in patterns)
        of_case = enforced.get(record.case, ALL)
        found += [
            *_of_status(record, needed),
            *_of_quantities(record, of_case),
            *_of_ledger(record, of_case),
        ]
    return found


def _of_run(record: Record, kind: str, text: str, bit: Bit) -> Finding:
    """A finding on whether a job ran."""
    place = record.case, record.variant, record.label, rung(record)
    return Finding(Aspect.RUN, kind, text, *place, bit=bit)


def _of_status(record: Record, needed: bool) -> Iterator[Finding]:
    status = record.status
    bit = Bit(0) if blew_up(record) else STATUS_BITS[status][needed]
    if bit:
        yield _of_run(record, status.value, f"{status.value}: {record.reason}", bit)
    if status is Status.RAN and not record.quantities:
        text = "it ran, but reported nothing to judge"
        yield _of_run(record, "not reported", text, Bit.INCOMPLETE)


def _of_quantities(record: Record, enforced: Container[Check]) -> Iterator[Finding]:
    for one in record.quantities:
        if one.verdict in (Verdict.FAIL, Verdict.XPASS):
            conserved = one.judge is JudgeKind.INVARIANT
            check = Check.CONSERVATION if conserved else Check.ACCURACY
            yield Finding(
                check=Aspect(check.value),
                kind=one.verdict.value,
                text=_in_words(one),
                case=record.case,
                variant=record.variant,
                label=record.label,
                rung=rung(record),
                quantity=one.name,
                bit=Bit.CONSERVATION if conserved else Bit.ACCURACY,
                enforced=check in enforced,
                size=one.error / one.tolerance if one.error and one.tolerance else 0.0,
            )


def _in_words(one: MeasuredQuantity) -> str:
    if one.error is not None and one.tolerance is not None:
        text = f"error {one.error:.3g}, tolerance {one.tolerance:.3g}"
    elif one.value is not None and one.measurement is not None:
        text = against_measurement(one.value, one.measurement) + f": {one.why}"
    elif one.value is not None and one.printed is not None:
        text = against_code(one.value, one.printed) + f": {one.why}"
    elif one.value is not None:
        text = f"value {one.value:.6g}: {one.why}"
    else:
        text = "not finite"
    return f"{text}; {one.note}" if one.note else text


def against_measurement(value: float, seen: MeasurementFacts) -> str:
    """A computed value compared with a measured one, in words."""
    band = "shown" if seen.band is None else f"band {seen.band:.3g}"
    return f"computed {value:.6g}, measured {seen.value:.6g} +- {seen.uncertainty:.2g}, {band}"


def against_code(value: float, other: PrintedFacts) -> str:
    """A computed value compared with that of another code, in words."""
    band = "shown" if other.band is None else f"band {other.band:.3g}"
    return f"computed {value:.6g}, {other.code} has {other.value:.6g}, {band}"


def _of_ledger(record: Record, enforced: Container[Check]) -> Iterator[Finding]:
    """Conservation laws that a run violates in its own ledger, beyond its scheme's bound."""
    for breach in unknown_breaches(record):
        law, seen, allowed = breach
        yield Finding(
            check=Aspect.CONSERVATION,
            kind=law,
            text=breach_in_words(breach),
            case=record.case,
            variant=record.variant,
            label=record.label,
            rung=rung(record),
            bit=Bit.CONSERVATION,
            enforced=Check.CONSERVATION in enforced,
            size=seen / allowed if allowed > 0 else 0.0,
        )


def breaches(ledger: Ledger | None) -> Iterator[Breach]:
    """The laws that a ledger violates: unexplained energy, negative dissipation, failed audits.

    Where a scheme declares no conserved energy, dissipation is not judged either, since it is wrong
    by the same amount.
    """
    if ledger is None:
        return
    if ledger.bound is not None:
        if not ledger.unaccounted <= ledger.bound:
            yield f"{UNEXPLAINED} [J]", ledger.unaccounted, ledger.bound
        for name, value in ledger.terms.items():
            if name in DISSIPATED and not -value <= ledger.bound:
                yield f"negative {name} [J]", -value, ledger.bound
    for law, (seen, allowed) in ledger.audits.items():
        if not seen <= allowed:
            yield law, seen, allowed


def unknown_breaches(record: Record) -> Iterator[Breach]:
    """The laws that a run violates in its own ledger without a known breach."""
    yield from (one for one in breaches(record.ledger) if one[0] not in record.known_breaches)


def blew_up(record: Record) -> bool:
    """Whether a run diverged in a map, where this is a result, or by a known breach."""
    known = record.study is StudyKind.GRID or bool(record.known_breaches)
    return record.status is Status.DIVERGED and known


def outcome(record: Record) -> Outcome:
    """The outcome of a record: its status unless it ran, else its worst verdict.

    A conservation law that its ledger violates makes a pass NOT_CONSERVED; if the breach is known,
    the record is a known disagreement.
    """
    return outcome_by(record, record.quantities)


def outcome_by(record: Record, quantities: Sequence[MeasuredQuantity]) -> Outcome:
    """The outcome of a record if it had only these of its quantities."""
    if not ran(record):
        return Outcome.BLOW_UP if blew_up(record) else OF_STATUS[record.status]
    worst = OF_VERDICT[_worst(quantities)] if quantities else Outcome.NOT_REPORTED
    if worst in SPOILED:
        return worst
    if record.ledger and next(unknown_breaches(record), None) is not None:
        return Outcome.NOT_CONSERVED
    return Outcome.XFAIL if record.known_breaches else worst


def _worst(quantities: Sequence[MeasuredQuantity]) -> Verdict:
    """The worst verdict; ranks are compared only if verdicts differ, since they rarely do."""
    first = quantities[0].verdict
    if all(one.verdict is first for one in quantities):
        return first
    return min((one.verdict for one in quantities), key=RANKS.__getitem__)


def counted(records: Iterable[Record]) -> Counter[Outcome]:
    """Outcome -> the number of records with it, as every summary counts them."""
    return Counter(map(outcome, records))


def breach_in_words(breach: Breach) -> str:
    """A law that a ledger violates, with the value and the bound, in words."""
    law, seen, allowed = breach
    name, _, unit = law.removesuffix("]").partition(" [")
    told = LAWS.get(name, f"{name}:")
    return f"{told} {plain(seen)} {unit}".rstrip() + f", allowed {plain(allowed)} {unit}".rstrip()


def plain(value: float) -> str:
    """A number to three digits, such as 1390 instead of 1.39e+03."""
    return f"{float(f'{value:.3g}'):g}"
