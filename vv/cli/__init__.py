"""The command line: the only place that puts the parts together and prints."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Any

import typer

from vv import screen
from vv.ask import Knobs
from vv.gate import RUN_BITS, exit_bits
from vv.plan import Options, Plan, choose_schemes, make_plan, select
from vv.project import Project, find
from vv.settings import UsageError, knobs_from, near
from vv.store import Store, write
from vv.study import Level

BITS = (
    "Exit status, a sum of bits: 0 all is well; 1 accuracy; 2 conservation; 4 speed; 8 crash or "
    "divergence; 16 timeout; 32 incomplete: nothing ran, or a required code is missing; "
    "64 usage, alone. `vv run` reports 8, 16, 32 and 64 only; `vv gate` reports all."
)
TIMEOUT = 120.0  # s for one job, unless said otherwise
app = typer.Typer(
    help="Verify contact mechanics codes: one benchmark, many codes, error and cost in a report.",
    epilog=BITS,
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode="markdown",
)

Selection = Annotated[
    list[str] | None, typer.Argument(help="FAMILY, CASE or CASE:VARIANT; globs allowed.")
]
Codes = Annotated[
    str,
    typer.Option("--codes", metavar="CODES", help="CODE[/SCHEME],... to ask; all if not given."),
]
Required = Annotated[
    str, typer.Option("--require", metavar="CODES", help="Codes whose absence is an error.")
]
Sets = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="NAME=VALUE[UNIT]", help="Change a parameter; repeatable."),
]
Rungs = Annotated[
    list[str] | None,
    typer.Option("--rung", metavar="dt=..[,kn=..]", help="Use these knobs; repeatable."),
]
Levels = Annotated[Level, typer.Option("--level", help="How much of each case to run.")]
JsonFile = Annotated[
    Path | None, typer.Option("--json", metavar="FILE", help="Write all records, with series.")
]


@app.command("run", rich_help_panel="Run")
def run(
    selection: Selection = None,
    everything: Annotated[bool, typer.Option("--all", help="Every case, with timing.")] = False,
    codes: Codes = "*",
    require: Required = "",
    settings: Sets = None,
    level: Levels = Level.DEFAULT,
    rungs: Rungs = None,
    jobs: Annotated[int, typer.Option("--jobs", min=0, help="Processes; 0: one a core.")] = 0,
    fresh: Annotated[bool, typer.Option("--fresh", help="Use nothing stored.")] = False,
    timeout: Annotated[float, typer.Option("--timeout", help="Seconds for a job.")] = TIMEOUT,
    dry_run: Annotated[bool, typer.Option("--dry-run", help="Say what would run.")] = False,
    json_file: JsonFile = None,
) -> None:
    """Run cases in codes and write the report; exits non-zero if something could not run."""
    project = find()
    plan = _plan(project, selection, everything, codes, settings, level, rungs)
    required = _patterns(plan, require)
    if dry_run:
        screen.print_jobs(plan)
        return
    timing = everything and level is not Level.QUICK
    workers, seconds = jobs or _cores(), _positive(timeout)
    manifest = _carried_out(project, plan, json_file, workers, seconds, fresh, timing)
    raise typer.Exit(exit_bits(manifest["records"], required) & RUN_BITS)


@app.command("list", rich_help_panel="Look")
def list_cases() -> None:
    """List cases and their variants."""
    project = find()
    screen.print_cases([project.load_case(name) for name in project.case_names()])


@app.command("codes", rich_help_panel="Look")
def list_codes() -> None:
    """List codes: found or not, version, path, schemes, how to install what is missing."""
    project = find()
    screen.print_codes([project.load_adapter(name) for name in project.adapter_names()])


@app.command("report", rich_help_panel="Look")
def report(
    run_name: Annotated[
        str, typer.Argument(metavar="[RUN]", help="A run's name; the latest.")
    ] = "",
    output: Annotated[Path | None, typer.Option("--output", help="The file to write.")] = None,
    show: Annotated[bool, typer.Option("--open", help="Open it in a browser.")] = False,
) -> None:
    """Write the report of a past run."""
    project = find()
    store = Store(project.data())
    names = store.manifests()
    if not names or (run_name and run_name not in names):
        raise UsageError(f"no run '{run_name or 'at all'}'{near(run_name, names[-5:])}")
    name = run_name or names[-1]
    manifest = {**store.manifest(name), "name": name}
    path = output or project.data() / "report.html"
    screen.say(str(_builder(project, drawing=True)(manifest, store, path)))
    if show:
        typer.launch(str(path))


@app.command("explain", rich_help_panel="Look")
def explain(selection: Annotated[list[str], typer.Argument(help="CASE or CASE:VARIANT.")]) -> None:
    """Say what a case is: formula, source, parameters, mapping into codes, tolerances, result."""
    project = find()
    store = Store(project.data())
    plan = make_plan(project, selection, Options())
    screen.explain(plan, [store.manifest(name) for name in reversed(store.manifests()[-20:])])


@app.command("gate", rich_help_panel="Judge")
def gate(
    selection: Selection = None,
    codes: Codes = "*",
    require: Required = "",
    level: Levels = Level.QUICK,
    json_file: JsonFile = None,
) -> None:
    """Run what is not stored and judge it: every exit bit counts."""
    project = find()
    plan = _plan(project, selection, not selection, codes, None, level, None)
    manifest = _carried_out(project, plan, json_file, _cores())
    raise typer.Exit(exit_bits(manifest["records"], _patterns(plan, require)))


@app.command("export", rich_help_panel="Extend")
def export(
    selection: Annotated[str, typer.Argument(metavar="CASE:VARIANT")],
    code: Annotated[str, typer.Option("--code", metavar="CODE[/SCHEME]")],
    rungs: Rungs = None,
    settings: Sets = None,
    output: Annotated[
        Path | None, typer.Option("--output", help="The file; else standard output.")
    ] = None,
) -> None:
    """Write the native script or deck of one variant for one code; it runs alone."""
    project = find()
    chosen = select(project, [selection])
    if len(chosen) != 1:
        raise UsageError(f"'{selection}' names {len(chosen)} variants; export takes one")
    options = Options(codes=(code,), settings=tuple(settings or ()), rungs=_knobs(rungs))
    job = make_plan(project, [selection], options).jobs[-1 if not rungs else 0]
    adapter, scheme = choose_schemes(
        {a: project.load_adapter(a) for a in project.adapter_names()}, [code]
    )[0]
    text = adapter.native(job.ask, scheme.name)
    write(output, text.encode()) if output else screen.say(text)


def _plan(
    project: Project,
    selection: list[str] | None,
    everything: bool,
    codes: str,
    settings: list[str] | None,
    level: Level,
    rungs: list[str] | None,
) -> Plan:
    if not selection and not everything:
        raise UsageError("name a case or say --all; `vv list` shows the cases")
    if selection and everything:
        raise UsageError("name cases or say --all, not both")
    options = Options(level, _split(codes), tuple(settings or ()), _knobs(rungs))
    return make_plan(project, selection or ["*"], options)


def _carried_out(
    project: Project,
    plan: Plan,
    json_file: Path | None,
    workers: int,
    timeout: float = TIMEOUT,
    fresh: bool = False,
    timing: bool = False,
) -> dict[str, Any]:
    from vv.session import Limits, carry_out

    limits = Limits(workers, timeout, fresh, timing)
    with screen.progress(len(plan.jobs)) as shown:
        manifest = carry_out(project, plan, limits, shown, ["vv", *sys.argv[1:]])
    if json_file:
        from vv.export import full_records

        records = full_records(manifest, Store(project.data()))
        write(json_file, json.dumps({"records": records}, allow_nan=False).encode())
    build = _builder(project, drawing=timing)
    path = build(manifest, Store(project.data()), project.data() / "report.html")
    screen.print_counts(manifest["records"], path)
    return manifest


def _builder(project: Project, drawing: bool) -> Callable[[dict[str, Any], Store, Path], Path]:
    """What writes a report; without drawing, figures are left to `vv report`."""
    project.activate()
    from reports import html

    return html.build if drawing else html.build_quickly


def _patterns(plan: Plan, required: str) -> tuple[str, ...]:
    choose_schemes(plan.adapters, _split(required))
    return _split(required)


def _split(text: str) -> tuple[str, ...]:
    return tuple(part.strip() for part in text.split(",") if part.strip())


def _knobs(texts: list[str] | None) -> tuple[Knobs, ...]:
    return tuple(knobs_from(text) for text in texts or ())


def _cores() -> int:
    return len(os.sched_getaffinity(0))


def _positive(timeout: float) -> float:
    if not timeout > 0:
        raise UsageError(f"--timeout = {timeout!r} s; it must be positive")
    return timeout


def main() -> None:
    """Run the command line; bad input gets one line and exit status 64, never a traceback."""
    try:
        code = app(standalone_mode=False)
    except UsageError as error:
        code = screen.complain(str(error))
    except typer.Exit as stop:
        code = stop.exit_code
    except typer.Abort:
        code = screen.complain("interrupted")
    except Exception as error:
        message = getattr(error, "format_message", None)  # what the option parser complains of
        if message is None:
            raise
        code = screen.complain(message())
    sys.exit(code or 0)
