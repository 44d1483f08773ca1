"""What an invocation says of stability: largest steps, maps, drift and counts, in sentences."""

from __future__ import annotations

import enum
import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

from vv.gate.judgement import blew_up
from vv.records.reading import fineness, label, too_long, tried

WRONG = 1.0  # relative error as large as the answer: no answer any more
Json = Mapping[str, Any]
Rung = tuple[Json, Json]  # a record, and its entry for the quantity at hand


class Kind(enum.StrEnum):
    """What there is to say of stability, in the order in which it is said."""

    STEP = "step"
    MAP = "map"
    DRIFT = "drift"
    COUNT = "count"


@dataclass(frozen=True)
class Told:
    """What one scheme says on one variant.

    value: over theory of a largest step; part of a map that is lost; largest breach of what is to
    be conserved; the count at the finest rung. due: what it should be. text: that in a sentence.
    """

    kind: Kind
    case: str
    variant: str
    label: str
    quantity: str
    value: float | None
    due: float | None
    text: str


def stability(manifest: Json) -> list[Told]:
    """All that the records of a manifest say of stability, by kind, case, variant and scheme."""
    found = [*_maps(manifest), *_others(manifest)]
    return sorted(found, key=lambda told: list(Kind).index(told.kind))


def as_data(manifest: Json) -> list[dict[str, Any]]:
    """The same as plain data."""
    return [asdict(told) for told in stability(manifest)]


def _others(manifest: Json) -> Iterator[Told]:
    """Largest steps, drift and counts: a quantity of one scheme on one variant, over its rungs."""
    piles: dict[tuple[Kind, str, str, str, str], list[Rung]] = {}
    for record in manifest["records"]:
        for entry in record["quantities"]:
            if kind := _kind(record, entry):
                place = (record["case"], record["variant"], label(record), entry["name"])
                piles.setdefault((kind, *place), []).append((record, entry))
    for (kind, case, variant, scheme, name), pile in piles.items():
        meaning = _meaning(manifest, case, variant, name)
        value, due, text = SAYS[kind](sorted(pile, key=lambda rung: fineness(rung[0])), meaning)
        yield Told(kind, case, variant, scheme, name, value, due, text)


def _kind(record: Json, entry: Json) -> Kind | None:
    """What a quantity tells of stability; None if nothing."""
    if record["study"] == "search":
        return Kind.STEP if entry["verdict"] != "no-reference" else None
    if record["study"] == "grid":
        return None
    if entry["judge"] == "invariant":
        return Kind.DRIFT
    return Kind.COUNT if entry["kind"] == "count" else None


def _meaning(manifest: Json, case: str, variant: str, name: str) -> str:
    told = manifest["cases"][case]["variants"][variant]["quantities"]
    return next((str(q["meaning"]) for q in told if q["name"] == name), name)


Said = tuple[float | None, float | None, str]


def _step(pile: Sequence[Rung], meaning: str) -> Said:
    record, entry = pile[-1]
    value = entry["value"]
    if value is None:
        return None, entry["reference"], "no step was stable"
    due = {"pass": "as due", "fail": "not as due"}.get(entry["verdict"], "known")
    parts = [f"{meaning}: {value:.4g}, {due}", entry["note"], record["reason"]]
    return value, entry["reference"], "; ".join(part for part in parts if part)


def _drift(pile: Sequence[Rung], meaning: str) -> Said:
    worst = max((e["errors"].get("max") or 0.0 for _, e in pile), default=0.0)
    if any(e["value"] is None and not e["figures"] for _, e in pile):
        return None, pile[-1][1]["tolerance"], f"{meaning}: not finite"
    bound = pile[-1][1]["tolerance"]
    kept = "kept to" if worst <= bound else "drifts by"
    return worst, bound, f"{meaning}: {kept} {worst:.2g} of its scale, {bound:.2g} allowed"


def _count(pile: Sequence[Rung], meaning: str) -> Said:
    values = [None if entry["value"] is None else round(entry["value"]) for _, entry in pile]
    due = pile[-1][1]["reference"]
    steps = any(record["rung"]["dt"] for record, _ in pile)
    if len(set(values)) == 1:
        said = f"{values[0]}{' at every step' if len(values) > 1 and steps else ''}"
    else:
        said = f"{', '.join(map(str, values))} from the longest step to the shortest"
    exact = "" if due is None else f"; {due} in the exact motion"
    return values[-1], due, f"{meaning}: {said}{exact}"


SAYS: Mapping[Kind, Callable[[Sequence[Rung], str], Said]] = {
    Kind.STEP: _step,
    Kind.DRIFT: _drift,
    Kind.COUNT: _count,
}


def _maps(manifest: Json) -> Iterator[Told]:
    """How much of each map is lost in each scheme, where, and how good it gets."""
    piles: dict[tuple[str, str, str], list[Json]] = {}
    for record in manifest["records"]:
        if record["study"] == "grid":
            place = (record["case"], record["variant"], label(record))
            piles.setdefault(place, []).append(record)
    for (case, variant, scheme), pile in piles.items():
        taken = list(filter(tried, pile))
        if any(r["rung"]["dt"] for r in taken):
            critical = dict(manifest["cases"][case]["variants"][variant].get("critical", ()))
            lost = [r for r in taken if not _error(r) < WRONG]
            text = _in_words(pile, taken, lost, critical)
            yield Told(Kind.MAP, case, variant, scheme, "", len(lost) / len(taken), None, text)


def _error(record: Json) -> float:
    """The largest error of a point of a map; inf where it has none."""
    errors = [entry["errors"].get("max") for entry in record["quantities"] if entry["errors"]]
    return max((math.inf if e is None else e for e in errors), default=math.inf)


def _in_words(
    pile: Sequence[Json],
    taken: Sequence[Json],
    lost: Sequence[Json],
    critical: Mapping[float | None, float],
) -> str:
    best = min(taken, key=_error)
    blown = sum(map(blew_up, lost))
    long = sum(map(too_long, pile))
    untried = {"refused": len(pile) - len(taken) - long, "too long to run": long}
    out = " and ".join(f"{count} {why}" for why, count in untried.items() if count)
    parts = [f"of {len(pile)} points {out}".rstrip()]
    ratios = list(_ratios(lost, critical))
    least = f", from {min(ratios):.3g} critical steps on" if ratios else ""
    diverged = f", {blown} of them diverged" if blown else ""
    parts.append(f"{len(lost)} lost{diverged}{least}" if lost else "none lost")
    at = ", ".join(f"{k} {v:.3g} {u}" for k, v, u in _knobs(best))
    parts.append(f"least error {_error(best):.2g}{f' at {at}' if at else ''}")
    return ", ".join(parts)


def _ratios(records: Iterable[Json], critical: Mapping[float | None, float]) -> Iterator[float]:
    for record in records:
        unit, dt = critical.get(record["rung"]["kn"]), record["rung"]["dt"]
        if unit and dt:
            yield dt / unit


def _knobs(record: Json) -> Iterator[tuple[str, float, str]]:
    for name, unit in (("kn", "N/m"), ("dt", "s")):
        if record["rung"][name]:
            yield name, record["rung"][name], unit
