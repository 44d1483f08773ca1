"""The commands that only look: list, codes, report, explain, diff, history."""

from __future__ import annotations

import functools
from pathlib import Path
from typing import Annotated

import typer

from vv.base.errors import UsageError
from vv.output import terminal
from vv.plan.project import find

PAST = 20  # invocations in which a last result is looked for


def list_cases() -> None:
    """List cases and their variants."""
    from vv.output.listing import print_cases

    project = find()
    print_cases([project.load_case(name) for name in project.case_names()])


def list_codes() -> None:
    """List codes: found or not, version, path, schemes, how to install what is missing."""
    from vv.output.listing import print_codes

    project = find()
    print_codes([project.load_adapter(name) for name in project.adapter_names()])


def report(
    run_name: Annotated[
        str, typer.Argument(metavar="[RUN]", help="A run's name; the latest if not given.")
    ] = "",
    output: Annotated[Path | None, typer.Option("--output", help="The file to write.")] = None,
    show: Annotated[bool, typer.Option("--open", help="Open it in a browser.")] = False,
    csv: Annotated[
        Path | None,
        typer.Option("--csv", metavar="FILE", help="Also write its results as a table."),
    ] = None,
) -> None:
    """Write the report of a past run."""
    from vv.base.hints import name_hint
    from vv.cli.invocation import builder
    from vv.store.store import Store

    project = find()
    store = Store(project.data())
    names = store.manifests()
    if not names or (run_name and run_name not in names):
        unknown = f"no run '{run_name}'{name_hint(run_name, names[-5:])}"
        raise UsageError(unknown if run_name else "there is no run yet")
    manifest = store.manifest(run_name) if run_name else store.latest()
    if manifest is None:
        raise UsageError("no past run can be read; `vv run` makes one")
    path = output or project.data() / "report.html"
    say = terminal.note if csv else terminal.say  # the table may be asked for on standard output
    say(str(builder(project, drawing=True)(manifest, store, path)))
    if csv:
        from vv.base.files import write_output
        from vv.output.table import table

        write_output(csv, table(manifest.records).to_csv(index=False).encode())
    if show:
        typer.launch(str(path))


def explain(selection: Annotated[list[str], typer.Argument(help="CASE or CASE:VARIANT.")]) -> None:
    """Explain a case: source, formula, parameters, tolerances, mapping into codes, results."""
    from vv.output.explain import print_explanation
    from vv.plan.plan import Options, make_plan
    from vv.store.store import Store

    project = find()
    plan = make_plan(project, selection, Options())
    print_explanation(plan, Store(project.data()).newest(PAST, terminal.note))


def diff(
    one: Annotated[
        str, typer.Argument(metavar="A", help="A run's name, or a commit as git knows it.")
    ],
    other: Annotated[
        str, typer.Argument(metavar="B", help="Another run or commit; the latest run if not given.")
    ] = "",
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
    names = store.manifests()
    if not names:
        raise UsageError("there are no runs to compare; `vv run` makes one")
    known = functools.partial(checkout.named, project.root)
    first = compare.manifest_of(store, one, known)
    second = compare.manifest_of(store, other, known) if other else store.latest()
    if second is None:
        raise UsageError("no past run can be read; `vv run` makes one")
    print_changes(compare.changes(first, second), first, second, rows)


def history(
    case: Annotated[str, typer.Argument(metavar="CASE", help="The case to look at.")],
) -> None:
    """Show errors over tolerances, and relative costs, of a case over the last commits."""
    from vv.insight.history import history as read
    from vv.output.result_lines import print_history
    from vv.plan.selection import select
    from vv.store.store import Store

    project = find()
    names = {found.name for found, _ in select(project, [case])}
    store = Store(project.data())
    for name in sorted(names):
        print_history(name, read(store, name, terminal.note))
