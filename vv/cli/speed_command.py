"""The command that shows the cost of accuracy: `vv speed`."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from vv.base.errors import UsageError
from vv.base.files import write_output
from vv.case import Level
from vv.cli import options
from vv.cli.option_class import takes
from vv.output.terminal import say
from vv.plan.project import Project, find

if TYPE_CHECKING:
    from vv.plan.plan import Job, Plan
    from vv.records.manifest import Manifest


@dataclass(frozen=True)
class SpeedCall:
    """The arguments of `vv speed`."""

    selection: options.Selection = None
    codes: options.Codes = "*"
    level: options.Levels = Level.DEFAULT
    fresh: options.Fresh = False
    jobs: options.Jobs = 0
    timeout: options.Timeout = options.TIMEOUT
    json_file: Annotated[
        Path | None,
        typer.Option(
            "--json",
            metavar="FILE",
            help="Write all that is shown, as JSON.",
            callback=options.writable,
        ),
    ] = None
    scaling: Annotated[
        int | None,
        typer.Option(
            "--scaling",
            metavar="N",
            help="Show instead the cost per sphere and step, from 100 spheres up to this many.",
        ),
    ] = None


@takes(SpeedCall)
def speed(call: SpeedCall) -> None:
    """Time cases, and show the CPU time that each code needs to reach a given error.

    At level paper everything selected is timed, which takes minutes. `--scaling 10000` takes
    seconds, `--scaling 1000000` minutes.
    """
    if call.scaling is not None:
        if call.selection:
            raise UsageError("--scaling uses its own scene; name no case with it")
        _scale(call.codes, call.scaling, call.json_file)
        return
    from vv.cli import invocation
    from vv.gate.judgement import RUN_BITS, exit_bits
    from vv.plan.plan import Options
    from vv.run.limits import Limits, Timing

    project, named = options.with_programs(find(), call.codes)
    chosen = Options(call.level, named)

    def make_plan() -> Plan:
        whole = options.plan_of(project, call.selection or [], chosen)
        return _timed_part(whole, call)

    workers, timeout = options.workers(call.jobs), options.positive(call.timeout)
    limits = Limits(workers, timeout, call.fresh, Timing.STORED)
    asked = "speed", tuple(call.selection or ()), chosen
    manifest = invocation.reuse_or_carry_out(project, asked, make_plan, limits)
    invocation.print_summary(project, manifest, invocation.LATER)
    _show(project, manifest, bool(call.selection), call.json_file)
    raise typer.Exit(exit_bits(manifest.records) & RUN_BITS)


def _timed_part(plan: Plan, call: SpeedCall) -> Plan:
    """The jobs to run: all selected ones, or, if none is selected, the variants that are timed."""
    from vv.plan.plan import with_jobs_kept

    if call.level is Level.PAPER:
        plan = dataclasses.replace(plan, jobs=tuple(_all_timed(plan)))
    if call.selection:
        return plan
    timed = {(job.case, job.variant) for job in plan.jobs if job.timed}
    if not timed:
        raise UsageError("no selected variant is timed at this level; --level paper times all")
    return with_jobs_kept(plan, lambda job: (job.case, job.variant) in timed)


def _scale(codes: str, largest: int, json_file: Path | None) -> None:
    """Measure how costs grow with the number of spheres; print each size when measured."""
    from vv.plan.selection import choose_schemes, named_adapters
    from vv.records import codec
    from vv.scaling import scaling_table
    from vv.scaling.measured import FEWEST, can_step, costs_by_size, label

    if largest < FEWEST:
        raise UsageError(f"--scaling {largest}: it starts at {FEWEST} spheres")
    project, named = options.with_programs(find(), codes)
    adapters = named_adapters(project, named)
    every = {name: one for name, one in adapters.items() if one.found().installed}
    default = [f"{name}/{one.schemes[0].name}" for name, one in every.items()]
    chosen = [
        (code, scheme)
        for code, scheme in choose_schemes(every, [p for p in named if "/" in p] or default)
    ]
    labels, found = [label(*one) for one in chosen if can_step(*one)], []
    say(*scaling_table.heading(labels))
    for size in costs_by_size(chosen, largest):
        found.append(size)
        say(scaling_table.row(size, labels))
    say(*scaling_table.notes(found))
    if json_file:
        write_output(json_file, codec.render(scaling_table.document(found)).encode())


def _show(project: Project, manifest: Manifest, selected: bool, json_file: Path | None) -> None:
    """Print the costs of errors, and write them to a file if one is named."""
    from vv.insight.accuracy_cost import TARGETS, comparisons
    from vv.insight.effort import efforts, untimed
    from vv.output import speed_text
    from vv.output.cost_document import document

    every, rest = efforts(manifest), untimed(manifest)
    compared = comparisons(every, TARGETS)
    cases = {record.case for record in manifest.records}
    left = [] if selected else [name for name in project.case_names() if name not in cases]
    for line in (
        *speed_text.tables(every),
        *(f"not timed, it failed: {name}" for name in manifest.untimed),
        *speed_text.profiles(every),
        *speed_text.indicative(rest),
        *speed_text.whole(manifest.records),
        *speed_text.beside(left),
    ):
        say(*line.split("\n"))
    if json_file:
        write_output(json_file, document(every, rest, compared).encode())


def _all_timed(plan: Plan) -> Iterator[Job]:
    """The jobs, all timed; variants without rungs to be timed use those of the default level."""
    own = {(job.case, job.variant) for job in plan.jobs if job.timed}
    for job in plan.jobs:
        place = job.case, job.variant
        rungs = [] if place in own else plan.trials[place].study.rungs[Level.DEFAULT]
        knobs = job.ask.knobs
        wanted = any(knobs.dt in (None, rung.dt) and knobs.kn in (None, rung.kn) for rung in rungs)
        yield dataclasses.replace(job, timed=job.timed or wanted)
