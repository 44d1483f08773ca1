"""The command that says what accuracy costs: `vv speed`."""

from __future__ import annotations

import dataclasses
import json
import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Annotated, Any

import typer

from vv.base.errors import UsageError
from vv.base.files import write_output
from vv.case import Level
from vv.cli import options, speed_text
from vv.cli.invocation import LATER, answered, tell
from vv.gate.judgement import RUN_BITS, exit_bits
from vv.insight.accuracy_cost import TARGETS, Duel, duels, profile, reach
from vv.insight.effort import Effort, efforts, untimed
from vv.output.terminal import say
from vv.plan.plan import Job, Options, Plan, with_jobs_kept
from vv.plan.project import find


def speed(
    selection: options.Selection = None,
    codes: options.Codes = "*",
    level: options.Levels = Level.DEFAULT,
    fresh: options.Fresh = False,
    jobs: options.Jobs = 0,
    timeout: options.Timeout = options.TIMEOUT,
    json_file: Annotated[
        Path | None, typer.Option("--json", metavar="FILE", help="Write all that is shown.")
    ] = None,
) -> None:
    """Time the cases that ask for it, and say what an error costs in each code.

    At level paper all that is selected is timed, which takes minutes.
    """
    from vv.run.session import Limits, Timing

    project = find()
    chosen = Options(level, options.codes(codes))

    def make_plan() -> Plan:
        whole = options.plan_of(project, selection or [], chosen)
        if level is Level.PAPER:
            whole = dataclasses.replace(whole, jobs=tuple(_all_timed(whole)))
        timed = {(job.case, job.variant) for job in whole.jobs if job.timed}
        if selection:
            return whole
        if not timed:
            raise UsageError("nothing is timed at this level; --level paper times all there is")
        return with_jobs_kept(whole, lambda job: (job.case, job.variant) in timed)

    limits = Limits(options.workers(jobs), options.positive(timeout), fresh, Timing.STORED)
    asked = "speed", tuple(selection or ()), chosen
    manifest = answered(project, asked, make_plan, limits)
    tell(project, manifest, None, LATER)
    every, rest = efforts(manifest), untimed(manifest)
    fights = duels(every, TARGETS)
    failed = [f"not timed, it failed: {name}" for name in manifest["untimed"]]
    cases = {record["case"] for record in manifest["records"]}
    left = [] if selection else [name for name in project.case_names() if name not in cases]
    for line in (
        *speed_text.tables(every),
        *failed,
        *speed_text.fought(fights),
        *(speed_text.profiles(every) if every else ()),
        *speed_text.indicative(rest),
        *speed_text.beside(left),
    ):
        say(line)
    if json_file:
        document = _document(every, rest, fights)
        write_output(json_file, json.dumps(document, allow_nan=False).encode())
    raise typer.Exit(exit_bits(manifest["records"]) & RUN_BITS)


def _all_timed(plan: Plan) -> Iterator[Job]:
    """The jobs, timed at default's rungs in variants that name no rungs to be timed."""
    own = {(job.case, job.variant) for job in plan.jobs if job.timed}
    for job in plan.jobs:
        place = job.case, job.variant
        rungs = [] if place in own else plan.trials[place].study.rungs[Level.DEFAULT]
        given = [name for name, value in vars(job.ask.knobs).items() if value]
        wanted = any(
            all(getattr(rung, name) == getattr(job.ask.knobs, name) for name in given)
            for rung in rungs
        )
        yield dataclasses.replace(job, timed=job.timed or wanted)


def _document(
    every: Sequence[Effort], rest: Sequence[Effort], fights: Sequence[Duel]
) -> dict[str, Any]:
    """All of it as plain data, without infinities."""
    return {
        "targets": list(TARGETS),
        "efforts": [
            {
                **dataclasses.asdict(one),
                "reach": {f"{t:g}": dataclasses.asdict(reach(one, t)) for t in TARGETS},
            }
            for one in every
        ],
        "indicative": [dataclasses.asdict(one) for one in rest],
        "duels": [dataclasses.asdict(one) for one in fights],
        "profiles": {
            f"{t:g}": {
                name: [r if math.isfinite(r) else None for r in ratios]
                for name, ratios in profile(every, t).items()
            }
            for t in TARGETS
        },
    }
