"""Finds the pattern of a failure from records alone, for the author of a code or a case."""

from __future__ import annotations

import enum
import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

from vv.ask import Method
from vv.base.metrics import order_before_floor
from vv.case import Norm
from vv.records.job_record import Record
from vv.records.manifest import Manifest
from vv.records.outcomes import StudyKind, Verdict
from vv.records.quantity import MeasuredQuantity
from vv.records.reading import by_fineness, ran

FLAT = 0.3  # with a smaller order, smaller steps do not help
LATE = 0.6  # how far an order may lie below that of its class
NEAR = 0.03  # relative deviation of an answer from a factor
FACTORS = (2.0, 0.5, -1.0, 0.0)
GROWS = 1.15  # times its mean square: 1 for a steady oscillation, 1.22 for one that grows with t
SUSPECTS = (
    "viscous drag -eta v",
    "shear spring capped by Coulomb friction",
    "free rotation",
    "walls that move as prescribed",
    "a body acceleration that varies in time",
    "gravity",
    "dead loads",
    "bonds between spheres",
    "bonds that break",
    "bonds that resist shear",
    "motion locked along directions oblique to the frame",
    "contact that is viscous along its normal",
    "contact with a plane wall",
    "contact between spheres",
)
PLAIN = {
    "viscous drag -eta v": "drag",
    "shear spring capped by Coulomb friction": "friction",
    "free rotation": "free rotation",
    "walls that move as prescribed": "moving walls",
    "a body acceleration that varies in time": "shaking",
    "motion locked along directions oblique to the frame": "oblique locks",
    "contact that is viscous along its normal": "viscous contact",
}
CLAIMED: Mapping[Method, float] = {Method.SECOND_ORDER: 2.0}


class Pattern(enum.Enum):
    """A pattern of failure; the value is the phrase for it."""

    STUCK = "does not converge"
    LOW_ORDER = "lower order than claimed"
    TERM = "one effect only"
    GROWTH = "grows in time"
    FACTOR = "off by a factor"


@dataclass(frozen=True, slots=True)
class Diagnosis:
    """A pattern in the errors of a scheme in a case. text: the pattern with its numbers."""

    case: str
    label: str
    pattern: Pattern
    text: str


def diagnoses(manifest: Manifest) -> list[Diagnosis]:
    """The patterns of all schemes and cases with a failure or a known disagreement."""
    return [*diagnose(manifest.records, _terms(manifest))]


def diagnose(
    records: Iterable[Record], terms: Mapping[tuple[str, str], frozenset[str]]
) -> Iterator[Diagnosis]:
    """The patterns in records, at most one for each scheme and case: the most specific.

    terms: (case, variant) -> the effects in its scene, as a case states them.
    """
    piles: dict[tuple[str, str], list[Record]] = {}
    for record in records:
        if ran(record) and record.quantities and record.study is StudyKind.LADDER:
            piles.setdefault((record.case, record.label), []).append(record)
    for (case, label), pile in piles.items():
        wrong = [r for r in pile if _is_wrong(r)]
        if wrong:
            found = _first_of(pile, wrong, terms)
            if found is not None:
                yield Diagnosis(case, label, *found)


Said = tuple[Pattern, str]


def _first_of(
    pile: Sequence[Record],
    wrong: Sequence[Record],
    terms: Mapping[tuple[str, str], frozenset[str]],
) -> Said | None:
    """The most specific pattern, with the effect that distinguishes all failures, if any."""
    ladders = [_ladder(pile, record.variant) for record in _of_each_variant(wrong)]
    looks: tuple[Callable[[Sequence[Record]], Said | None], ...] = (_factor, _order, _growth)
    found = next((pattern for look in looks for rungs in ladders if (pattern := look(rungs))), None)
    blamed = _effect(pile, wrong, terms)
    if found is None:
        return (Pattern.TERM, f"only variants with {blamed} fail") if blamed else None
    return found[0], f"{found[1]}; only variants with {blamed} fail" if blamed else found[1]


def _is_wrong(record: Record) -> bool:
    return any(one.verdict in (Verdict.FAIL, Verdict.XFAIL) for one in record.quantities)


def _of_each_variant(records: Iterable[Record]) -> list[Record]:
    return list({record.variant: record for record in records}.values())


def _ladder(pile: Iterable[Record], variant: str) -> list[Record]:
    """The records of a variant at its stiffest springs, coarsest step first."""
    own = sorted((r for r in pile if r.variant == variant), key=by_fineness)
    return [r for r in own if r.rung.kn == own[-1].rung.kn]


