"""The page of all numbers that the variants of a case declare, on which any change is seen."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from vv.case import Case
from vv.output.gallery.declared_numbers import Lines, differing
from vv.output.gallery.markup import code

WHAT = (
    "What the first variant declares, and what differs from it in the others: settings at each "
    "level, bounds, exact answers (of a history at the start, half-way and at the end) and the "
    "scene, in SI units. Of more than six numbers the range and the means are given. What is zero, "
    "or has its usual value, is left out. A test compares this page with the declarations."
)


def numbers_page(case: Case, numbers: Mapping[str, Lines]) -> str:
    """The page, as Markdown; numbers: variant -> all numbers that it declares."""
    head = (f"# Numbers of {case.name}", "", WHAT)
    return "\n".join([*head, *_of_variants(numbers), ""])


def _of_variants(numbers: Mapping[str, Lines]) -> Iterator[str]:
    first: Lines = {}
    for name, lines in numbers.items():
        shown = differing(lines, first) if first else lines
        first = first or lines
        yield from ("", f"{code(name)}:", "", "```")
        yield from (f"{what}: {text}" for what, text in shown.items())
        yield "```"
