"""Loads the papers whose statements a project lists, one file of cases/papers/ each."""

from __future__ import annotations

from pathlib import Path

from vv.case.published import Paper
from vv.plan import imports
from vv.plan.content import ProjectError
from vv.plan.project import Project


def files(project: Project) -> list[Path]:
    """The files of a project that list what papers publish."""
    folders = [root / "cases/papers" for root in project.roots]
    return [file for folder in folders for file in sorted(folder.glob("_[!_]*.py"))]


def papers(project: Project) -> tuple[Paper, ...]:
    """The papers of a project, by file name; raises ProjectError if a file's PAPER is not right."""
    found = []
    for file in files(project):
        paper = imports.attribute(project.roots, file, "PAPER")
        if not isinstance(paper, Paper):
            raise ProjectError(f"{file}: PAPER is of type {type(paper).__name__}; it must be Paper")
        found.append(paper)
    return tuple(found)
