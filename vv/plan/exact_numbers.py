"""Stores the exact numbers shown beside published ones, since some take long to compute."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from pathlib import Path

from vv.base import closure
from vv.base.digest import digest
from vv.case.published import Paper, Statement
from vv.plan.project import Project
from vv.store.store import Store


def with_exact_numbers(
    papers: Sequence[Paper], project: Project, files: Sequence[Path]
) -> list[Paper]:
    """The papers with their exact numbers, which are computed anew if sources or libraries changed.

    files: those that the papers are listed in.
    """
    store, sources = Store(project.data()), closure.import_closure(files, project.roots)
    of = closure.source_digest(sources), closure.library_versions(sources)
    key = digest("exact numbers of papers", *of, [paper.name for paper in papers])
    numbers = store.facts(tuple[float, ...], key)
    asked = [s.exact for p in papers for s in p.statements if callable(s.exact)]
    if numbers is None or len(numbers) != len(asked):
        numbers = tuple(exact() for exact in asked)
        store.keep_facts(key, numbers)
    known = iter(numbers)
    return [
        dataclasses.replace(
            paper,
            statements=tuple(
                _with(one, next(known)) if callable(one.exact) else one for one in paper.statements
            ),
        )
        for paper in papers
    ]


def _with(one: Statement, number: float) -> Statement:
    return dataclasses.replace(one, exact=lambda: number)
