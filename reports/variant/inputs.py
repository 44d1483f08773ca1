"""The input of each external code on a variant, at the setting that one would take."""

from __future__ import annotations

import functools
import itertools
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from reports import plain
from reports.book import Book, Place
from reports.marks import Mark
from reports.text import slug
from reports.variant.reading import TARGET, judged_error, nearest
from vv.records.job_record import Record
from vv.records.reading import rung

LONGEST = 12_000  # characters beyond what all inputs of a code share: longer ones are exported
MANY = 60  # bodies, whose input nobody reads: it is exported
SHORTEST = 1_000  # that is worth being told once


@dataclass(frozen=True)
class Input:
    """A code's own input for a variant. text: what follows upon what all inputs of it share."""

    mark: Mark
    setting: str
    shared: bool
    text: str
    file: str
    command: str


def inputs(book: Book, place: Place) -> list[Input]:
    """The input of each external code that ran a variant, and is short enough to be shown."""
    return [one for record in chosen(book, place) if (one := _input(book, record))]


def chosen(book: Book, place: Place) -> list[Record]:
    """For each external code its cheapest record within TARGET, else its most accurate."""
    case, variant = place
    sketch = book.manifest.cases[case].variants[variant].sketch
    if sketch and sketch.bodies > MANY:
        return []
    external = book.manifest.external()
    piles: dict[str, list[Record]] = {}
    for label, pile in book.ran.get(place, {}).items():
        code = label.partition("/")[0]
        if code in external:
            piles.setdefault(code, []).extend(r for r in pile if r.quantities)
    return [min(pile, key=_order) for pile in piles.values() if pile]


def _order(record: Record) -> tuple[bool, float, str, str]:
    error = judged_error(nearest(record))
    within = error is not None and error <= TARGET
    least = record.cost.solve_cpu if within else float("inf") if error is None else error
    return not within, least, record.label, rung(record)


def _input(book: Book, record: Record) -> Input | None:
    whole, mark = book.beside.native(record), book.marks[record.label]
    head = heads(book).get(record.code, "")
    shared = bool(head) and whole.startswith(head)
    text = whole.removeprefix(head) if shared else whole
    if not text or len(text) > LONGEST:
        return None
    name = "-".join((slug(record.case), slug(record.variant), slug(record.code)))
    export = f"vv export {record.case}:{record.variant} --code {record.label}"
    at = f" --rung {rung(record)}" if rung(record) else ""
    return Input(
        mark, plain.setting(record), shared, text, f"{name}.{_ending(whole)}", f"{export}{at}"
    )


@functools.lru_cache(maxsize=1)
def heads(book: Book) -> dict[str, str]:
    """External code -> the lines with which all its inputs begin, where that saves anything.

    They are those that its first and its last input share.
    """
    ends: dict[str, list[Record]] = {}
    for record in (r for place in book.places for r in chosen(book, place)):
        ends[record.code] = [*ends.get(record.code, [record])[:1], record]
    found = {code: _shared(map(book.beside.native, pair)) for code, pair in ends.items()}
    return {code: head for code, head in found.items() if head}


def _shared(texts: Iterable[str]) -> str:
    """The lines with which texts begin."""
    lines = zip(*(text.splitlines(keepends=True) for text in texts), strict=False)
    same = itertools.takewhile(lambda row: len(set(row)) == 1, lines)
    head = "".join(row[0] for row in same)
    return head if len(head) >= SHORTEST else ""


def _ending(text: str) -> str:
    """The ending of a file with such a text."""
    words: Sequence[tuple[str, str]] = (('"""', "py"), ("import ", "py"), ("{", "json"))
    return next((ending for start, ending in words if text.startswith(start)), "in")
