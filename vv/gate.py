"""The judgement: records against the ledger of known disagreements, and the exit bits."""

from __future__ import annotations

import datetime
import enum
import fnmatch
import math
import tomllib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from vv.ask import Status
from vv.metrics import Order, observed_order
from vv.record import Verdict


class Bit(enum.IntFlag):
    """Exit bits of `vv`; each means one kind of trouble."""

    ACCURACY = 1
    CONSERVATION = 2
    SPEED = 4
    CRASH = 8
    TIMEOUT = 16
    INCOMPLETE = 32
    USAGE = 64


RUN_BITS = Bit.CRASH | Bit.TIMEOUT | Bit.INCOMPLETE | Bit.USAGE
STATUS_BITS: Mapping[Status, tuple[Bit, Bit]] = {  # of an optional code, of a required one
    Status.RAN: (Bit(0), Bit(0)),
    Status.REFUSED: (Bit(0), Bit(0)),
    Status.NOT_INSTALLED: (Bit(0), Bit.INCOMPLETE),
    Status.NOT_RUN: (Bit.INCOMPLETE, Bit.INCOMPLETE),
    Status.ERROR: (Bit.CRASH, Bit.CRASH),
    Status.DIVERGED: (Bit.CRASH, Bit.CRASH),
    Status.TIMEOUT: (Bit.TIMEOUT, Bit.TIMEOUT),
}


WORST_FIRST = (Verdict.FAIL, Verdict.XPASS, Verdict.XFAIL, Verdict.PASS, Verdict.NO_REFERENCE)


@dataclass(frozen=True)
class Disagreement:
    """What a code is known to do otherwise, as two-sided bands on error and observed order.

    Patterns are globs; versions names those it was seen in. error: (low, high) at the step
    dt [s], moved to other steps with the middle of the order band. expires: ISO date.
    """

    code: str
    schemes: str
    versions: str
    case: str
    variants: tuple[str, ...]
    quantity: str
    dt: float
    error: tuple[float, float]
    order: tuple[float, float]
    reason: str
    expires: str

    def covers(self, record: Mapping[str, Any], quantity: str) -> bool:
        """Whether this entry speaks of a quantity of a record."""
        pairs = (
            (record["code"], self.code),
            (record["scheme"], self.schemes),
            (record["code_version"], self.versions),
            (record["case"], self.case),
            (quantity, self.quantity),
        )
        if not any(fnmatch.fnmatchcase(record["variant"], glob) for glob in self.variants):
            return False
        return all(fnmatch.fnmatchcase(name, glob) for name, glob in pairs)

    def holds(self, error: float, dt: float) -> bool:
        """Whether an error at a step lies within the band."""
        scale = float((dt / self.dt) ** (sum(self.order) / 2))
        return self.error[0] * scale <= error <= self.error[1] * scale


def read_disagreements(path: Path) -> tuple[Disagreement, ...]:
    """The ledger's entries; none if there is no file. Raises ValueError naming a bad entry."""
    if not path.is_file():
        return ()
    entries = tomllib.loads(path.read_text(encoding="utf-8")).get("disagreement", [])
    try:
        return tuple(Disagreement(**{k: _frozen(v) for k, v in entry.items()}) for entry in entries)
    except TypeError as error:
        raise ValueError(f"{path}: {error}") from error


def _frozen(value: Any) -> Any:
    """A list as a tuple, a date as its ISO text, anything else as it is."""
    if isinstance(value, list):
        return tuple(value)
    return value.isoformat() if isinstance(value, datetime.date) else value


def orders(records: Iterable[Mapping[str, Any]]) -> dict[tuple[str, ...], Order]:
    """Observed order in dt per (case, variant, code, scheme, quantity), where rungs allow it."""
    points: dict[tuple[str, ...], list[tuple[float, float]]] = {}
    for record in records:
        dt = record["rung"]["dt"]
        for entry in record["quantities"]:
            error = entry["errors"].get(entry["norm"] or "max")
            if dt and error:
                points.setdefault(ladder(record, entry["name"]), []).append((dt, error))
    fitted = {
        key: observed_order(*map(list, zip(*pairs, strict=True))) for key, pairs in points.items()
    }
    return {key: order for key, order in fitted.items() if order is not None}


