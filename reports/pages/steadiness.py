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
        "As found in each code, over the theoretical one. A step is stable if the run reaches its "
        "end within the bound that the case states; steps that a code refuses are run too.",
    ),
    Kind.MAP: (
        "Maps over stiffness and step",
        "Lost: diverged, or with an error of 100 %. Steps are multiples of the critical step "
        "that the case states. The maps are shown with the variants.",
    ),
    Kind.DRIFT: (
        "Drift",
        "The largest change, at any setting, of a quantity that the motion conserves.",
    ),
    Kind.COUNT: (
        "Counts",
        "Events in the output. No order in dt is expected if an event depends on rounding.",
    ),
}


@dataclass(frozen=True)
class Stable:
    """One kind of statement on stability, with its lines; schemes with equal statements share one.

    lines: (link, case: variant, statements with their schemes).
    """

    title: str
    caption: str
    lines: Sequence[tuple[str, str, Sequence[tuple[Sequence[Mark], str]]]]


def sections(book: Book) -> list[Stable]:
    """A section for each kind that has statements."""
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
