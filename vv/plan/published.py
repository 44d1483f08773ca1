"""Finds the papers whose statements a project lists: a file of cases/papers/ for each."""

from __future__ import annotations

from vv.case.published import Paper
from vv.plan import imports
from vv.plan.content import ProjectError
from vv.plan.project import Project


def papers(project: Project) -> tuple[Paper, ...]:
    """The papers of a project, by file name; raises ProjectError if a file's PAPER is not right."""
    files = [
        file for root in project.roots for file in sorted((root / "cases/papers").glob("_[!_]*.py"))
    ]
    found = []
    for file in files:
        paper = imports.attribute(project.roots, file, "PAPER")
        if not isinstance(paper, Paper):
            raise ProjectError(f"{file}: PAPER is of type {type(paper).__name__}; it must be Paper")
        found.append(paper)
    return tuple(found)
