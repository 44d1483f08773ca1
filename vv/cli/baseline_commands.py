"""The commands that store results with the cases: `vv accept` (baselines) and `vv record`."""

from __future__ import annotations

import contextlib
import functools
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from vv.base.errors import UsageError
from vv.base.files import write_whole
from vv.case import Level
from vv.cli import options
from vv.output import terminal
from vv.plan.project import Project, find

if TYPE_CHECKING:
    from vv.plan.plan import Job, Plan
    from vv.records.accepted import Acceptance, Place
    from vv.records.job_record import Record
    from vv.records.manifest import Manifest
    from vv.records.recorded import RecordedFile

Reason = Annotated[
    str, typer.Option("--reason", metavar="TEXT", help="Why these results are right.")
]


def accept(
    case: Annotated[str, typer.Argument(metavar="CASE", help="The case whose results to accept.")],
    reason: Reason = "",
    timing: Annotated[
        bool, typer.Option("--timing", help="Time the codes anew and accept their speeds too.")
    ] = False,
    dry_run: Annotated[bool, typer.Option("--dry-run", help="Only show the difference.")] = False,
    paper: Annotated[
        bool, typer.Option("--paper", help="Run the variants that begin at level paper too.")
    ] = False,
) -> None:
    """Show what changed since the baseline of a case, and make the present results the new one."""
    from vv.gate.acceptance import acceptable
    from vv.output import result_lines
    from vv.records.reading import tried

    project = find()
    _require_own_cases(project)
    plan = _levels_of(project, case, "*", paper)
    if not (reason.strip() or dry_run):
        raise UsageError('--reason is missing; say why the results are right: --reason "..."')
    manifest = _run(project, plan, timing)
    result_lines.print_difference(manifest, case)
    result_lines.print_unacceptable(r for r in manifest.records if tried(r) and not acceptable(r))
    if not dry_run:
        nudged = _run_nudged(project, plan, manifest)
        later = _later_results(project, case, plan)
        _write_baseline(project, case, manifest, nudged, reason.strip(), later)


def _run_nudged(project: Project, plan: Plan, manifest: Manifest) -> list[Record]:
    """Run what ran again, once for each nudge of the last digits of its scene."""
    from vv.output.progress import progress
    from vv.plan.nudged import NUDGES, nudged_plan
    from vv.plan.plan import with_jobs_kept
    from vv.records.reading import ran
    from vv.run.limits import Limits
    from vv.run.session import records_alone

    finished = {(record.variant, record.label) for record in filter(ran, manifest.records)}
    due = with_jobs_kept(plan, lambda job: (job.variant, f"{job.code}/{job.scheme}") in finished)
    limits, found = Limits(options.workers(0), options.TIMEOUT), []
    for nudge in NUDGES:
        with progress() as shown:
            found += records_alone(project, nudged_plan(due, nudge), limits, shown)
    return found


def _run(project: Project, plan: Plan, timing: bool = False) -> Manifest:
    """Run the jobs whose results are to be stored, and print the summary."""
    from vv.cli import invocation
    from vv.run.limits import Limits, Timing

    when = Timing.NEW if timing else Timing.NONE
    limits = Limits(options.workers(0), options.TIMEOUT, timing=when)
    manifest = invocation.carry_out_with_progress(project, plan, limits)
    invocation.print_summary(project, manifest, invocation.LATER)
    return manifest


def _write_baseline(
    project: Project,
    case: str,
    manifest: Manifest,
    nudged: list[Record],
    reason: str,
    later: frozenset[str],
) -> None:
    """Write the case's new baseline and the answers of its schemes, and print where they are."""
    from vv.gate import acceptance, answers
    from vv.gate.all_checks import baseline_of, baselines_of
    from vv.records.sorted_text import render

    new = acceptance.accepted(
        case,
        baseline_of(project, case),
        manifest.records,
        _acceptance(manifest, reason),
        manifest.external(),
        later,
        nudged,
    )
    path = baselines_of(project) / f"{case}.json"
    text = render(new).encode()
    if path.is_file() and path.read_bytes() == text:
        terminal.say(f"{path} is unchanged: the reason is not recorded")
    else:
        write_whole(path, text)
        terminal.say(f"{len(new.results)} results in {path}")
    terminal.say(f"which schemes run it, and why others refuse, in {answers.accept(project, case)}")


