"""The page of a code: its schemes, its coverage, its rank among the others."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from reports import plain
from reports.book import Book
from reports.marks import Mark
from reports.outcomes import ShownOutcome, summed
from reports.pages.overview import Overview, Row
from reports.pages.troubles import Trouble, troubles
from reports.variant.inputs import heads
from reports.variant.ranking import Ranked
from vv.records.reading import tried


@dataclass(frozen=True)
class Line:
    """One scheme on one variant: its error, and its rank among the schemes that ran it.

    why: the reasons if it is not green; repeated ones refer to another line.
    """

    link: str
    case: str
    variant: str
    row: Ranked
    rank: int
    of: int
    why: str


@dataclass(frozen=True)
class Code:
    """A code. head: common beginning of its inputs. refusals: scheme, reason, variants by case."""

    name: str
    version: str
    in_house: bool
    marks: Sequence[Mark]
    rows: Sequence[Row]
    counts: Sequence[tuple[ShownOutcome, int]]
    troubles: Sequence[Trouble]
    lines: Sequence[Line]
    head: str
    refusals: Sequence[tuple[str, str, Sequence[tuple[str, Sequence[str]]]]]


def code(
    book: Book, name: str, seen: Overview, tables: Mapping[tuple[str, str], Sequence[Ranked]]
) -> Code:
    """The view of a code; tables: the ranked schemes of each variant."""
    own = [(record, came) for record, came in book.shown if record.code == name]
    rows = [row for row in seen.rows if row.mark.code == name]
    explained: dict[str, str] = {}
    return Code(
        name=name,
        version=next((r.code_version for r, _ in own if r.code_version), ""),
        in_house=name not in book.manifest.external(),
        marks=[row.mark for row in rows],
        rows=rows,
        counts=summed(came for _, came in own),
        troubles=troubles(book, [f for f in book.findings if f.label.partition("/")[0] == name]),
        lines=[
            line
            for place, ranks in tables.items()
            for line in _lines(book, name, place, ranks, explained)
        ],
        head=heads(book).get(name, ""),
        refusals=_refusals(book, name),
    )


def _lines(
    book: Book,
    name: str,
    place: tuple[str, str],
    ranks: Sequence[Ranked],
    explained: dict[str, str],
) -> list[Line]:
    of = sum(row.error is not None for row in ranks)
    return [
        Line(
            book.to_case(*place, row.mark.label), *place, row, number, of,
            plain.once(row.why, f"{': '.join(place)}, {row.mark.scheme}", explained),
        )
        for number, row in enumerate(ranks, 1)
        if row.mark.code == name
    ]  # fmt: skip


def _refusals(book: Book, name: str) -> list[tuple[str, str, list[tuple[str, list[str]]]]]:
    """(scheme, reason, [(case, variants)]), the most frequent first."""
    found: dict[tuple[str, str], dict[tuple[str, str], None]] = {}
    for record in book.manifest.records:
        if record.code == name and not tried(record):
            places = found.setdefault((record.scheme, record.reason), {})
            places[record.case, record.variant] = None
    ordered = sorted(found.items(), key=lambda item: (item[0][0], -len(item[1]), item[0][1]))
    return [
        (scheme, reason, [(c, [v for _, v in own]) for c, own in itertools.groupby(places, _case)])
        for (scheme, reason), places in ordered
    ]


def _case(place: tuple[str, str]) -> str:
    return place[0]
