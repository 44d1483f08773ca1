"""The command that writes the input of a code, or a question as JSON: `vv export`."""

from __future__ import annotations

import dataclasses
import enum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from vv.ask import Status
from vv.base.errors import UsageError
from vv.base.files import write_output
from vv.cli import options
from vv.output.terminal import note
from vv.plan.project import Project, find

if TYPE_CHECKING:
    from vv.case import Case
    from vv.plan.plan import Options


class Form(enum.Enum):
    """The form of an export: a code's own input, or the question as JSON."""

    NATIVE = "native"
    JSON = "json"


def export(
    selection: Annotated[str, typer.Argument(metavar="CASE:VARIANT")],
    code: Annotated[
        str,
        typer.Option(
            "--code", metavar="CODE[/SCHEME]", help="The code, or a program's FILE.toml[/SCHEME]."
        ),
    ] = "",
    form: Annotated[
        Form, typer.Option("--format", help="json: the ask.json that a program is given.")
    ] = Form.NATIVE,
    rungs: options.Rungs = None,
    settings: options.Sets = None,
    output: Annotated[
        Path | None,
        typer.Option("--output", help="The file to write; standard output if not given."),
    ] = None,
) -> None:
    """Write the input of one variant: a code's script or deck, or the question as JSON."""
    from vv.plan.plan import Options
    from vv.plan.selection import select

    project, named = options.with_programs(find(), code or "*")
    chosen = select(project, [selection])
    if len(rungs or ()) > 1:
        raise UsageError(f"export takes one --rung, not {len(rungs or ())}")
    if len(chosen) != 1:
        raise UsageError(f"'{selection}' names {len(chosen)} variants; export takes one")
    asked = Options(codes=named, settings=tuple(settings or ()), rungs=options.knobs(rungs))
    if form is Form.JSON and not code:
        text, label = _question(*chosen[0], asked), selection
    elif not code:
        raise UsageError("name a --code, or use --format json to write the question itself")
    else:
        text, label = _input(project, selection, asked, form)
    write_output(output or Path("-"), text.encode())
    note(f"written: {label}" + (f" in {output}" if output else ""))


def _question(case: Case, variant: str, asked: Options) -> str:
    """The ask.json of the finest setting."""
    from vv.codes.program import question
    from vv.plan.planning import finest_ask

    ask = finest_ask(case, variant, asked)
    knobs = [name for name, value in dataclasses.asdict(ask.knobs).items() if value is not None]
    return question.text(ask, "default", knobs)


def _input(project: Project, selection: str, asked: Options, form: Form) -> tuple[str, str]:
    """The input that the adapter writes, or the ask.json with its knobs; and the job's label."""
    from vv.codes.program import question
    from vv.plan.planning import make_plan
    from vv.plan.selection import choose_schemes, named_adapters

    adapter, scheme = choose_schemes(named_adapters(project, asked.codes), asked.codes)[0]
    jobs = make_plan(project, [selection], asked).jobs
    job = [one for one in jobs if (one.code, one.scheme) == (adapter.name, scheme.name)][-1]
    if job.settled is not None and job.settled.status is Status.REFUSED:
        raise UsageError(f"{asked.codes[0]} refuses {selection}: {job.settled.reason}")
    if form is Form.JSON:
        return question.text(job.ask, scheme.name, scheme.knobs), job.label
    return adapter.native(job.ask, scheme.name), job.label
