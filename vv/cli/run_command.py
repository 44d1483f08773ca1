"""The command that runs cases: `vv run`."""

from __future__ import annotations

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
    from vv.records.manifest import Manifest
    from vv.run.session import Limits
    from vv.store.store import Store

PAST = 10  # manifests that a budget looks at


@dataclass(frozen=True)
class Narrowing:
    """Options that select part of a plan: --failed, --since, --budget; false if none is given."""

    failed: bool
    since: str
    budget: str

    def __bool__(self) -> bool:
        return bool(self.failed or self.since or self.budget)


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
    codes: options.Codes = "*",
    require: options.Required = "",
    settings: options.Sets = None,
    level: options.Levels = Level.DEFAULT,
    rungs: options.Rungs = None,
    jobs: options.Jobs = 0,
    fresh: options.Fresh = False,
    timeout: options.Timeout = options.TIMEOUT,
    dry_run: Annotated[bool, typer.Option("--dry-run", help="Only list what would run.")] = False,
    json_file: options.JsonFile = None,
) -> None:
    """Run cases in codes and write the report.

    Exits with 0 even if results are wrong, which `vv gate` judges; non-zero if a code crashed,
    diverged, hung or is required and missing.
    """
    from vv.cli import invocation
    from vv.plan.plan import Options
    from vv.store.store import Store

    narrowing = Narrowing(failed, since, budget)
    if selection and everything:
        raise UsageError("name cases or say --all, not both")
    if not (selection or everything or narrowing):
        raise UsageError("name a case or say --all; `vv list` shows the cases")
    project, named = options.with_programs(find(), codes)
    store = Store(project.data())
    last = _last(store) if failed else None
    knobs = options.knobs(rungs) or (_rungs_that_failed(last) if last else ())
    chosen = Options(level, named, tuple(settings or ()), knobs)
    required = options.required(project, require)

    def make_plan() -> Plan:
        plan = options.plan_of(project, selection or [], chosen)
        return _narrowed(project, store, plan, last, narrowing)

    if dry_run:
        _list_jobs(project, store, make_plan(), fresh)
        return
    timed = everything and level is not Level.QUICK and not narrowing
    limits = _limits(jobs, timeout, fresh, timed)
    if narrowing:  # depends on past runs, which change with each
        plan = make_plan()
        if not plan.jobs:
            terminal.say(_nothing(narrowing))
            return
        manifest = invocation.carried_out(project, plan, limits)
    else:
        asked = "run", tuple(selection or ()), chosen
        manifest = invocation.answered(project, asked, make_plan, limits)
    _conclude(project, manifest, limits, json_file, required)


def _limits(jobs: int, timeout: float, fresh: bool, timed: bool) -> Limits:
    from vv.run.session import Limits, Timing

    timing = Timing.STORED if timed else Timing.NONE
    return Limits(options.workers(jobs), options.positive(timeout), fresh, timing)


def _conclude(
    project: Project,
    manifest: Manifest,
    limits: Limits,
    json_file: Path | None,
    required: tuple[str, ...],
) -> None:
    """Write the records and the report, say how it went, and exit with what could not run."""
    from vv.cli import invocation
    from vv.gate.judgement import RUN_BITS, record_findings
    from vv.output.result_lines import print_failures
    from vv.records.finding import bits

    report = invocation.reported(project, manifest, limits)
    invocation.print_summary(project, manifest, json_file, str(report))
    findings = record_findings(manifest.records, required)
    print_failures(findings)
    raise typer.Exit(bits(findings) & RUN_BITS)


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
    from vv.store.checkout import changed_since

    if last is not None:
        wanted = narrow.troubled(last)
        plan = with_jobs_kept(plan, lambda job: narrow.key(job) in wanted)
    if narrowing.since:
        plan = narrow.affected(project, plan, changed_since(project.root, narrowing.since))
    if narrowing.budget:
        past = store.newest(PAST, terminal.note)
        plan = narrow.within(plan, narrow.seconds(narrowing.budget), past)
    return plan


def _nothing(narrowing: Narrowing) -> str:
    if narrowing.failed:
        return "nothing to run: all did well in the last run"
    if narrowing.since:
        return f"nothing to run: no change since {narrowing.since} can affect a result"
    return f"nothing to run: no job fits {narrowing.budget}"
