"""The commands that only look: list, codes, report, explain, diff, history."""

from __future__ import annotations

import functools
from pathlib import Path
from typing import Annotated

import typer

from vv.base.errors import UsageError
from vv.output import terminal
from vv.output.explain import tell
from vv.plan.plan import Options, make_plan
from vv.plan.project import find
from vv.plan.selection import select
from vv.plan.settings import name_hint
from vv.store.store import Store

PAST = 20  # invocations in which a last result is looked for


def list_cases() -> None:
    """List cases and their variants."""
    project = find()
    terminal.print_cases([project.load_case(name) for name in project.case_names()])


def list_codes() -> None:
    """List codes: found or not, version, path, schemes, how to install what is missing."""
    project = find()
    terminal.print_codes([project.load_adapter(name) for name in project.adapter_names()])


def report(
    run_name: Annotated[
        str, typer.Argument(metavar="[RUN]", help="A run's name; the latest.")
    ] = "",
    output: Annotated[Path | None, typer.Option("--output", help="The file to write.")] = None,
    show: Annotated[bool, typer.Option("--open", help="Open it in a browser.")] = False,
) -> None:
    """Write the report of a past run."""
    from vv.cli.invocation import builder

    project = find()
    store = Store(project.data())
    names = store.manifests()
    if not names or (run_name and run_name not in names):
        unknown = f"no run '{run_name}'{name_hint(run_name, names[-5:])}"
        raise UsageError(unknown if run_name else "there is no run yet")
    name = run_name or names[-1]
    manifest = {**store.manifest(name), "name": name}
    path = output or project.data() / "report.html"
    terminal.say(str(builder(project, drawing=True)(manifest, store, path)))
    if show:
        typer.launch(str(path))


def explain(selection: Annotated[list[str], typer.Argument(help="CASE or CASE:VARIANT.")]) -> None:
    """Say what a case is: formula, source, parameters, mapping into codes, tolerances, result."""
    project = find()
    store = Store(project.data())
    plan = make_plan(project, selection, Options())
    tell(plan, store.newest(PAST))


def diff(
    one: Annotated[
        str, typer.Argument(metavar="A", help="A run's name, or a commit as git knows it.")
    ],
    other: Annotated[str, typer.Argument(metavar="B", help="Another; the latest run.")] = "",
    rows: Annotated[int, typer.Option("--rows", min=1, help="Lines of each kind.")] = 15,
) -> None:
    """Say what moved between two runs, or the last runs of two commits: error, order, cost."""
    from vv.insight import compare
    from vv.store import checkout

    project = find()
    store = Store(project.data())
    names = store.manifests()
    if not names:
        raise UsageError("there are no runs to compare; `vv run` makes one")
    known = functools.partial(checkout.named, project.root)
    first = compare.manifest_of(store, one, known)
    second = compare.manifest_of(store, other or names[-1], known)
    terminal.print_changes(compare.changes(first, second), first, second, rows)


def history(
    case: Annotated[str, typer.Argument(metavar="CASE", help="The case to look at.")],
) -> None:
    """Show error over tolerance and relative cost of a case over the last commits."""
    from vv.insight.history import history as read

    project = find()
    names = {found.name for found, _ in select(project, [case])}
    store = Store(project.data())
    for name in sorted(names):
        terminal.print_history(name, read(store, name))
