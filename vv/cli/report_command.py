"""The command that writes the report of a past run: `vv report`."""

from __future__ import annotations

import fnmatch
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from vv.base.errors import UsageError
from vv.cli import options
from vv.output import terminal
from vv.plan.project import Project, find

if TYPE_CHECKING:
    from vv.records.manifest import Manifest
    from vv.store.store import Store

PAGE = ".html"


def report(
    run_name: Annotated[
        str, typer.Argument(metavar="[RUN]", help="A run's name; the latest if not given.")
    ] = "",
    output: Annotated[
        Path | None, typer.Option("--output", help="The folder to write; with --single, the file.")
    ] = None,
    single: Annotated[
        str,
        typer.Option(
            "--single", metavar="CASES", help="One file, of these cases only: CASE,...; globs too."
        ),
    ] = "",
    show: Annotated[bool, typer.Option("--open", help="Open it in a browser.")] = False,
    csv: Annotated[
        Path | None,
        typer.Option(
            "--csv",
            metavar="FILE",
            help="Also write its results as a table.",
            callback=options.writable,
        ),
    ] = None,
) -> None:
    """Write the report of a past run: a folder of HTML pages."""
    from vv.store.store import Store

    project = find()
    store = Store(project.data())
    manifest = _manifest(store, run_name)
    say = terminal.note if csv else terminal.say  # the table may go to standard output
    path = _written(project, store, manifest, output, options.split(single))
    say(str(path))
    if csv:
        from vv.base.files import write_output
        from vv.output.table import table

        write_output(csv, table(manifest.records).to_csv(index=False).encode())
    if show:
        typer.launch(str(path))


def _manifest(store: Store, name: str) -> Manifest:
    """The run of that name, or the latest; raises UsageError where there is none."""
    from vv.base.hints import name_hint

    names = store.manifests.names()
    if not names or (name and name not in names):
        unknown = f"no run '{name}'{name_hint(name, names[-5:])}"
        raise UsageError(unknown if name else "there is no run yet")
    manifest = store.manifests.read(name) if name else store.manifests.latest()
    if manifest is None:
        raise UsageError("no past run can be read; `vv run` makes one")
    return manifest


def _written(
    project: Project,
    store: Store,
    manifest: Manifest,
    output: Path | None,
    patterns: tuple[str, ...],
) -> Path:
    """Write the report as a folder, or of the cases that match as one file; returns its page."""
    from vv.cli.invocation import report_extras, report_writer

    html, more = report_writer(project), report_extras(project, manifest)
    if not patterns:
        folder = project.data() / "report" if output is None else _folder(output)
        front: Path = html.build(manifest, store, folder, more)
        return front
    cases = [name for name in manifest.cases if any(fnmatch.fnmatch(name, p) for p in patterns)]
    if not cases:
        raise UsageError(f"--single {','.join(patterns)}: the run has no such case")
    output = output or project.data() / f"report{PAGE}"
    file: Path = html.build_single(manifest, store, cases, output, more)
    return file


def _folder(output: Path) -> Path:
    """The folder that a user named; raises UsageError if it contains other files."""
    if output.suffix == PAGE:
        raise UsageError(f"--output {output}: a report is a folder; `--single '*'` makes one file")
    if not output.resolve().parent.is_dir():
        raise UsageError(f"--output {output}: there is no folder {output.resolve().parent}")
    ours = (output / "stamps.json").is_file()
    if output.exists() and not ours and (not output.is_dir() or any(output.iterdir())):
        raise UsageError(f"--output {output}: it already exists and is not a report")
    return output
