"""The page of the papers: published numbers compared with exact ones and with codes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from reports.book import Book
from reports.marks import Mark
from reports.text import slug
from vv.case.published import Assessment, Paper
from vv.insight.papers import Row, counted

LOOKS: Mapping[Assessment, str] = {
    Assessment.REPRODUCED: "good",
    Assessment.DIFFERS: "bad",
    Assessment.MISPRINT: "known",
    Assessment.WRONG: "odd",
    Assessment.OPEN: "idle",
}


@dataclass(frozen=True)
class Given:
    """An answer of codes on a variant, which may belong to a case outside this report."""

    link: str
    where: str
    text: str
    marks: Sequence[Mark]
    others: Sequence[str]


@dataclass(frozen=True)
class Shown:
    """A statement of a paper, and how it compares."""

    row: Row
    look: str
    given: Sequence[Given]


@dataclass(frozen=True)
class PaperPart:
    """A paper. counts: the number of its statements by assessment."""

    paper: Paper
    anchor: str
    counts: Mapping[Assessment, int]
    rows: Sequence[Shown]


def papers(book: Book) -> list[PaperPart]:
    """The view of all papers."""
    return [
        PaperPart(
            paper,
            f"paper-{slug(paper.name)}",
            counted(rows),
            [Shown(row, LOOKS[row.assessment], _given(book, row)) for row in rows],
        )
        for paper, rows in book.beside.papers
    ]


def _given(book: Book, row: Row) -> list[Given]:
    found = []
    for answer in row.answers:
        case, _, variant = answer.where.partition(":")
        here = (case, variant) in book.records
        found.append(
            Given(
                book.to_case(case, variant) if here else "",
                answer.where,
                answer.text,
                [book.marks[label] for label in answer.codes if label in book.marks],
                [label for label in answer.codes if label not in book.marks],
            )
        )
    return found