def ladder(record: Mapping[str, Any], quantity: str) -> tuple[str, ...]:
    """What the rungs of one quantity have in common."""
    return (*(record[name] for name in ("case", "variant", "code", "scheme")), quantity)


def judge(
    records: Iterable[dict[str, Any]], disagreements: Iterable[Disagreement], today: str
) -> list[dict[str, Any]]:
    """The records with the verdicts that the ledger of known disagreements turns.

    A failure inside its bands is known (xfail); outside them, and a pass, are news (fail, xpass).
    An entry that has expired by today (ISO date) excuses nothing.
    """
    given = list(records)
    entries = tuple(entry for entry in disagreements if entry.expires >= today)
    fitted = orders(given)
    judged = []
    for record in given:
        quantities = []
        for entry in record["quantities"]:
            known = next((d for d in entries if d.covers(record, entry["name"])), None)
            order = fitted.get(ladder(record, entry["name"]))
            quantities.append(_turned(record, entry, known, order) if known else entry)
        judged.append({**record, "quantities": quantities})
    return judged


def _turned(
    record: Mapping[str, Any], entry: dict[str, Any], known: Disagreement, order: Order | None
) -> dict[str, Any]:
    verdict = Verdict(entry["verdict"])
    if verdict is Verdict.PASS:
        return {**entry, "verdict": Verdict.XPASS.value, "note": f"passes, though {known.reason}"}
    error = entry["errors"].get(entry["norm"] or "max")
    in_band = error is not None and known.holds(error, record["rung"]["dt"] or known.dt)
    slope = order.order if order else math.nan
    in_order = order is None or known.order[0] <= slope <= known.order[1]
    if verdict is Verdict.FAIL and in_band and in_order:
        return {**entry, "verdict": Verdict.XFAIL.value, "note": known.reason}
    what = f"order {slope:.3f}" if in_band else f"error {error}"
    return {**entry, "note": f"{what} lies outside the band of the known disagreement"}


def exit_bits(records: Iterable[Mapping[str, Any]], required: Iterable[str] = ()) -> Bit:
    """What is wrong with a set of records, as exit bits; nothing that ran is incomplete.

    required: patterns CODE or CODE/SCHEME of which at least one record each must have run.
    """
    given, bits = list(records), Bit(0)
    patterns = tuple(p if "/" in p else f"{p}/*" for p in required)
    for record in given:
        needed = any(fnmatch.fnmatchcase(_label(record), pattern) for pattern in patterns)
        bits |= STATUS_BITS[_status(record)][needed] | _verdict_bits(record) | _ledger_bits(record)
    ran = {_label(record) for record in given if _status(record) is Status.RAN}
    if not ran or any(not fnmatch.filter(ran, pattern) for pattern in patterns):
        bits |= Bit.INCOMPLETE
    return bits


def _verdict_bits(record: Mapping[str, Any]) -> Bit:
    if _status(record) is Status.RAN and not record["quantities"]:
        return Bit.INCOMPLETE
    bits = Bit(0)
    for entry in record["quantities"]:
        bad = Verdict(entry["verdict"]) in (Verdict.FAIL, Verdict.XPASS)
        conserved = entry["judge"] == "invariant"
        bits |= (Bit.CONSERVATION if conserved else Bit.ACCURACY) if bad else Bit(0)
    return bits


def _ledger_bits(record: Mapping[str, Any]) -> Bit:
    """Energy that no term explains, beyond what the scheme itself promises."""
    ledger = record["ledger"]
    broken = ledger and ledger["bound"] is not None and ledger["unaccounted"] > ledger["bound"]
    return Bit.CONSERVATION if broken else Bit(0)


def _label(record: Mapping[str, Any]) -> str:
    return f"{record['code']}/{record['scheme']}"


def _status(record: Mapping[str, Any]) -> Status:
    return Status[record["status"].upper().replace("-", "_")]


def outcome(record: Mapping[str, Any]) -> str:
    """A record in a word: its status unless it ran, else its worst verdict."""
    if _status(record) is not Status.RAN:
        return _status(record).value
    verdicts = {Verdict(entry["verdict"]) for entry in record["quantities"]}
    return next((v.value for v in WORST_FIRST if v in verdicts), "not reported")
