"""The command that hands input to others: `vv export`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from vv.ask import Status
from vv.base.errors import UsageError
from vv.base.files import write_output
from vv.cli import options
from vv.output.terminal import note
from vv.plan.project import find


def export(
    selection: Annotated[str, typer.Argument(metavar="CASE:VARIANT")],
    code: Annotated[str, typer.Option("--code", metavar="CODE[/SCHEME]")],
    rungs: options.Rungs = None,
    settings: options.Sets = None,
    output: Annotated[
        Path | None,
        typer.Option("--output", help="The file to write; standard output if not given."),
    ] = None,
) -> None:
    """Write the input of one variant for one code: a script or deck that can be run by itself."""
    from vv.plan.plan import Options, make_plan
    from vv.plan.selection import choose_schemes, named_adapters, select

    project = find()
    chosen = select(project, [selection])
    if len(rungs or ()) > 1:
        raise UsageError(f"export takes one --rung, not {len(rungs or ())}")
    if len(chosen) != 1:
        raise UsageError(f"'{selection}' names {len(chosen)} variants; export takes one")
    asked = Options(codes=(code,), settings=tuple(settings or ()), rungs=options.knobs(rungs))
    adapter, scheme = choose_schemes(named_adapters(project, [code]), [code])[0]
    jobs = make_plan(project, [selection], asked).jobs
    job = [one for one in jobs if (one.code, one.scheme) == (adapter.name, scheme.name)][-1]
    if job.settled is not None and job.settled.status is Status.REFUSED:
        raise UsageError(f"{code} refuses {selection}: {job.settled.reason}")
    write_output(output or Path("-"), adapter.native(job.ask, scheme.name).encode())
    note(f"written: {job.label}")
