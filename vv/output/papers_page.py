"""Writes the Markdown page that compares published statements with exact answers and codes."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from vv.case.published import Paper
from vv.insight.papers import Row, counted

INTRODUCTION = (
    "Every number and claim of the papers that the cases come from: where it stands, what the "
    "paper says, the exact answer, what each code gives at its finest accepted setting or at the "
    "paper's own, and what became of it. `vv papers` writes this page."
)
HEAD = "| Where | What | The paper | Exact | Codes | Verdict |\n|---|---|---|---|---|---|"


def page(found: Sequence[tuple[Paper, Sequence[Row]]]) -> str:
    """The page: a section with a table for each paper."""
    parts = ["# What the papers publish", "", INTRODUCTION]
    for paper, rows in found:
        counts = ", ".join(assessment.counted(n) for assessment, n in counted(rows).items())
        doi = f", doi:{paper.doi}" if paper.doi else ""
        parts += ["", f"## {paper.name}", "", f"{paper.citation}{doi}.", ""]
        parts += [f"{len(rows)} statements: {counts}.", "", HEAD, *map(_line, rows)]
    return "\n".join(parts) + "\n"


def _line(row: Row) -> str:
    verdict = f"**{row.assessment.value}**{': ' if row.why else ''}{row.why}"
    cells = (
        row.place,
        row.what,
        _with_unit(row.printed, row.unit),
        _with_unit(row.exact, row.unit),
    )
    return f"| {' | '.join(map(_cell, (*cells, _codes(row), verdict)))} |"


def _with_unit(text: str, unit: str) -> str:
    return f"{text} {unit}" if text and unit and text[-1].isdigit() else text


def _codes(row: Row) -> str:
    """The answers of codes; those on one variant together."""
    places = dict.fromkeys(answer.where for answer in row.answers)
    return "; ".join(f"`{place}` {_at(place, row)}" for place in places)


def _at(place: str, row: Row) -> str:
    here = (answer for answer in row.answers if answer.where == place)
    return ", ".join(f"{answer.text} ({_named(answer.codes)})" for answer in here)


def _named(labels: Iterable[str]) -> str:
    """Codes, with the schemes of each that are not its default."""
    return ", ".join(label.removesuffix("/default") for label in labels)


def _cell(text: str) -> str:
    return " ".join(text.split()).replace("|", "\\|")
