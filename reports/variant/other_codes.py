"""Published answers of other codes for a variant, beside the result of each scheme."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from vv.records.case_facts import QuantityFacts
from vv.records.job_record import Record
from vv.records.outcomes import Verdict
from vv.records.quantity import PrintedFacts
from vv.records.reading import by_fineness, ran


@dataclass(frozen=True)
class PrintedRow:
    """A printed answer: its quantity, the results of schemes, and those outside the band."""

    quantity: str
    unit: str
    printed: PrintedFacts
    computed: Mapping[str, float]
    outside: frozenset[str]


def printed_rows(
    piles: Mapping[str, Sequence[Record]], quantities: Sequence[QuantityFacts]
) -> list[PrintedRow]:
    """A row for each answer of another code, in the order of the quantities of a variant.

    piles: label of a scheme -> its records, of which the one at the finest setting speaks.
    """
    finest = {
        label: max(done, key=by_fineness)
        for label, pile in piles.items()
        if (done := [record for record in pile if ran(record)])
    }
    return [row for facts in quantities if (row := _row(finest, facts))]


def _row(finest: Mapping[str, Record], facts: QuantityFacts) -> PrintedRow | None:
    found = {label: one for label, record in finest.items() if (one := record.quantity(facts.name))}
    printed = next((one.printed for one in found.values()), None)
    if printed is None:
        return None
    return PrintedRow(
        facts.meaning,
        facts.unit,
        printed,
        {label: one.value for label, one in found.items() if one.value is not None},
        frozenset(label for label, one in found.items() if one.verdict is Verdict.FAIL),
    )
