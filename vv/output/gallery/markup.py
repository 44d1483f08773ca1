"""Writes pieces of Markdown: tables, code, and text with special characters escaped."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from vv.base.printable import one_line


def cell(text: str) -> str:
    """A text with markup escaped, fit for a table."""
    whole = " ".join(one_line(text).split()).replace("&", "&amp;").replace("<", "&lt;")
    for mark in ("|", "*", "[", "_"):
        whole = whole.replace(mark, f"\\{mark}")
    return whole


def code(text: str) -> str:
    """A name set as code."""
    return f"`{one_line(text)}`"


def table(heads: Sequence[str], rows: Iterable[Sequence[str]]) -> Iterator[str]:
    """The lines of a table."""
    yield f"| {' | '.join(heads)} |"
    yield f"|{'---|' * len(heads)}"
    for row in rows:
        yield f"| {' | '.join(row)} |"


def listed_codes(schemes: Iterable[str]) -> str:
    """Schemes CODE/SCHEME, each code with a link to its page and its schemes."""
    codes: dict[str, list[str]] = {}
    for scheme in schemes:
        name, _, own = scheme.partition("/")
        codes.setdefault(name, []).append(own)
    return "; ".join(
        f"[{name}](../codes/{name}.md) ({', '.join(own)})" for name, own in codes.items()
    )
