"""The judgement: what is wrong with records, one finding each, and the exit bits of all."""

from __future__ import annotations

import fnmatch
from collections import Counter
from collections.abc import Container, Iterable, Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import Any

from vv.ask import Status
from vv.case import Check
from vv.records.finding import Bit, Finding, bits, from_data
from vv.records.reading import error_of, label, ran, rung, status_of
from vv.records.record import Verdict

RUN_BITS = Bit.CRASH | Bit.TIMEOUT | Bit.INCOMPLETE | Bit.USAGE
STATUS_BITS: Mapping[Status, tuple[Bit, Bit]] = {  # of an optional code, of a required one
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
VERDICTS = {verdict.value: rank for rank, verdict in enumerate(WORST_FIRST)}
ALL = frozenset(check.value for check in Check)
BLOW_UP = "blow-up"  # the outcome of what diverged in a map
NOT_REPORTED, NOT_CONSERVED = "not reported", "not conserved"  # of what ran
SPOILED = (Verdict.FAIL.value, Verdict.XPASS.value, NOT_REPORTED)  # without a look at its ledger
DISSIPATION = " dissipation"  # how the names of energy terms end that can only grow


def judgement(manifest: Mapping[str, Any], required: Iterable[str] = ()) -> list[Finding]:
    """All that is to be said of an invocation: of its records, and what it found besides."""
    enforced = {name: case["enforced"] for name, case in manifest["cases"].items()}
    own = record_findings(manifest["records"], required, enforced)
    return [*own, *map(from_data, manifest["findings"])]


def exit_bits(records: Iterable[Mapping[str, Any]], required: Iterable[str] = ()) -> Bit:
    """What is wrong with a set of records, as exit bits."""
    return bits(record_findings(list(records), required))


def record_findings(
    records: Sequence[Mapping[str, Any]],
    required: Iterable[str] = (),
    enforced: Mapping[str, Container[str]] = MappingProxyType({}),
) -> list[Finding]:
    """What is wrong with a set of records; nothing that ran is incomplete.

    required: patterns CODE or CODE/SCHEME of which at least one record each must have run.
    enforced: case -> names of the checks that are not reported only, if not all.
    """
    patterns = tuple(p if "/" in p else f"{p}/*" for p in required)
    seen = {label(record) for record in records if ran(record)}
    found = []
    if not seen:
        found.append(Finding("run", "nothing ran", "nothing ran", bit=Bit.INCOMPLETE))
    for pattern in patterns:
        if not fnmatch.filter(seen, pattern):
            text = f"{pattern} is required, and nothing of it ran"
            found.append(Finding("run", "missing", text, label=pattern, bit=Bit.INCOMPLETE))
    for record in records:
        needed = any(fnmatch.fnmatchcase(label(record), pattern) for pattern in patterns)
        found += [
            *_of_status(record, needed),
            *_of_quantities(record, enforced.get(record["case"], ALL)),
            *_of_ledger(record, enforced.get(record["case"], ALL)),
        ]
    return found


def _about(record: Mapping[str, Any]) -> dict[str, Any]:
    place = {"case": record["case"], "variant": record["variant"]}
    return {**place, "label": label(record), "rung": rung(record)}


def _of_status(record: Mapping[str, Any], needed: bool) -> Iterator[Finding]:
    status = status_of(record)
    bit = Bit(0) if blew_up(record) else STATUS_BITS[status][needed]
    if bit:
        text = f"{status.value}: {record['reason']}"
        yield Finding("run", status.value, text, **_about(record), bit=bit)
    if status is Status.RAN and not record["quantities"]:
        text = "it ran, but reported nothing to judge"
        yield Finding("run", "not reported", text, **_about(record), bit=Bit.INCOMPLETE)


def _of_quantities(record: Mapping[str, Any], enforced: Container[str]) -> Iterator[Finding]:
    for entry in record["quantities"]:
        verdict = Verdict(entry["verdict"])
        if verdict in (Verdict.FAIL, Verdict.XPASS):
            conserved = entry["judge"] == "invariant"
            check = (Check.CONSERVATION if conserved else Check.ACCURACY).value
            error, bound = error_of(entry), entry["tolerance"]
            yield Finding(
                check=check,
                kind=verdict.value,
                text=_in_words(entry, error),
                **_about(record),
                quantity=entry["name"],
                bit=Bit.CONSERVATION if conserved else Bit.ACCURACY,
                enforced=check in enforced,
                size=error / bound if error and bound else 0.0,
            )


def _in_words(entry: Mapping[str, Any], error: float | None) -> str:
    parts = []
    if error is not None and entry["tolerance"] is not None:
        parts.append(f"error {error:.3g}, tolerance {entry['tolerance']:.3g}")
    elif entry["value"] is not None:
        parts.append(f"value {entry['value']:.6g}: {entry['why']}")
    else:
        parts.append("not finite")
    return "; ".join([*parts, entry["note"]] if entry["note"] else parts)


def _of_ledger(record: Mapping[str, Any], enforced: Container[str]) -> Iterator[Finding]:
    """Laws that a run breaks by its own ledger, beyond what its scheme promises."""
    ledger = record["ledger"]
    for law, seen, allowed in _breaches(ledger) if ledger else ():
        yield Finding(
            check=Check.CONSERVATION.value,
            kind=law,
            text=f"{law}: {seen:.3g} where at most {allowed:.3g} is allowed",
            **_about(record),
            bit=Bit.CONSERVATION,
            enforced=Check.CONSERVATION.value in enforced,
            size=seen / allowed if allowed > 0 else 0.0,
        )


def _breaches(ledger: Mapping[str, Any]) -> Iterator[tuple[str, float, float]]:
    """(law, breach, allowed): energy without a term, dissipation below zero, what was audited.

    Where a scheme promises no energy, dissipation is not judged either: it is off by as much.
    """
    if ledger["bound"] is not None:
        bound = ledger["bound"]
        laws = {"energy that no term explains [J]": ledger["unaccounted"]}
        for name, value in ledger["terms"].items():
            if name.endswith(DISSIPATION):
                laws[f"negative {name} [J]"] = -value
        yield from ((law, seen, bound) for law, seen in laws.items() if not seen <= bound)
    for law, (seen, allowed) in ledger["audits"].items():
        if not seen <= allowed:
            yield law, seen, allowed


def _conserves(record: Mapping[str, Any]) -> bool:
    """Whether a record's own ledger breaks no law; true where there is none."""
    return not record["ledger"] or next(_breaches(record["ledger"]), None) is None


def blew_up(record: Mapping[str, Any]) -> bool:
    """Whether a run diverged in a map, which is there to show that it does."""
    return status_of(record) is Status.DIVERGED and record.get("study") == "grid"


def outcome(record: Mapping[str, Any]) -> str:
    """A record in a word: its status unless it ran, else its worst verdict.

    A law that its ledger breaks spoils a record that would be fine.
    """
    if not ran(record):
        return BLOW_UP if blew_up(record) else status_of(record).value
    verdicts = (entry["verdict"] for entry in record["quantities"])
    worst = min(verdicts, key=VERDICTS.__getitem__, default=NOT_REPORTED)
    return worst if worst in SPOILED or _conserves(record) else NOT_CONSERVED


def counted(records: Iterable[Mapping[str, Any]]) -> Counter[str]:
    """Outcome -> how many records came to it: what every summary counts."""
    return Counter(map(outcome, records))
