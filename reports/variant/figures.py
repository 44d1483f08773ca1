"""The figures of a variant: measurements, regions, phases, quantities and cost of errors."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from reports.book import Book, Place
from reports.drawing import collect
from reports.drawing.collect import History
from reports.drawing.energies import JOULE, energy_figures
from reports.drawing.gallery import Figure, cost_figures, figures
from reports.drawing.phases import phase_figures
from reports.outcomes import shown_by
from reports.variant.measurements import measured_figures
from reports.variant.region_figures import region_figures
from vv.case import Norm
from vv.records.case_facts import QuantityFacts, VariantFacts
from vv.records.job_record import Record

Over = Callable[[str], list[History]]  # the histories of a quantity, one for each scheme
SEVERAL = 2  # the most quantities with figures, beyond those that are out of bounds


def all_figures(
    book: Book, place: Place, own: Sequence[Record], over: Over, like: bool
) -> list[Figure]:
    """All figures of a variant; like: whether another variant has the same ones over time."""
    facts = book.manifest.cases[place[0]].variants[place[1]]
    return [
        *measured_figures(book, place),
        *region_figures(facts, book.ran.get(place, {}), book.marks),
        *([] if like else _phase(facts, over)),
        *([] if like else _figures(book, facts, own, over)),
    ]


def is_drawn(quantity: QuantityFacts, facts: VariantFacts, own: Sequence[Record]) -> bool:
    """Whether a quantity has figures: one of the first, or some scheme is out of bounds in it."""
    seen = ((r, one) for r in own if (one := r.quantity(quantity.name)))
    return quantity in facts.quantities[:SEVERAL] or any(
        shown_by(record, one).troubling for record, one in seen
    )


def _figures(book: Book, facts: VariantFacts, own: Sequence[Record], over: Over) -> list[Figure]:
    """The figures of all quantities; cost is drawn once, since a run has all quantities."""
    energies = {q.name: over(q.name) for q in facts.quantities if q.unit == JOULE}
    made = energy_figures(energies, facts.quantities)
    drawn, costs = bool(made), list[Figure]()
    for quantity in facts.quantities:
        measured = [one for r in own if (one := r.quantity(quantity.name))]
        if not measured or not is_drawn(quantity, facts, own):
            continue
        norm = next((one.norm for one in measured if one.norm), Norm.MAX)
        curves = [] if drawn and quantity.name in energies else over(quantity.name)
        steps = collect.ladders(own, quantity.name, book.marks)
        made += figures(curves, steps, quantity, norm, dict(facts.critical))
        if not costs:
            costs = cost_figures(steps, quantity, norm, dict(facts.critical))
            made += costs
    return made


def _phase(facts: VariantFacts, over: Over) -> list[Figure]:
    """The phase picture, where a case asks for one."""
    by_name = {quantity.name: quantity for quantity in facts.quantities}
    if facts.phase is None:
        return []
    along, up = (by_name[name] for name in facts.phase)
    return phase_figures(over(along.name), over(up.name), (along, up))
