"""The command that runs cases: `vv run`."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from vv.base.errors import UsageError
from vv.case import Level
from vv.cli import options
from vv.output import terminal
from vv.plan.project import Project, find

if TYPE_CHECKING:
    from vv.ask import Knobs
    from vv.plan.plan import Plan
    from vv.records.manifest import Manifest, PrintedOutput
    from vv.run.session import Limits
    from vv.store.store import Store


@dataclass(frozen=True)
class Narrowing:
    """Options that select part of a plan: --failed, --since, --budget; false if none is given."""

    failed: bool
    since: str
    budget: str

    def __bool__(self) -> bool:
        return bool(self.failed or self.since or self.budget)


@dataclass(frozen=True)
class Ending:
    """What to do with results: codes that must have run, the level asked for, a file to write."""

    required: tuple[str, ...]
    level: Level
    json_file: Path | None


def run(
    selection: options.Selection = None,
    everything: Annotated[
        bool, typer.Option("--all", help="Run every case, and time those that ask for it.")
    ] = False,
    failed: Annotated[
        bool, typer.Option("--failed", help="Only what failed in the last run.")
    ] = False,
    since: Annotated[
        str, typer.Option(metavar="REV", help="Only what the changes since this commit can affect.")
    ] = "",
    budget: Annotated[
        str,
        typer.Option(
            metavar="60s", help="Only as many jobs as fit this time, the most informative first."
        ),
    ] = "",
    keyword: options.Keyword = "",
    first: Annotated[
        bool,
        typer.Option("-x", "--exitfirst", help="Stop at the first result that is out of bounds."),
    ] = False,
    codes: options.Codes = "*",
    require: options.Required = "",
    settings: options.Sets = None,
    level: options.Levels = Level.DEFAULT,
    rungs: options.Rungs = None,
    jobs: options.Jobs = 0,
    fresh: options.Fresh = False,
    timeout: options.Timeout = options.TIMEOUT,
    executor: options.Executor = "local",
    dry_run: Annotated[bool, typer.Option("--dry-run", help="Only list what would run.")] = False,
    json_file: options.JsonFile = None,
    show: Annotated[bool, typer.Option("--open", help="Open the report in a browser.")] = False,
) -> None:
    """Run cases in codes, print errors, orders and costs, and write the report.

    The exit status is that of `vv gate` on the same results: not 0 if an error or a law is out of
    bounds, a code crashed, diverged, hung, or is required and missing.
    """
    from vv.cli import invocation
    from vv.plan.plan import Options
    from vv.run.first_failure import fails
    from vv.store.store import Store

    narrowing = Narrowing(failed, since, budget)
    if selection and everything:
        raise UsageError("name cases or say --all, not both")
    if not (selection or everything or narrowing or keyword):
        raise UsageError("name a case or say --all; `vv list` shows the cases")
    project, named = options.with_programs(find(), codes)
    store = Store(project.data())
    last = _last(store) if failed else None
    knobs = options.knobs(rungs) or (_rungs_that_failed(last) if last else ())
    chosen = Options(level, named, tuple(settings or ()), knobs)
    required = options.required(project, require)

    def make_plan() -> Plan:
        plan = options.plan_of(project, selection or [], chosen, keyword)
        return _narrowed(project, store, plan, last, narrowing)

    if dry_run:
        _list_jobs(project, store, make_plan(), fresh)
        return
    timed = everything and level is not Level.QUICK and not (narrowing or keyword or first)
    limits = _limits(jobs, timeout, fresh, timed, executor)
    ending = Ending(required, level, json_file)
    if narrowing or first:  # depends on past runs, which change with each, or on what comes first
        plan = make_plan()
        if not plan.jobs:
            terminal.say(_nothing(narrowing))
            return
        until = fails(project) if first else None
        manifest = invocation.carried_out(project, plan, limits, until)
        printed = _conclude(project, manifest, ending)
    else:
        asked = "run", tuple(selection or ()), chosen, keyword
        known = None if json_file else invocation.printed_before(project, asked, limits, required)
        printed = known or _run_and_keep(project, asked, make_plan, limits, ending)
    for text in printed.notes:
        terminal.note(text)
    terminal.say(*printed.lines)
    if show:
        typer.launch(str(invocation.report_folder(project) / "index.html"))
    raise typer.Exit(printed.status)


def _limits(jobs: int, timeout: float, fresh: bool, timed: bool, executor: str) -> Limits:
    from vv.run.session import Limits, Timing

    timing = Timing.STORED if timed else Timing.NONE
    return Limits(
        options.workers(jobs),
        options.positive(timeout),
        fresh,
        timing,
        executor=options.executor(executor),
    )


def _run_and_keep(
    project: Project,
    asked: tuple[object, ...],
    make_plan: Callable[[], Plan],
    limits: Limits,
    ending: Ending,
) -> PrintedOutput:
    """Answer a call that does not stand yet, and note what it tells."""
    from vv.cli import invocation

    manifest = invocation.answered(project, asked, make_plan, limits)
    printed = _conclude(project, manifest, ending)
    invocation.keep_output(project, asked, limits, manifest.name, printed)
    return printed


def _conclude(project: Project, manifest: Manifest, ending: Ending) -> PrintedOutput:
    """Write the records and the report; returns what there is to tell of them."""
    from vv.cli import invocation
    from vv.gate.judgement import judgement
    from vv.output import result_lines
    from vv.records.finding import bits
    from vv.records.manifest import PrintedOutput
    from vv.run import reuse
    from vv.store.store import Store

    invocation.write_records(project, manifest, ending.json_file)
    report = invocation.reported(project, manifest)
    findings = judgement(manifest, ending.required)

    def print_results() -> None:
        result_lines.print_table(manifest.records, findings)
        judged = [one for one in findings if one.bit]
        named = options.named_files(project)
        result_lines.print_findings(judged, manifest.records, ending.level, named, manifest)
        invocation.print_summary(manifest, str(report))

    notes, lines = terminal.captured(print_results)
    store, folder = Store(project.data()), invocation.report_folder(project)
    of = reuse.output_key(store, manifest.name, folder, ending.required)
    return PrintedOutput(tuple(notes), tuple(lines), bits(findings), of)


def _list_jobs(project: Project, store: Store, plan: Plan, fresh: bool) -> None:
    """Say of each job whether it would run or is stored."""
    from vv.output.listing import print_jobs
    from vv.plan import keys

    found = {} if fresh else keys.run_keys(project, plan)
    print_jobs(plan, {n for n, key in found.items() if store.has_run(key)})


def _last(store: Store) -> Manifest:
    last = store.latest()
    if last is None:
        raise UsageError("--failed: there is no last run")
    return last


def _rungs_that_failed(last: Manifest) -> tuple[Knobs, ...]:
    """The knobs of what failed: they need not belong to the level asked for."""
    from vv.run.narrowing import troubled_records

    return tuple(dict.fromkeys(record.rung for record in troubled_records(last)))


def _narrowed(
    project: Project, store: Store, plan: Plan, last: Manifest | None, narrowing: Narrowing
) -> Plan:
    from vv.plan.plan import with_jobs_kept
    from vv.run import narrowing as narrow
    from vv.run import pace
    from vv.store.checkout import changed_since

    if last is not None:
        wanted = narrow.troubled(last)
        plan = with_jobs_kept(plan, lambda job: pace.key(job) in wanted)
    if narrowing.since:
        plan = narrow.affected(project, plan, changed_since(project.root, narrowing.since))
    if narrowing.budget:
        past = store.newest(pace.PAST, terminal.note)
        plan = narrow.within(plan, narrow.seconds(narrowing.budget), past)
    return plan


def _nothing(narrowing: Narrowing) -> str:
    if narrowing.failed:
        return "nothing to run: all did well in the last run"
    if narrowing.since:
        return f"nothing to run: no change since {narrowing.since} can affect a result"
    return f"nothing to run: no job fits {narrowing.budget}"
