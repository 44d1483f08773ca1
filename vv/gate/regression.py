"""How a run compares with the results that were accepted: what moved, and beyond what band.

Bands apply to figures over the scale that was accepted, and to errors, which are relative
already: a tiny error may multiply without leaving them, since that is rounding.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from vv.ask import Status
from vv.gate.baseline import Json, name_of
from vv.records.finding import Bit, Finding
from vv.records.reading import error_of, label, ran, rung, status_of

LARGE = 1e99  # stands for an infinite change


@dataclass(frozen=True)
class Band:
    """How far a value over its scale, and an error, may move; and why that far."""

    width: float
    reason: str


IN_HOUSE = Band(1e-9, "our own arithmetic: only the last bits may differ between platforms")
EXTERNAL = Band(
    1e-6, "an external program: another build of it may round otherwise in each of many steps"
)


def compare(
    case: str,
    records: Sequence[Mapping[str, Any]],
    baseline: Json | None,
    external: Collection[str],
    enforced: bool,
    demanded: bool,
) -> list[Finding]:
    """What moved between the baseline of a case and its records, quantity by quantity.

    external: codes that are programs of others. enforced: whether a change is red. demanded:
    whether a result without a baseline is red too.
    """
    given = [r for r in records if r["case"] == case and not r["modified"]]
    if baseline is None:
        bit = Bit.INCOMPLETE if demanded else Bit(0)
        text = f"no baseline; to accept one: vv accept {case} --reason ..."
        found = [Finding("regression", "no baseline", text, case, bit=bit)]
        return found if any(map(ran, given)) else []
    others = _other_parameters(given, baseline)
    found = [_moved_parameters(case, variant, text) for variant, text in others.items()]
    for record in given:
        if record["variant"] not in others:
            found += _compared(record, baseline, external, enforced, demanded)
    return found


def _other_parameters(
    records: Iterable[Mapping[str, Any]], baseline: Mapping[str, Any]
) -> dict[str, str]:
    """Variant -> how its parameters differ from those its baseline was taken with."""
    found = {}
    for record in records:
        now, then = record["parameters"], baseline["parameters"].get(record["variant"])
        if then is not None and then != now:
            names = sorted(n for n in now.keys() | then.keys() if now.get(n) != then.get(n))
            found[record["variant"]] = ", ".join(
                f"{n} = {then.get(n)}, now {now.get(n)}" for n in names
            )
    return found


def _moved_parameters(case: str, variant: str, text: str) -> Finding:
    said = f"the baseline was taken with {text}"
    return Finding("regression", "other parameters", said, case, variant, bit=Bit.INCOMPLETE)


def _compared(
    record: Mapping[str, Any],
    baseline: Json,
    external: Collection[str],
    enforced: bool,
    demanded: bool,
) -> Iterator[Finding]:
    about = {"case": record["case"], "variant": record["variant"], "label": label(record)}
    then = baseline["results"].get(name_of(record))
    status = status_of(record)
    if then is None:
        if status is Status.RAN:
            bit = Bit.INCOMPLETE if demanded else Bit(0)
            text = "has no baseline yet"
            yield Finding("regression", "new", text, **about, rung=rung(record), bit=bit)
        return
    if status in (Status.REFUSED, Status.NOT_RUN, Status.TOO_LONG):
        text = f"has a baseline, but now: {status.value}: {record['reason']}"
        yield Finding(
            "regression", "gone", text, **about, rung=rung(record), bit=Bit.ACCURACY,
            enforced=enforced,
        )  # fmt: skip
    if status is not Status.RAN:
        return
    for name, kind, text, size in _changes(then, record, external):
        red = kind in ("worse", "moved", "gone")
        yield Finding(
            "regression", kind, text, **about, rung=rung(record), quantity=name,
            bit=Bit.ACCURACY if red else Bit(0), enforced=enforced, size=size,
        )  # fmt: skip


def _changes(
    then: Json, record: Mapping[str, Any], external: Collection[str]
) -> Iterator[tuple[str, str, str, float]]:
    """(name, kind, text, size in bands) of each quantity of a record that left its band."""
    band = EXTERNAL if record["code"] in external else IN_HOUSE
    now = {entry["name"]: entry for entry in record["quantities"]}
    for name in sorted((then.keys() | now.keys()) - {"by", "cost"}):
        kind, text, size = _change(then.get(name), now.get(name), band)
        if kind:
            yield name, kind, text, size


def _change(
    then: Mapping[str, Any] | None, now: Mapping[str, Any] | None, band: Band
) -> tuple[str, str, float]:
    """(kind, text, size in bands) of a quantity's change; kind is empty within the band."""
    if then is None:
        return "new", "has no baseline yet", 0.0
    if now is None:
        return "gone", "has a baseline, but is no longer reported", 0.0
    before, error = then["error"], error_of(now)
    if (before is None) != (error is None):
        kind = "worse" if error is None else "better"
        return kind, f"error {_said(before)}, now {_said(error)}", 0.0
    drift = (error or 0.0) - (before or 0.0)
    shift = _shift(then, now)
    size = min(max(abs(drift), shift) / band.width, LARGE)
    if abs(drift) > band.width:
        text = f"error {_said(before)}, now {_said(error)}; band {band.width:g}: {band.reason}"
        return ("worse" if drift > 0 else "better"), text, size
    if not shift <= band.width:
        text = f"value moved by {shift:.3g} of its scale; band {band.width:g}: {band.reason}"
        return "moved", text, size
    return "", "", size


def _shift(then: Mapping[str, Any], now: Mapping[str, Any]) -> float:
    """The largest change of a figure over the scale that was accepted."""
    names = (then.keys() | now["figures"].keys()) - {"error", "scale"}
    pairs = [(then.get(name), now["figures"].get(name)) for name in names]
    if any((a is None) != (b is None) for a, b in pairs):
        return float("inf")
    return max((abs(a - b) / then["scale"] for a, b in pairs if a is not None), default=0.0)


def _said(error: float | None) -> str:
    return "none" if error is None else f"{error:.3g}"


def gone(
    case: str,
    baseline: Json | None,
    variants: Collection[str],
    labels: Collection[str],
    codes: Collection[str],
    enforced: bool,
) -> list[Finding]:
    """Results in a baseline whose variant or scheme is no more.

    variants: those of the case. labels: the schemes of the codes there are. codes: those looked at.
    """
    found = {}
    for name in baseline["results"] if baseline else ():
        variant, scheme = name.split(" ")[:2]
        lost = variant not in variants or scheme not in labels
        if lost and scheme.partition("/")[0] in codes:
            text = "has a baseline, but is no longer there"
            found[variant, scheme] = Finding(
                "regression", "gone", text, case, variant, scheme, bit=Bit.ACCURACY,
                enforced=enforced,
            )  # fmt: skip
    return list(found.values())


def holds(then: Json, record: Mapping[str, Any], external: Collection[str]) -> bool:
    """Whether no quantity of a record has left its band."""
    return next(_changes(then, record, external), None) is None
