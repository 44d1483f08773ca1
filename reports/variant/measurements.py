"""What was measured of a variant, beside what each scheme computes: figures and a table."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from reports.book import Book, Place
from reports.drawing.gallery import Figure
from reports.drawing.scatter import draw_scatter
from reports.marks import Mark
from reports.text import listed
from vv.insight.against_measurements import Agreement, Compared
from vv.records.case_facts import QuantityFacts

LINKS = ("at", "of", "in", "for", "with", "after")  # no last words of what is common to meanings


@dataclass(frozen=True)
class MeasuredRow:
    """A measured value: what it is of, its two standard uncertainties, and what schemes give."""

    quantity: str
    unit: str
    seen: Compared
    computed: Mapping[str, Compared]


def measured_rows(book: Book, place: Place) -> list[MeasuredRow]:
    """A row for each measured value of a variant, in the order of its quantities."""
    found: dict[str, dict[str, Compared]] = {}
    for one in book.agreements.get(place, ()):
        for point in one.points:
            found.setdefault(point.quantity, {})[one.label] = point
    facts = {q.name: q for q in book.manifest.cases[place[0]].variants[place[1]].quantities}
    return [
        MeasuredRow(facts[name].meaning, facts[name].unit, next(iter(own.values())), own)
        for name, own in found.items()
    ]


def measured_figures(book: Book, place: Place) -> list[Figure]:
    """A figure for each kind of measured value: those with one symbol and unit."""
    group = book.agreements.get(place, ())
    facts = book.manifest.cases[place[0]].variants[place[1]].quantities
    kinds: dict[tuple[str, str], list[QuantityFacts]] = {}
    for one in facts:
        kinds.setdefault((one.symbol, one.unit), []).append(one)
    made = (_figure(book, group, symbol, unit, own) for (symbol, unit), own in kinds.items())
    return [figure for figure in made if figure]


def _figure(
    book: Book, group: Sequence[Agreement], symbol: str, unit: str, own: Sequence[QuantityFacts]
) -> Figure | None:
    names = {one.name for one in own}
    points: dict[Mark, list[Compared]] = {}
    for one in group:
        if kept := [point for point in one.points if point.quantity in names]:
            points[book.marks[one.label]] = kept
    if not points:
        return None
    title = f"{_common([one.meaning for one in own])} {symbol}"
    shown = f"{symbol} [{unit}]" if unit else symbol
    near = [
        f"{mark.label} {sum(_within(p) for p in kept)} of {len(kept)}"
        for mark, kept in points.items()
    ]
    caption = "On the line both are equal; bars: 2 standard uncertainties; hollow: shown only."
    alt = f"{title}, computed over measured; within 2 standard uncertainties: {listed(near)}"
    return Figure(draw_scatter(points, shown), f"{title}: computed over measured", caption, alt)


def _within(point: Compared) -> bool:
    return abs(point.computed - point.measured) <= 2 * point.uncertainty


def _common(meanings: Sequence[str]) -> str:
    """The words with which all meanings begin, as a title."""
    words = [text.split() for text in meanings]
    same = [
        row[0] for row in itertools.takewhile(lambda r: len(set(r)) == 1, zip(*words, strict=False))
    ]
    while same and same[-1] in LINKS:
        same.pop()
    title = " ".join(same) or meanings[0]
    return title[:1].upper() + title[1:]
