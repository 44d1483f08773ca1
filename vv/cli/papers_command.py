"""The command that compares published numbers with exact answers and codes: `vv papers`."""

from __future__ import annotations

import functools
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated

import typer

from vv.base.errors import UsageError
from vv.output import terminal
from vv.plan.project import Project, find
from vv.records.accepted import AcceptedResult

PAST = 20  # the most past runs in which newer results are searched


def papers(
    chosen: Annotated[
        list[str] | None, typer.Argument(metavar="[PAPER]...", help="Part of a paper's name.")
    ] = None,
    accepted: Annotated[
        bool, typer.Option("--accepted", help="Leave out results that are not accepted yet.")
    ] = False,
    output: Annotated[Path | None, typer.Option("--output", help="The file to write.")] = None,
) -> None:
    """Compare the published numbers of the papers with exact answers and with the codes."""
    from vv.insight.papers import rows
    from vv.output.papers_page import page
    from vv.plan.published import papers as known

    project = find()
    named = [word.lower() for word in chosen or ()]
    found = [
        paper
        for paper in known(project)
        if not named or any(word in paper.name.lower() for word in named)
    ]
    if not found:
        which = f" '{' '.join(named)}'" if named else ""
        raise UsageError(f"no paper{which}; a file of cases/papers/ describes each")
    results = functools.cache(functools.partial(_results, project, accepted))
    text = page([(paper, rows(paper, results)) for paper in found])
    if output:
        from vv.base.files import write_output

        write_output(output, text.encode())
    else:
        terminal.say(*text.splitlines())


def _results(project: Project, accepted: bool, case: str) -> Mapping[str, AcceptedResult]:
    """The accepted results of a case and, unless excluded, newer ones."""
    from vv.gate.all_checks import baseline_of

    baseline = baseline_of(project, case)
    known = dict(baseline.results) if baseline else {}
    return known if accepted else {**known, **_newer(project, case)}


def _newer(project: Project, case: str) -> Mapping[str, AcceptedResult]:
    """The newest stored results of a case with its own parameters."""
    from vv.ask import Status
    from vv.gate.baseline import name_of, result_of
    from vv.store.store import Store

    store = Store(project.data())
    found: dict[str, AcceptedResult] = {}
    for name in store.manifests.names()[-PAST:]:
        try:
            records = store.manifests.records_of(name, case)
        except OSError as error:
            terminal.note(f"past run {name}: {error.strerror}; skipped")
            continue
        ran = (r for r in records if r.status is Status.RAN and not r.modified)
        found |= {name_of(record): result_of(record, "") for record in ran}
    return found
