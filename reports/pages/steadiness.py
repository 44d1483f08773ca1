"""Arranges statements on stability: one table for each kind, equal ones on one line."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from reports.book import Book
from reports.marks import Mark
from vv.insight.stability_summary import Kind, StabilityStatement

KINDS = {
    Kind.STEP: (
        "Largest stable step",
        "Sought in each code, over what theory gives. A step is stable if the run comes to its "
        "end within the bound that the case states; one that a code refuses is run all the same.",
    ),
    Kind.MAP: (
        "Maps over stiffness and step",
        "Lost: diverged, or off by as much as the answer. Steps are multiples of the critical one "
        "that the case states. The figures stand with the variants.",
    ),
    Kind.DRIFT: (
        "Drift",
        "The largest breach, at any setting, of what the motion conserves.",
    ),
    Kind.COUNT: (
        "Counts",
        "Events seen in the output. Where an event hangs on the last digit no order is due.",
    ),
}


@dataclass(frozen=True)
class Stable:
    """One kind of finding on stability, and its lines: schemes that say the same share one.

    lines: (link, case: variant, what is said and by which schemes).
    """

    title: str
    caption: str
    lines: Sequence[tuple[str, str, Sequence[tuple[Sequence[Mark], str]]]]


def sections(book: Book) -> list[Stable]:
    """A section for each kind there is anything of."""
    statements = book.stability
    return [
        Stable(title, caption, _lines(book, [one for one in statements if one.kind is kind]))
        for kind, (title, caption) in KINDS.items()
        if any(one.kind is kind for one in statements)
    ]


def _lines(
    book: Book, statements: Sequence[StabilityStatement]
) -> list[tuple[str, str, list[tuple[list[Mark], str]]]]:
    """The lines, in the order found."""
    places: dict[tuple[str, str], dict[str, list[Mark]]] = {}
    for one in statements:
        texts = places.setdefault((one.case, one.variant), {})
        texts.setdefault(one.text, []).append(book.marks[one.label])
    return [
        (
            book.to_case(case, variant),
            f"{case}: {variant}",
            [(who, text) for text, who in texts.items()],
        )
        for (case, variant), texts in places.items()
    ]
