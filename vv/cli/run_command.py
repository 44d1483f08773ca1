"""The command that runs cases: `vv run`."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated

import typer

from vv.base.errors import UsageError
from vv.case import Level
from vv.cli import options
from vv.cli.option_class import takes
from vv.output import terminal
from vv.plan.project import Project, find

if TYPE_CHECKING:
    from vv.ask import Knobs
    from vv.plan.plan import Options, Plan
    from vv.records.manifest import Manifest, PrintedOutput
    from vv.run.limits import Limits
    from vv.store.store import Store


@dataclass(frozen=True)
class RunCall:
    """The arguments of `vv run`."""

    selection: options.Selection = None
    everything: Annotated[
        bool, typer.Option("--all", help="Run every case, and time those marked for timing.")
    ] = False
    failed: Annotated[
        bool, typer.Option("--failed", help="Run only what failed in the last run.")
    ] = False
    since: Annotated[
        str, typer.Option(metavar="REV", help="Run only what changes since this commit can affect.")
    ] = ""
    budget: Annotated[
        str,
        typer.Option(
            metavar="60s", help="Run the most informative jobs, as many as fit into this time."
        ),
    ] = ""
    keyword: options.Keyword = ""
    first: Annotated[
        bool,
        typer.Option("-x", "--exitfirst", help="Stop at the first result that fails."),
    ] = False
    codes: options.Codes = "*"
    require: options.Required = ""
    settings: options.Sets = None
    level: options.Levels = Level.DEFAULT
    rungs: options.Rungs = None
    jobs: options.Jobs = 0
    fresh: options.Fresh = False
    timeout: options.Timeout = options.TIMEOUT
    executor: options.Executor = "local"
    dry_run: Annotated[bool, typer.Option("--dry-run", help="List the jobs, and run nothing.")] = (
        False
    )
    json_file: options.JsonFile = None
    show: Annotated[bool, typer.Option("--open", help="Open the report in a browser.")] = False

    @property
    def narrows(self) -> bool:
        """Whether past runs or changes select a part of the plan."""
        return bool(self.failed or self.since or self.budget)

    @property
    def repeatable(self) -> bool:
        """Whether the same call gives the same jobs as long as nothing is edited."""
        return not (self.narrows or self.first)

    @property
    def timed(self) -> bool:
        """Whether costs are timed: if every case runs to its end."""
        part = self.keyword or not self.repeatable
        return self.everything and self.level is not Level.QUICK and not part


@takes(RunCall)
def run(call: RunCall) -> None:
    """Run cases in codes, print errors, orders and costs, and write the report.

    The exit status is that of `vv gate` on the same results: nonzero if an error exceeds its
    tolerance, a conservation law is violated, or a code crashes, diverges, times out, or is
    required but missing.
    """
    from vv.cli import invocation
    from vv.plan.plan import Options
    from vv.store.store import Store

    _check_selection(call)
    project, named = options.with_programs(find(), call.codes)
    store = Store(project.data())
    last = _last(store) if call.failed else None
    knobs = options.knobs(call.rungs) or (_rungs_that_failed(last) if last else ())
    chosen = Options(call.level, named, tuple(call.settings or ()), knobs)
    required = options.required(project, call.require)
    limits = _limits(call)
    narrowed = _narrower(project, store, last, call)

    def make_plan() -> Plan:
        return narrowed(_planned(project, chosen, last, call))

    if call.dry_run:
        _list_jobs(project, store, make_plan(), call.fresh)
        return
    if call.repeatable:
        asked = "run", tuple(call.selection or ()), chosen, call.keyword
        printed = _reuse_or_run(project, asked, make_plan, call, limits, required)
    else:
        plan = make_plan()
        if not plan.jobs:
            terminal.say(_nothing(call, last))
            raise typer.Exit
        printed = _run_once(project, plan, call, limits, required)
    for text in printed.notes:
        terminal.note(text)
    terminal.say(*printed.lines)
    if call.show:
        typer.launch(str(invocation.report_folder(project) / "index.html"))
    raise typer.Exit(printed.status)


def _check_selection(call: RunCall) -> None:
    if call.selection and call.everything:
        raise UsageError("give cases or --all, not both")
    if not (call.selection or call.everything or call.narrows or call.keyword):
        raise UsageError("give a case or --all; `vv list` shows the cases")


def _limits(call: RunCall) -> Limits:
    from vv.run.limits import Limits, Timing

    timing = Timing.STORED if call.timed else Timing.NONE
    workers, timeout = options.workers(call.jobs), options.positive(call.timeout)
    executor = options.executor(call.executor)
    return Limits(workers, timeout, call.fresh, timing, executor=executor)


def _run_once(
    project: Project, plan: Plan, call: RunCall, limits: Limits, required: tuple[str, ...]
) -> PrintedOutput:
    """Run a call whose jobs depend on past runs or on the first failure."""
    from vv.cli import invocation
    from vv.gate.first_failure import is_failure

    until = is_failure(project) if call.first else None
    manifest = invocation.carry_out_with_progress(project, plan, limits, until)
    return _conclude(project, manifest, call, required)


def _reuse_or_run(
    project: Project,
    asked: tuple[object, ...],
    make_plan: Callable[[], Plan],
    call: RunCall,
    limits: Limits,
    required: tuple[str, ...],
) -> PrintedOutput:
    """Repeat what the same call printed if nothing has changed, or run it and keep its output."""
    from vv.cli import invocation

    if call.json_file is None:
        known = invocation.earlier_output(project, asked, limits, required)
        if known:
            return known
    manifest = invocation.reuse_or_carry_out(project, asked, make_plan, limits)
    printed = _conclude(project, manifest, call, required)
    invocation.keep_output(project, asked, limits, manifest.name, printed)
    return printed


def _conclude(
    project: Project, manifest: Manifest, call: RunCall, required: tuple[str, ...]
) -> PrintedOutput:
    """Write the records and the report; returns the output."""
    from vv.cli import invocation
    from vv.gate.judgement import judgement
    from vv.output import result_lines
    from vv.records.finding import bits
    from vv.records.manifest import PrintedOutput
    from vv.run import reuse
    from vv.store.store import Store

    invocation.write_records(project, manifest, call.json_file)
    report = invocation.write_report(project, manifest)
    findings = judgement(manifest, required)

    def print_results() -> None:
        result_lines.print_table(manifest.records, findings)
        judged = [one for one in findings if one.bit]
        named = options.named_files(project)
        result_lines.print_findings(judged, manifest.records, call.level, named, manifest)
        invocation.print_summary(project, manifest, str(report))

    notes, lines = terminal.captured(print_results)
    store, folder = Store(project.data()), invocation.report_folder(project)
    of = reuse.output_key(store, manifest.name, folder, required)
    return PrintedOutput(tuple(notes), tuple(lines), bits(findings), of)


def _list_jobs(project: Project, store: Store, plan: Plan, fresh: bool) -> None:
    """List the jobs, with whether each would run or is stored."""
    from vv.output.listing import print_jobs
    from vv.plan import keys

    found = {} if fresh else keys.run_keys(project, plan)
    print_jobs(plan, {n for n, key in found.items() if store.has_run(key)})


def _planned(project: Project, chosen: Options, last: Manifest | None, call: RunCall) -> Plan:
    """The plan of a call; --failed keeps the changed parameters of the last run."""
    from vv.plan.plan import merge_plans, with_jobs_kept
    from vv.plan.selection import select
    from vv.run.narrowing import failing_places

    selection = call.selection or []
    failed = failing_places(last) if last and not chosen.settings else {}
    if not failed:
        return options.plan_of(project, selection, chosen, call.keyword)
    plans = [
        options.plan_of(project, places, dataclasses.replace(chosen, settings=texts), call.keyword)
        for texts, places in failed.items()
    ]
    whole = functools.reduce(merge_plans, plans)
    wanted = {(case.name, variant) for case, variant in select(project, selection or ["*"])}
    return with_jobs_kept(whole, lambda job: (job.case, job.variant) in wanted)


def _last(store: Store) -> Manifest:
    last = store.manifests.latest()
    if last is None:
        raise UsageError("--failed: there is no previous run")
    return last


def _rungs_that_failed(last: Manifest) -> tuple[Knobs, ...]:
    """The knobs of failed jobs, which may not belong to the requested level."""
    from vv.run.narrowing import failing_records

    return tuple(dict.fromkeys(record.rung for record in failing_records(last)))


def _narrower(
    project: Project, store: Store, last: Manifest | None, call: RunCall
) -> Callable[[Plan], Plan]:
    """The function that narrows a plan; raises UsageError for bad options before planning."""
    if not (call.failed or call.since or call.budget):
        return lambda plan: plan
    from vv.plan.plan import with_jobs_kept
    from vv.run import narrowing as narrow
    from vv.run import pace
    from vv.store.checkout import changed_since

    changed = changed_since(project.root, call.since) if call.since else None
    most = narrow.budget_seconds(call.budget) if call.budget else None

    def narrowed(plan: Plan) -> Plan:
        if last is not None:
            wanted = narrow.failing_keys(last)
            plan = with_jobs_kept(plan, lambda job: pace.key(job) in wanted)
        if changed is not None:
            plan = narrow.affected(project, plan, changed)
        if most is not None:
            past = store.manifests.newest(pace.PAST, terminal.note)
            plan = narrow.within_budget(plan, most, past)
        return plan

    return narrowed


def _nothing(call: RunCall, last: Manifest | None) -> str:
    """Why there is nothing to run."""
    from vv.run.narrowing import failing_records

    if last and failing_records(last):
        return (
            f"nothing to run: what failed is not selected; the last run: {last.provenance.command}"
        )
    if call.failed:
        return "nothing to run: nothing failed in the last run"
    if call.since:
        return f"nothing to run: no change since {call.since} can affect a result"
    return f"nothing to run: no job fits {call.budget}"