def record(
    selection: options.Selection = None,
    codes: Annotated[
        str,
        typer.Option(
            "--codes", metavar="CODES", help="External codes, CODE,...; all if not given."
        ),
    ] = "*",
) -> None:
    """Store results of external codes, to show them where a code is not installed."""
    from vv.gate import recorded
    from vv.gate.all_checks import recorded_of
    from vv.plan.plan import with_jobs_kept
    from vv.store.store import Store

    project = find()
    _require_own_cases(project)
    for part, mark in (*((s, ":") for s in selection or ()), (codes, "/")):
        if mark in part:
            raise UsageError(f"record takes whole cases and whole codes, not '{part}'")
    if not selection and codes == "*":
        raise UsageError("name the cases or --codes to record")
    plan = _levels_of(project, selection, codes)
    external = {code for code, found in plan.found.items() if found.files}
    plan = with_jobs_kept(plan, lambda job: job.code in external)
    if not plan.jobs:
        raise UsageError(f"'{codes}' names no external code that is installed here")
    manifest = _run(project, plan)
    series = Store(project.data()).series_of(manifest.records)
    empty = _without_results(manifest)
    for path in recorded.write_recorded(recorded_of(project), manifest.records, series, empty):
        terminal.say(str(path))


def _without_results(manifest: Manifest) -> dict[str, RecordedFile]:
    """The head of a recorded file for each external code, without results."""
    from vv.records.recorded import RecordedFile

    made = manifest.provenance
    return {
        code: RecordedFile(
            code=code,
            case="",
            version=found.version,
            utc=made.utc,
            commit=made.commit,
            dirty=made.dirty,
            machine=_place(manifest),
            executables={Path(path).name: digest for path, digest in found.files.items()},
        )
        for code, found in manifest.codes.items()
        if found.files
    }


def _levels_of(
    project: Project, selection: list[str] | str | None, codes: str, paper: bool = False
) -> Plan:
    """The jobs of the levels quick and default, each once.

    paper: also those at level paper of the variants that begin there.
    """
    from vv.plan.plan import EmptyPlanError, Options, merge_plans, with_jobs_kept

    names = [selection] if isinstance(selection, str) else selection or []
    levels = (Level.QUICK, Level.DEFAULT, Level.PAPER)[: 2 + paper]
    if isinstance(selection, str) and selection not in project.case_names():
        raise UsageError(f"accept takes the name of one case, not '{selection}'")
    plans = []
    for level in levels:
        with contextlib.suppress(EmptyPlanError):  # all variants may begin at a higher level
            plan = options.plan_of(project, names, Options(level, options.codes(codes)))
            if level is Level.PAPER:
                plan = with_jobs_kept(plan, lambda job: job.variant in _later(project, job.case))
            plans.append(plan)
    if not plans:
        raise UsageError(f"no scheme of {', '.join(names)} runs at level {levels[-1].value}")
    return functools.reduce(merge_plans, plans)


def _later(project: Project, case: str) -> frozenset[str]:
    """The variants of a case that begin at level paper."""
    variants = project.load_case(case).variants
    return frozenset(one.name for one in variants if not one.runs_at(Level.DEFAULT))


def _later_results(project: Project, case: str, plan: Plan) -> frozenset[str]:
    """The names of the results of a case that level paper has and a plan does not."""
    from vv.plan.plan import Options

    whole = options.plan_of(project, [case], Options(Level.PAPER))
    return frozenset(map(_name_of_result, whole.jobs)) - frozenset(map(_name_of_result, plan.jobs))


def _name_of_result(job: Job) -> str:
    """The name of a job's result in a baseline."""
    from vv.gate.baseline import named
    from vv.records.reading import in_words

    return named(job.variant, f"{job.code}/{job.scheme}", in_words(job.ask.knobs))


def _require_own_cases(project: Project) -> None:
    if project.bundled:
        raise UsageError("cannot change the cases that came with vv; work in a project of your own")


def _acceptance(manifest: Manifest, reason: str) -> Acceptance:
    """The acceptance of the results of an invocation."""
    from vv.records.accepted import Acceptance

    provenance = manifest.provenance
    versions = dict(provenance.versions)
    versions |= {code: found.version for code, found in manifest.codes.items()}
    return Acceptance(
        commit=provenance.commit,
        dirty=provenance.dirty,
        machine=_place(manifest),
        reason=reason,
        utc=provenance.utc,
        versions={name: version for name, version in versions.items() if version},
    )


def _place(manifest: Manifest) -> Place:
    from vv.records.accepted import Place

    machine = manifest.provenance.machine
    return Place(machine.processor, machine.system)
