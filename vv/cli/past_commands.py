"""The commands that look back at past runs: runs, diff, history, papers."""

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


def runs(
    rows: Annotated[
        int, typer.Option("--rows", min=1, help="At most so many, the newest ones.")
    ] = 15,
) -> None:
    """List past runs, newest first: name, commit, cases, command. `vv diff` compares two."""
    from vv.output.result_lines import print_runs
    from vv.store.store import Store

    manifests = Store(find().data()).manifests
    found = []
    for name in manifests.names()[: -rows - 1 : -1]:
        try:
            found.append((name, *manifests.head(name)))
        except OSError as error:
            terminal.note(f"past run {name}: {error.strerror}; skipped")
    if not found:
        raise UsageError("there are no past runs; `vv run` makes one")
    print_runs(found)


def diff(
    one: Annotated[
        str,
        typer.Argument(
            metavar="[A]",
            help="A run's name, last, last~1 and so on, or a commit as git knows it: its last run "
            "without edits. The run before the latest if not given.",
        ),
    ] = "last~1",
    other: Annotated[
        str, typer.Argument(metavar="[B]", help="Another; the latest run if not given.")
    ] = "last",
    rows: Annotated[
        int, typer.Option("--rows", min=1, help="At most so many lines for each kind of change.")
    ] = 15,
) -> None:
    """Compare two runs, or the last runs of two commits: outcome, error, order, cost."""
    from vv.insight import compare
    from vv.output.result_lines import print_changes
    from vv.store import checkout
    from vv.store.store import Store

    project = find()
    store = Store(project.data())
    if not store.manifests.names():
        raise UsageError(f"there are no runs to compare; {compare.how_to_make(one)}")
    known = functools.partial(checkout.named, project.root)
    first, second = (compare.manifest_of(store, name, known) for name in (one, other))
    if first.name == second.name:
        raise UsageError(
            f"{one} and {other} are the same run, {first.name}; `vv diff` compares the last two "
            "runs, and `vv runs` lists all"
        )
    print_changes(compare.changes(first, second), first, second, rows)


def history(
    case: Annotated[str, typer.Argument(metavar="CASE", help="The case to look at.")],
) -> None:
    """Show errors over tolerances, and relative costs, of a case over the last commits.

    Of each scheme the newest result at a commit is shown, whichever run it is from.
    """
    from vv.insight.history import history as read
    from vv.output.result_lines import print_history
    from vv.plan.selection import select
    from vv.store.store import Store

    project = find()
    names = {found.name for found, _ in select(project, [case])}
    store = Store(project.data())
    for name in sorted(names):
        print_history(name, read(store, name, terminal.note))


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
