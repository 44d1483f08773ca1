"""Summarises stability in an invocation: largest steps, maps, drift and counts, in sentences."""

from __future__ import annotations

import enum
import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from vv.case import Norm
from vv.gate.judgement import blew_up
from vv.records.job_record import Record
from vv.records.manifest import Manifest
from vv.records.outcomes import JudgeKind, QuantityKind, StudyKind, Verdict
from vv.records.quantity import MeasuredQuantity
from vv.records.reading import by_fineness, too_long, tried

WRONG = 1.0  # a relative error of 100 %: the answer is useless
Rung = tuple[Record, MeasuredQuantity]  # a record, and one of its quantities


class Kind(enum.StrEnum):
    """The kinds of statements on stability, in the order of a report."""

    STEP = "step"
    MAP = "map"
    DRIFT = "drift"
    COUNT = "count"


@dataclass(frozen=True, slots=True)
class StabilityStatement:
    """A statement on the stability of a scheme on a variant.

    value: the largest step over theory, the lost fraction of a map, the largest change of a
    conserved quantity, or the count at the finest rung. due: the expected value. text: the
    statement as a sentence.
    """

    kind: Kind
    case: str
    variant: str
    label: str
    quantity: str
    value: float | None
    due: float | None
    text: str


def stability(manifest: Manifest) -> list[StabilityStatement]:
    """The statements on stability in a manifest, by kind, case, variant and scheme."""
    found = [*_maps(manifest), *_others(manifest)]
    return sorted(found, key=lambda one: list(Kind).index(one.kind))


def _others(manifest: Manifest) -> Iterator[StabilityStatement]:
    """The statements on largest steps, drift and counts, over the rungs of a scheme."""
    piles: dict[tuple[Kind, str, str, str, str], list[Rung]] = {}
    for record in manifest.records:
        for one in record.quantities:
            if kind := _kind(record, one):
                place = (record.case, record.variant, record.label, one.name)
                piles.setdefault((kind, *place), []).append((record, one))
    for (kind, case, variant, scheme, name), pile in piles.items():
        meaning = _meaning(manifest, case, variant, name)
        value, due, text = SAYS[kind](sorted(pile, key=lambda rung: by_fineness(rung[0])), meaning)
        yield StabilityStatement(kind, case, variant, scheme, name, value, due, text)


def _kind(record: Record, one: MeasuredQuantity) -> Kind | None:
    """The kind of statement on stability that a quantity makes; None if none."""
    if record.study is StudyKind.SEARCH:
        return None if one.verdict is Verdict.NO_REFERENCE else Kind.STEP
    if record.study is StudyKind.GRID:
        return None
    if one.judge is JudgeKind.INVARIANT:
        return Kind.DRIFT
    return Kind.COUNT if one.kind is QuantityKind.COUNT else None


def _meaning(manifest: Manifest, case: str, variant: str, name: str) -> str:
    quantities = manifest.cases[case].variants[variant].quantities
    return next((one.meaning for one in quantities if one.name == name), name)


Statement = tuple[float | None, float | None, str]  # value, due and text
DUE = {Verdict.PASS: "as due", Verdict.FAIL: "not as due"}


def _step(pile: Sequence[Rung], meaning: str) -> Statement:
    record, one = pile[-1]
    if one.value is None:
        return None, one.reference, "no step was stable"
    parts = [
        f"{meaning}: {one.value:.4g}, {DUE.get(one.verdict, 'known')}",
        one.note,
        record.reason,
    ]
    return one.value, one.reference, "; ".join(part for part in parts if part)


def _drift(pile: Sequence[Rung], meaning: str) -> Statement:
    worst = max((one.errors.get(Norm.MAX) or 0.0 for _, one in pile), default=0.0)
    bound = pile[-1][1].tolerance
    if bound is None or any(one.value is None and not one.figures for _, one in pile):
        return None, bound, f"{meaning}: not finite"
    kept = "kept to" if worst <= bound else "drifts by"
    return worst, bound, f"{meaning}: {kept} {worst:.2g} of its scale, {bound:.2g} allowed"


def _count(pile: Sequence[Rung], meaning: str) -> Statement:
    values = [None if one.value is None else round(one.value) for _, one in pile]
    due = pile[-1][1].reference
    steps = any(record.rung.dt for record, _ in pile)
    if len(set(values)) == 1:
        seen = f"{values[0]}{' at every step' if len(values) > 1 and steps else ''}"
    else:
        seen = f"{', '.join(map(str, values))} from the longest step to the shortest"
    exact = "" if due is None else f"; {due} in the exact motion"
    return values[-1], due, f"{meaning}: {seen}{exact}"


SAYS: Mapping[Kind, Callable[[Sequence[Rung], str], Statement]] = {
    Kind.STEP: _step,
    Kind.DRIFT: _drift,
    Kind.COUNT: _count,
}


def _maps(manifest: Manifest) -> Iterator[StabilityStatement]:
    """The statements on maps: the lost fraction in each scheme, where, and the least error."""
    piles: dict[tuple[str, str, str], list[Record]] = {}
    for record in manifest.records:
        if record.study is StudyKind.GRID:
            place = (record.case, record.variant, record.label)
            piles.setdefault(place, []).append(record)
    for (case, variant, scheme), pile in piles.items():
        taken = list(filter(tried, pile))
        if any(r.rung.dt for r in taken):
            critical = dict(manifest.cases[case].variants[variant].critical)
            lost = [r for r in taken if not _error(r) < WRONG]
            text = _in_words(pile, taken, lost, critical)
            share = len(lost) / len(taken)
            yield StabilityStatement(Kind.MAP, case, variant, scheme, "", share, None, text)


def _error(record: Record) -> float:
    """The largest error of a point of a map; inf where it has none."""
    errors = [one.errors.get(Norm.MAX) for one in record.quantities if one.errors]
    return max((math.inf if e is None else e for e in errors), default=math.inf)


def _in_words(
    pile: Sequence[Record],
    taken: Sequence[Record],
    lost: Sequence[Record],
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
    knobs = (("kn", best.rung.kn, "N/m"), ("dt", best.rung.dt, "s"))
    at = ", ".join(f"{name} {value:.3g} {unit}" for name, value, unit in knobs if value)
    parts.append(f"least error {_error(best):.2g}{f' at {at}' if at else ''}")
    return ", ".join(parts)


def _ratios(records: Iterable[Record], critical: Mapping[float | None, float]) -> Iterator[float]:
    for record in records:
        unit, dt = critical.get(record.rung.kn), record.rung.dt
        if unit and dt:
            yield dt / unit
