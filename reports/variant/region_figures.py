"""The figure of a map of regions: in which region each scheme finds each point."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from markupsafe import Markup

from reports.drawing.gallery import Figure
from reports.drawing.regions import Found, draw_regions, key, modes_found
from reports.marks import Mark
from reports.text import listed
from vv.records.case_facts import VariantFacts
from vv.records.job_record import Record


def region_figures(
    facts: VariantFacts, ran: Mapping[str, Sequence[Record]], marks: Mapping[str, Mark]
) -> list[Figure]:
    """One figure where a variant has such a map, at each scheme's finest setting; else none."""
    chart = facts.regions
    found = [
        one for label, pile in ran.items() if (one := _found(facts, marks[label], pile)).points
    ]
    if chart is None or not found:
        return []
    shares = [f"{one.mark.label} {one.right} of {len(one.points)}" for one in found]
    caption = (
        "Lines: the exact borders. Signs: what each scheme finds at its finest setting; "
        "red where it is not what the exact chart has there."
    )
    alt = f"{chart.y} over {chart.x}, points found as the exact chart has them: {listed(shares)}"
    svg = Markup("").join((key(chart), draw_regions(chart, found)))
    return [Figure(svg, "What each scheme finds, and the exact borders", caption, alt)]


def _found(facts: VariantFacts, mark: Mark, pile: Sequence[Record]) -> Found:
    measured = [record for record in pile if record.quantities]
    if facts.regions is None or not measured:
        return Found(mark, [])
    values = {one.name: (one.value, one.reference) for one in measured[-1].quantities}
    return Found(mark, modes_found(facts.regions.points, values))
