"""The input of each external code on a variant, at the setting that one would take."""

from __future__ import annotations

import dataclasses
import functools
import itertools
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from reports import plain
from reports.book import Book, Place
from reports.marks import Mark
from reports.text import slug
from reports.variant.likeness import difference
from reports.variant.likeness import nearest as nearest_text
from reports.variant.reading import TARGET, judged_error, nearest
from vv.records.job_record import Record
from vv.records.reading import rung

LONGEST = 8_000  # characters beyond the common beginning; longer inputs are left to `vv export`
MANY = 60  # bodies; inputs of larger scenes are left to `vv export`
SHORTEST = 1_000  # the fewest lines worth sharing


@dataclass(frozen=True)
class Input:
    """A code's own input for a variant. text: after the common beginning.

    base: the earlier input from which `text` is a difference; None if it is complete.
    """

    anchor: str
    variant: str
    mark: Mark
    setting: str
    shared: bool
    text: str
    file: str
    command: str
    base: Input | None = None


def inputs(book: Book, place: Place, before: dict[str, list[Input]]) -> list[Input]:
    """The input of each external code that ran a variant, and is short enough to be shown.

    before: code -> the complete inputs above on the page; a new complete one is added.
    """
    found = []
    for record in chosen(book, place):
        one = _input(book, record)
        if one is not None:
            wholes = before.setdefault(record.code, [])
            one = _beside(one, wholes)
            wholes += [one] if one.base is None else []
            found.append(one)
    return found


def _beside(one: Input, wholes: Sequence[Input]) -> Input:
    """An input as the difference from the most similar one, or complete if that is not shorter."""
    if not wholes:
        return one
    base = wholes[nearest_text([whole.text for whole in wholes], one.text)]
    changes = difference(base.text, one.text) if base.shared == one.shared else ""
    return dataclasses.replace(one, text=changes, base=base) if changes else one


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
    file, setting = f"{name}.{_ending(whole)}", plain.setting(record)
    return Input(
        f"input--{name}", record.variant, mark, setting, shared, text, file, f"{export}{at}"
    )


@functools.lru_cache(maxsize=1)
def heads(book: Book) -> dict[str, str]:
    """External code -> the common beginning of its inputs, if sharing it saves space.

    It is that of the first and the last input.
    """
    ends = [_first_inputs(book, places) for places in (book.places, book.places[::-1])]
    found = {code: _shared(book.beside.native(end[code]) for end in ends) for code in ends[0]}
    return {code: head for code, head in found.items() if head}


def _first_inputs(book: Book, places: Iterable[Place]) -> dict[str, Record]:
    """External code -> the record of its input on the first of these variants where it has one."""
    found: dict[str, Record] = {}
    wanted = book.manifest.external()
    for place in places:
        for record in chosen(book, place):
            found.setdefault(record.code, record)
        if found.keys() == wanted:
            break
    return found


def _shared(texts: Iterable[str]) -> str:
    """The common first lines of texts."""
    lines = zip(*(text.splitlines(keepends=True) for text in texts), strict=False)
    same = itertools.takewhile(lambda row: len(set(row)) == 1, lines)
    head = "".join(row[0] for row in same)
    return head if len(head) >= SHORTEST else ""


def _ending(text: str) -> str:
    """The ending of a file with such a text."""
    words: Sequence[tuple[str, str]] = (('"""', "py"), ("import ", "py"), ("{", "json"))
    return next((ending for start, ending in words if text.startswith(start)), "in")
