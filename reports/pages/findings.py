"""Collects failures, known disagreements and refusals, one row for each reason."""

from __future__ import annotations

import re
from collections.abc import Container, Iterable, Mapping, Sequence
from dataclasses import dataclass

from reports import plain
from reports.book import Book
from reports.marks import Mark
from reports.outcomes import RANKS, WORST_FIRST, ShownOutcome
from reports.text import brief, short
from vv.records.job_record import Record
from vv.records.outcomes import Outcome

FEW = 3  # the most variants that are named even if they are all of a case
DECIMAL = re.compile(r"(?<![\w.])-?\d+(?:\.\d+(?:e[+-]?\d+)?|e[+-]?\d+)\b")


@dataclass(frozen=True)
class Finding:
    """Records of one scheme with the same outcome for the same reason. where: links to them."""

    outcome: ShownOutcome
    mark: Mark
    text: str
    where: Mapping[str, Sequence[tuple[str, str]]]


def findings(book: Book, looks: Iterable[str], without: Container[Outcome] = ()) -> list[Finding]:
    """The findings on records whose outcome has one of these styles, worst first.

    without: outcomes that are shown elsewhere. where: case -> (link, variant with its steps).
    """
    wanted = frozenset(looks)
    piles: dict[tuple[int, str, str], dict[int, str]] = {}  # index -> reason
    for place, (record, found) in enumerate(book.shown):
        if found.look in wanted and found.key not in without:
            why = _reason(record, found)
            key = (RANKS[found.key], record.label, DECIMAL.sub("#", why))
            piles.setdefault(key, {})[place] = why
    return [
        Finding(
            WORST_FIRST[rank],
            book.marks[name],
            _merged([*pile.values()]),
            _where(book, [book.shown[place][0] for place in pile]),
        )
        for (rank, name, _), pile in sorted(piles.items(), key=lambda item: item[0])
    ]


def refused(book: Book) -> list[tuple[str, int, int]]:
    """(code, variants, reasons) of the unsupported variants of each code."""
    found: dict[str, tuple[set[tuple[str, str]], set[str]]] = {}
    for record, shown in book.shown:
        if shown.key is Outcome.REFUSED:
            places, reasons = found.setdefault(record.code, (set(), set()))
            places.add((record.case, record.variant))
            reasons.add(record.reason)
    return [(code, len(found[code][0]), len(found[code][1])) for code in sorted(found)]


def _merged(texts: Sequence[str]) -> str:
    """The texts, merged if they differ in decimals only, with the range of each decimal."""
    columns = list(zip(*(map(float, DECIMAL.findall(text)) for text in texts), strict=True))
    ranges = iter([dict.fromkeys((short(min(c)), short(max(c)))) for c in columns])
    return DECIMAL.sub(lambda _: " to ".join(next(ranges)), texts[0])


def _reason(record: Record, shown: ShownOutcome) -> str:
    """The reason of a record's outcome: its own, or notes on its quantities or its energy."""
    return plain.reason(record, shown.key) or shown.meaning


def _where(book: Book, pile: Sequence[Record]) -> dict[str, Sequence[tuple[str, str]]]:
    by_variant: dict[tuple[str, str], list[Record]] = {}
    for record in pile:
        by_variant.setdefault((record.case, record.variant), []).append(record)
    found: dict[str, list[tuple[str, str]]] = {}
    for (case, variant), members in by_variant.items():
        steps = [brief(r.rung.dt) for r in members if r.rung.dt]
        some = f" at dt = {', '.join(steps)} s" if 0 < len(steps) < 3 else ""
        many = f" ({len(steps)} steps)" if len(steps) >= 3 else ""
        found.setdefault(case, []).append(
            (book.to_case(case, variant, members[0].label), f"{variant}{some or many}")
        )
    return {case: _all_of_it(book, case, places) for case, places in found.items()}


def _all_of_it(
    book: Book, case: str, places: Sequence[tuple[str, str]]
) -> Sequence[tuple[str, str]]:
    """The places; if they are all variants of a case, the case instead."""
    variants = [*book.manifest.cases[case].variants]
    if len(variants) < FEW or [name for _, name in places] != variants:
        return places
    return [(book.to_case(case), f"all {len(variants)} variants")]