def _worst(record: Record) -> MeasuredQuantity | None:
    """The quantity that is farthest outside its tolerance."""
    judged = [one for one in record.quantities if one.error and one.tolerance]
    return max(judged, key=lambda one: (one.error or 0) / (one.tolerance or 1), default=None)


def _errors(rungs: Sequence[Record]) -> list[tuple[float, float]]:
    """The (dt, error) of the quantity that is worst at the finest step."""
    worst = _worst(rungs[-1]) or _worst(rungs[0])
    if worst is None:
        return []
    found = [(r.rung.dt, one.error) for r in rungs if (one := r.quantity(worst.name))]
    return [(dt, error) for dt, error in found if dt and error]


def _order(rungs: Sequence[Record]) -> Said | None:
    """The pattern of errors that do not fall, or fall more slowly than the class claims."""
    points = _errors(rungs)
    if len(points) < 2 or points[-1][1] <= 0:
        return None
    local = [
        math.log(e1 / e2) / math.log(h1 / h2) for (h1, e1), (h2, e2) in pairwise(points) if h1 > h2
    ]
    if not local:
        return None
    if max(local) < FLAT:
        first, last = points[0][1], points[-1][1]
        return Pattern.STUCK, f"it does not converge: error {first:.2g} to {last:.2g} as dt shrinks"
    claimed = CLAIMED.get(rungs[-1].method)
    fitted = order_before_floor([dt for dt, _ in points], [error for _, error in points])
    if claimed is None or fitted is None or fitted.order > claimed - LATE:
        return None
    return Pattern.LOW_ORDER, (
        f"it converges with order {fitted.order:.2f} where {claimed:g} is claimed: look for a term "
        "that is taken half a step late"
    )


def _factor(rungs: Sequence[Record]) -> Said | None:
    """The pattern of an answer that is off by a factor that a typical mistake causes."""
    for record in (rungs[-1], rungs[0]):
        for one in record.quantities:
            value, due = _final(one)
            if one.verdict not in (Verdict.FAIL, Verdict.XFAIL) or value is None or not due:
                continue
            for factor in FACTORS:
                if abs(value / due - factor) <= NEAR and _throughout(one, factor):
                    return Pattern.FACTOR, _slip(one.name, factor)
    return None


def _throughout(one: MeasuredQuantity, factor: float) -> bool:
    """Whether the factor at the end also explains the largest error; for a number it does."""
    largest = one.errors.get(Norm.MAX)
    return one.value is not None or (
        largest is not None and abs(largest - abs(factor - 1.0)) <= 2.0 * NEAR
    )


def _slip(name: str, factor: float) -> str:
    if factor == 0.0:
        return f"{name} is zero where the exact answer is not: an effect is lost"
    if factor < 0:
        return f"{name} is minus the exact answer: a sign is swapped"
    times = "twice" if factor > 1 else "half"
    return f"{name} is {times} the exact answer: a term counts {times}"


def _final(one: MeasuredQuantity) -> tuple[float | None, float | None]:
    """The answer and the exact answer, for a series at the last time."""
    if one.value is not None:
        return one.value, one.reference
    return one.figures.get("final"), one.end


def _growth(rungs: Sequence[Record]) -> Said | None:
    """The pattern of an error that is largest at the end, and far above its mean square."""
    one = _worst(rungs[-1])
    if one is None or one.scale is None:
        return None
    largest, mean = one.errors.get(Norm.MAX), one.errors.get(Norm.L2)
    value, due = _final(one)
    if not largest or not mean or value is None or due is None:
        return None
    last = abs(value - due) / one.scale
    if last >= 0.9 * largest and last >= GROWS * mean:
        return Pattern.GROWTH, f"the error grows in time, to {last:.2g} at the end"
    return None


def _effect(
    pile: Sequence[Record],
    wrong: Sequence[Record],
    terms: Mapping[tuple[str, str], frozenset[str]],
) -> str:
    """The effect that all failing variants have, and no passing one; empty if there is none."""
    case = pile[0].case
    failing = {record.variant for record in wrong}
    passing = {record.variant for record in pile} - failing
    if not passing:
        return ""
    shared = frozenset.intersection(*(terms.get((case, v), frozenset()) for v in failing))
    others: frozenset[str] = frozenset().union(*(terms.get((case, v), ()) for v in passing))
    blamed = [term for term in SUSPECTS if term in shared - others]
    return " and ".join(PLAIN.get(term, term) for term in blamed)


def _terms(manifest: Manifest) -> dict[tuple[str, str], frozenset[str]]:
    return {
        (case, variant): frozenset(facts.terms)
        for case, stated in manifest.cases.items()
        for variant, facts in stated.variants.items()
    }
