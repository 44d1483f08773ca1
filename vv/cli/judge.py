"""The commands that judge, and those that write down what to judge by: gate, accept, record."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Annotated, Any

import typer

from vv import screen
from vv.cli import options
from vv.cli.invocation import answered, carried_out
from vv.files import write
from vv.finding import Finding, bits
from vv.gate import judgement
from vv.plan import Options, Plan, joined, restricted
from vv.project import Project, find
from vv.settings import UsageError
from vv.store import Store
from vv.study import Level

Reason = Annotated[
    str, typer.Option("--reason", metavar="TEXT", help="Why these results are right.")
]


def gate(
    selection: options.Selection = None,
    codes: options.Codes = "*",
    require: options.Required = "",
    level: options.Levels = Level.QUICK,
    against: Annotated[
        Path | None,
        typer.Option(
            metavar="DIR",
            help="Baselines that every result must be in; if not given, those of the project, "
            "where a result without one is only noted.",
        ),
    ] = None,
    timing: Annotated[
        bool, typer.Option("--timing", help="Time anew and enforce speed too.")
    ] = False,
    fresh: options.Fresh = False,
    jobs: options.Jobs = 0,
    timeout: options.Timeout = options.TIMEOUT,
    junit: Annotated[Path | None, typer.Option(metavar="FILE", help="Write JUnit XML.")] = None,
    markdown: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Write a summary for a pull request.")
    ] = None,
    json_file: options.JsonFile = None,
) -> None:
    """Run what is not stored and judge it: every exit bit counts."""
    from vv.session import Limits, Timing

    project = find()
    if against is not None and not against.is_dir():
        raise UsageError(f"--against {against}: there is no such folder")
    required = options.split(require)
    options.known(project, required)
    chosen = Options(level, options.codes(codes))

    def plan() -> Plan:
        return options.plan_of(project, selection or [], chosen)

    when = Timing.NEW if timing else Timing.LAST
    limits = Limits(options.workers(jobs), options.positive(timeout), fresh, when, against)
    asked = "gate", tuple(selection or ()), chosen
    manifest = answered(project, asked, plan, limits, json_file)
    findings = judgement(manifest, required)
    _write_outputs(project, manifest, findings, junit, markdown)
    screen.print_findings(findings)
    raise typer.Exit(bits(findings))


def _write_outputs(
    project: Project,
    manifest: dict[str, Any],
    findings: list[Finding],
    junit: Path | None,
    markdown: Path | None,
) -> None:
    if junit:
        from vv.junit import write_junit

        write_junit(junit, manifest, findings)
    if markdown:
        from vv.markdown import write_markdown

        write_markdown(markdown, manifest, findings)
    if os.environ.get("GITHUB_ACTIONS") == "true":
        from vv.markdown import workflow_commands

        files = {
            case: project.case_file(case).relative_to(project.root).as_posix()
            for case in manifest["cases"]
        }
        for line in workflow_commands(findings, files):
            screen.say(line)


def accept(
    case: Annotated[str, typer.Argument(metavar="CASE", help="The case whose results to accept.")],
    reason: Reason = "",
    timing: Annotated[
        bool, typer.Option("--timing", help="Time anew and accept the ratios too.")
    ] = False,
    dry_run: Annotated[bool, typer.Option("--dry-run", help="Only show the difference.")] = False,
) -> None:
    """Show what moved since a case's baseline, and make the present results the new one."""
    from vv import acceptance, baseline
    from vv.judging import baselines_of
    from vv.session import Limits, Timing

    project = find()
    _writable(project)
    if not (reason.strip() or dry_run):
        raise UsageError('--reason is missing; say why the results are right: --reason "..."')
    plan = _both_levels(project, case, "*")
    when = Timing.NEW if timing else Timing.NONE
    manifest = carried_out(project, plan, Limits(options.workers(0), options.TIMEOUT, timing=when))
    screen.print_difference(manifest, case)
    refused = [r for r in manifest["records"] if not acceptance.acceptable(r)]
    screen.print_unacceptable(refused)
    if dry_run:
        return
    folder = baselines_of(project)
    external = {code for code, told in manifest["codes"].items() if told["files"]}
    document = acceptance.accepted(
        case,
        baseline.read(folder, case),
        manifest["records"],
        {"reason": reason.strip(), **_circumstances(manifest)},
        external,
    )
    path = folder / f"{case}.json"
    write(path, baseline.render(document).encode())
    screen.say(f"{len(document['results'])} results in {path}")


def record(
    selection: options.Selection = None,
    codes: Annotated[
        str, typer.Option("--codes", metavar="CODES", help="External codes; all if not given.")
    ] = "*",
) -> None:
    """Write down results of external codes, to be shown where these are not installed."""
    from vv import recorded
    from vv.judging import recorded_of
    from vv.session import Limits

    project = find()
    _writable(project)
    plan = _both_levels(project, selection, codes)
    external = {code for code, found in plan.found.items() if found.files}
    plan = restricted(plan, lambda job: job.code in external)
    if not plan.jobs:
        raise UsageError(f"'{codes}' names no external code that is installed here")
    manifest = carried_out(project, plan, Limits(options.workers(0), options.TIMEOUT))
    told = _circumstances(manifest)
    circumstances = {
        code: {
            **{name: told[name] for name in ("utc", "commit", "dirty", "machine")},
            "version": manifest["codes"][code]["version"],
            "executables": {
                Path(path).name: digest for path, digest in manifest["codes"][code]["files"].items()
            },
        }
        for code in external & set(manifest["codes"])
    }
    series = Store(project.data()).series
    for path in recorded.keep(recorded_of(project), manifest["records"], series, circumstances):
        screen.say(str(path))


def _both_levels(project: Project, selection: list[str] | str | None, codes: str) -> Plan:
    """What the levels quick and default run, each job once."""
    names = [selection] if isinstance(selection, str) else selection or []
    levels = (Level.QUICK, Level.DEFAULT)
    if isinstance(selection, str) and selection not in project.case_names():
        raise UsageError(f"accept takes the name of one case, not '{selection}'")
    quick, default = (
        options.plan_of(project, names, Options(level, options.codes(codes))) for level in levels
    )
    return joined(quick, default)


def _writable(project: Project) -> None:
    if project.bundled:
        raise UsageError("the cases that came with vv stay as they are; copy them to a project")


def _circumstances(manifest: dict[str, Any]) -> dict[str, Any]:
    """What a baseline says of where its results come from."""
    told = manifest["provenance"]
    versions = {**told["versions"]}
    versions |= {code: found["version"] for code, found in manifest["codes"].items()}
    machine = {name: told["machine"][name] for name in ("processor", "system")}
    return {
        "utc": told["utc"],
        "commit": told["commit"],
        "dirty": told["dirty"],
        "machine": machine,
        "versions": {name: version for name, version in versions.items() if version},
    }
