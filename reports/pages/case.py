"""The page of a case: its description and its variants."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from reports.book import Book
from reports.text import slug
from reports.variant.variant import Above, Variant, variant
from vv.case import Norm
from vv.insight.history import Point
from vv.records.accepted import BaselineSummary
from vv.records.case_facts import CaseFacts, QuantityFacts
from vv.records.finding import Finding, worst_first
from vv.records.job_record import Record


@dataclass(frozen=True)
class Case:
    """A case and its variants.

    judged: quantities with their variants, grouped by the way in which they are judged. beside:
    errors at the step of the tolerances. baseline: the acceptances with reasons and machines; None
    if there are none. moved: changes since. past: the case over commits, oldest first.
    """

    name: str
    anchor: str
    facts: CaseFacts
    judged: Sequence[Sequence[tuple[QuantityFacts, Sequence[str]]]]
    variants: Sequence[Variant]
    beside: Mapping[str, Mapping[str, float | None]]
    beside_dt: float | None
    baseline: BaselineSummary | None
    moved: Sequence[Finding]
    past: Sequence[Point]
    csv: str


def case(book: Book, name: str) -> Case:
    """The view of a case."""
    facts = book.manifest.cases[name]
    above = Above()
    variants = [variant(book, (name, v), above) for v in facts.variants]
    dt = _stated_step(facts)
    every = [r for v in facts.variants for pile in book.records[name, v].values() for r in pile]
    beside = {v: _pointwise((r for r in every if r.variant == v), dt) for v in above.curves}
    return Case(
        name=name,
        anchor=slug(name),
        facts=facts,
        judged=_judged_alike(_quantities(facts)),
        variants=variants,
        beside=beside,
        beside_dt=dt,
        baseline=book.manifest.baselines.get(name),
        moved=worst_first(f for f in book.manifest.findings if f.case == name),
        past=book.past.get(name, ()),
        csv="" if book.whole else f"case-{slug(name)}.csv",
    )


def _quantities(facts: CaseFacts) -> list[tuple[QuantityFacts, Sequence[str]]]:
    """(quantity, variants it belongs to), each distinct quantity once."""
    found: list[tuple[QuantityFacts, list[str]]] = []
    for name, stated in facts.variants.items():
        for quantity in stated.quantities:
            variants = next((names for known, names in found if known == quantity), None)
            if variants is None:
                found.append((quantity, [name]))
            else:
                variants.append(name)
    return [*found]


def _judged_alike(
    quantities: Iterable[tuple[QuantityFacts, Sequence[str]]],
) -> list[list[tuple[QuantityFacts, Sequence[str]]]]:
    """The quantities grouped by equal tolerances, reasons and norms."""
    found: list[list[tuple[QuantityFacts, Sequence[str]]]] = []
    for quantity, variants in quantities:
        pile = next((pile for pile in found if _how(pile[0][0]) == _how(quantity)), None)
        if pile is None:
            found.append([(quantity, variants)])
        else:
            pile.append((quantity, variants))
    return found


def _how(quantity: QuantityFacts) -> tuple[object, ...]:
    """The key of how a quantity is judged."""
    of = quantity
    return of.tolerances, of.shown, of.norm, of.judge, of.reason


def _stated_step(facts: CaseFacts) -> float | None:
    """The step for which tolerances are stated, at which codes are compared with the source."""
    for quantity, _ in _quantities(facts):
        for tolerance in (quantity.tolerances or {}).values():
            if tolerance.dt is not None:
                return tolerance.dt
    return None


def _pointwise(records: Iterable[Record], dt: float | None) -> dict[str, float | None]:
    """Scheme -> largest pointwise relative error at that step, or at its only setting."""
    return {
        record.label: one.errors.get(Norm.POINTWISE)
        for record in records
        if record.rung.dt in (dt, None)
        for one in record.quantities[:1]
    }
