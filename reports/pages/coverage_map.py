"""The map of the front page: cases by schemes, each case unfolding to its variants."""

from __future__ import annotations

import math
import statistics
from collections.abc import Iterator, Mapping, Sequence

from markupsafe import Markup, escape

from reports.book import Book
from reports.outcomes import RANKS
from reports.pages.overview import Cell, Overview
from reports.text import NONE, sci, seconds

BANDS = 8  # of colour, from exact to useless


def band(error: float | None) -> str:
    """The class of colour of an error: two decades each, e0 below 1e-14, e7 from 1e-2 on."""
    if error is None:
        return ""
    if error <= 0:
        return "e0"
    return f"e{min(BANDS - 1, max(0, math.floor((math.log10(error) + 16) / 2)))}"


def rows(book: Book, seen: Overview) -> Markup:
    """The body of the table: a row for each case, and below it one for each of its variants."""
    return Markup("".join(_case_rows(book, seen)))


def _case_rows(book: Book, seen: Overview) -> Iterator[str]:
    for case, facts in book.manifest.cases.items():
        piles = {v: seen.cells.get((case, v), {}) for v in facts.variants}
        cells = "".join(
            _cell(book, [own[label] for own in piles.values() if label in own], (case,), label)
            for label in book.marks
        )
        link = escape(book.to_case(case))
        count = len(facts.variants)
        fold = (
            f'<button type="button" class="fold" aria-expanded="false" '
            f'aria-label="variants of {escape(case)}">{count}</button>'
            if count > 1
            else ""
        )
        head = f'<th scope="row"><a href="{link}">{escape(case)}</a> {fold}</th>'
        yield f'<tbody data-q="{escape(f"{case} {facts.title}".lower())}"><tr>{head}{cells}</tr>'
        if count > 1:
            for variant, own in piles.items():
                yield _variant_row(book, case, variant, own)
        yield "</tbody>"


def _variant_row(book: Book, case: str, variant: str, own: Mapping[str, Cell]) -> str:
    cells = "".join(
        _cell(book, [own[label]] if label in own else [], (case, variant, label), label)
        for label in book.marks
    )
    link = escape(book.to_case(case, variant))
    return f'<tr class="v"><th scope="row"><a href="{link}">{escape(variant)}</a></th>{cells}</tr>'


def _cell(book: Book, cells: Sequence[Cell], names: tuple[str, ...], label: str) -> str:
    """One cell: the median error of what it stands for, and the worst verdict as a mark."""
    if not cells:
        return "<td></td>"
    errors = [cell.error for cell in cells if cell.error is not None]
    costs = [cell.cpu for cell in cells if cell.cpu is not None]
    error = statistics.median(errors) if errors else None
    cost = seconds(statistics.median(costs)) if costs else NONE
    worst = min((cell.worst for cell in cells), key=lambda outcome: RANKS[outcome.key])
    shown = worst.symbol if error is None else sci(error, 0)
    link = escape(book.to_case(*names))
    variant = names[1] if len(names) > 1 else ""
    quiet = worst.troubling and book.quiet(names[0], variant, label)
    look = "known" if quiet else worst.look
    mark = f'<i class="{look}">{escape(worst.symbol)}</i>' if look != "good" else ""
    return (
        f'<td class="{band(error)}" data-c="{escape(cost)}" data-v="{escape(worst.word)}">'
        f'<a href="{link}">{escape(shown)}</a>{mark}</td>'
    )
