"""The command that runs cases: `vv run`."""

from __future__ import annotations

from typing import Annotated, Any

import typer

from vv.ask import Knobs
from vv.base.errors import UsageError
from vv.case import Level
from vv.cli import options
from vv.cli.invocation import answered, carried_out, reported, tell
from vv.gate.judgement import RUN_BITS, record_findings
from vv.output import terminal
from vv.plan.plan import Options, Plan, with_jobs_kept
from vv.plan.project import Project, find
from vv.records.finding import bits
from vv.store.store import Store

PAST = 10  # manifests that a budget looks at


def run(
    selection: options.Selection = None,
    everything: Annotated[bool, typer.Option("--all", help="Every case, with timing.")] = False,
    failed: Annotated[
        bool, typer.Option("--failed", help="Only what did not do well in the last run.")
    ] = False,
    since: Annotated[
        str, typer.Option(metavar="REV", help="Only what changes since a commit can affect.")
    ] = "",
    budget: Annotated[
        str, typer.Option(metavar="60s", help="Only the most telling jobs that fit this time.")
    ] = "",
    codes: options.Codes = "*",
    require: options.Required = "",
    settings: options.Sets = None,
    level: options.Levels = Level.DEFAULT,
    rungs: options.Rungs = None,
    jobs: options.Jobs = 0,
    fresh: options.Fresh = False,
    timeout: options.Timeout = options.TIMEOUT,
    dry_run: Annotated[bool, typer.Option("--dry-run", help="Say what would run.")] = False,
    json_file: options.JsonFile = None,
) -> None:
    """Run cases in codes and write the report; exits non-zero if something could not run."""
    narrowed = bool(failed or since or budget)
    if selection and everything:
        raise UsageError("name cases or say --all, not both")
    if not (selection or everything or narrowed):
        raise UsageError("name a case or say --all; `vv list` shows the cases")
    project = find()
    store = Store(project.data())
    last = _last(store) if failed else None
    knobs = options.knobs(rungs) or (_rungs_that_failed(last) if last else ())
    chosen = Options(level, options.codes(codes), tuple(settings or ()), knobs)
    required = options.split(require)
    options.known(project, required)

    def make_plan() -> Plan:
        plan = options.plan_of(project, selection or [], chosen)
        return _narrowed(project, store, plan, last, since, budget)

    if dry_run:
        _list_jobs(project, store, make_plan(), fresh)
        return
    from vv.run.session import Limits, Timing

    timing = everything and level is not Level.QUICK and not narrowed
    limits = Limits(
        options.workers(jobs),
        options.positive(timeout),
        fresh,
        Timing.STORED if timing else Timing.NONE,
    )
    if narrowed:  # depends on past runs, which change with each
        plan = make_plan()
        if not plan.jobs:
            terminal.say(_nothing(failed, since, budget))
            return
        manifest = carried_out(project, plan, limits)
    else:
        asked = "run", tuple(selection or ()), chosen
        manifest = answered(project, asked, make_plan, limits)
    tell(project, manifest, json_file, str(reported(project, manifest, limits)))
    findings = record_findings(manifest["records"], required)
    terminal.print_failures(findings)
    raise typer.Exit(bits(findings) & RUN_BITS)


def _list_jobs(project: Project, store: Store, plan: Plan, fresh: bool) -> None:
    """Say of each job whether it would run or is stored."""
    from vv.plan import keys

    found = {} if fresh else keys.run_keys(project, plan)
    terminal.print_jobs(plan, {n for n, key in found.items() if store.has_run(key)})


def _last(store: Store) -> dict[str, Any]:
    names = store.manifests()
    if not names:
        raise UsageError("--failed: there is no last run")
    return store.manifest(names[-1])


def _rungs_that_failed(last: dict[str, Any]) -> tuple[Knobs, ...]:
    """The knobs of what did not do well: they need not be of the level asked for."""
    from vv.run.narrowing import troubled_records

    return tuple(dict.fromkeys(Knobs(**record["rung"]) for record in troubled_records(last)))


def _narrowed(
    project: Project,
    store: Store,
    plan: Plan,
    last: dict[str, Any] | None,
    since: str,
    budget: str,
) -> Plan:
    from vv.run import narrowing
    from vv.store.checkout import changed_since

    if last is not None:
        wanted = narrowing.troubled(last)
        plan = with_jobs_kept(plan, lambda job: narrowing.key(job) in wanted)
    if since:
        plan = narrowing.affected(project, plan, changed_since(project.root, since))
    if budget:
        plan = narrowing.within(plan, narrowing.seconds(budget), store.newest(PAST))
    return plan


def _nothing(failed: bool, since: str, budget: str) -> str:
    if failed:
        return "nothing to run: all did well in the last run"
    if since:
        return f"nothing to run: no change since {since} can affect a result"
    return f"nothing to run: no job fits {budget}"
