"""The command that judges results: `vv gate`."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from vv.base.errors import UsageError
from vv.case import Level
from vv.cli import options
from vv.cli.option_class import takes
from vv.output import terminal
from vv.plan.project import Project, find

if TYPE_CHECKING:
    from vv.plan.plan import Plan
    from vv.records.finding import Finding
    from vv.records.manifest import Manifest
    from vv.run.limits import Limits


@dataclass(frozen=True)
class GateCall:
    """The arguments of `vv gate`."""

    selection: options.Selection = None
    codes: options.Codes = "*"
    require: options.Required = ""
    level: options.Levels = Level.QUICK
    against: Annotated[
        Path | None,
        typer.Option(
            metavar="DIR",
            help="Folder of baselines; a result without a baseline is then an error. "
            "Default: the project's baselines, where such a result is only noted.",
        ),
    ] = None
    timing: Annotated[
        bool, typer.Option("--timing", help="Time the codes anew and judge speed too.")
    ] = False
    fresh: options.Fresh = False
    jobs: options.Jobs = 0
    timeout: options.Timeout = options.TIMEOUT
    junit: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="Write JUnit XML.", callback=options.writable),
    ] = None
    markdown: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE", help="Write a summary for a pull request.", callback=options.writable
        ),
    ] = None
    json_file: options.JsonFile = None


@takes(GateCall)
def gate(call: GateCall) -> None:
    """Run what is not stored, judge all results, and report failures in the exit status.

    `vv report` writes the report of it.
    """
    from vv.cli import invocation
    from vv.gate.judgement import judgement
    from vv.output.result_lines import print_findings
    from vv.plan.plan import Options
    from vv.records.finding import bits

    project, named = options.with_programs(find(), call.codes)
    if call.against is not None and not call.against.is_dir():
        raise UsageError(f"--against {call.against}: there is no such folder")
    required = options.required(project, call.require)
    chosen = Options(call.level, named)

    def plan() -> Plan:
        return options.plan_of(project, call.selection or [], chosen)

    asked = "gate", tuple(call.selection or ()), chosen
    manifest = invocation.reuse_or_carry_out(project, asked, plan, _limits(call))
    invocation.write_records(project, manifest, call.json_file)
    invocation.print_summary(project, manifest, invocation.LATER)
    findings = judgement(manifest, required)
    _write_outputs(project, manifest, findings, call)
    print_findings(findings, manifest.records, call.level, options.named_files(project), manifest)
    raise typer.Exit(bits(findings))


def _limits(call: GateCall) -> Limits:
    from vv.run.limits import Limits, Timing

    timing = Timing.NEW if call.timing else Timing.LAST
    workers, timeout = options.workers(call.jobs), options.positive(call.timeout)
    return Limits(workers, timeout, call.fresh, timing, call.against)


def _write_outputs(
    project: Project, manifest: Manifest, findings: list[Finding], call: GateCall
) -> None:
    if call.junit:
        from vv.output.junit import write_junit

        write_junit(call.junit, manifest, findings)
    if call.markdown:
        from vv.output.markdown import write_markdown

        write_markdown(call.markdown, manifest, findings)
    if os.environ.get("GITHUB_ACTIONS") == "true":
        from vv.output.markdown import workflow_commands

        files = {
            case: os.path.relpath(project.case_file(case), project.root) for case in manifest.cases
        }
        for line in workflow_commands(findings, files):
            terminal.say(line)
