"""Carries out a plan as one invocation: progress, output files, summary and report."""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING

from vv.base.files import write_output
from vv.cli import options
from vv.output import result_lines, terminal
from vv.output.progress import progress
from vv.plan.plan import Plan
from vv.plan.project import Project
from vv.records.manifest import Manifest, PrintedOutput
from vv.store.store import Store

if TYPE_CHECKING:
    from reports.beside import Beside
    from vv.records.job_record import Record
    from vv.run.limits import Limits

LATER = "vv report"  # the command that writes the report


def reuse_or_carry_out(
    project: Project, asked: tuple[object, ...], make_plan: Callable[[], Plan], limits: Limits
) -> Manifest:
    """Carry out a plan, or return the manifest of the same call if nothing has changed since.

    asked: frozen data from which the plan is made. The number of processes and the files to be
    written are not part of it, since results do not depend on them.
    """
    from vv.run import reuse

    if not _may_reuse(limits):
        return carry_out_with_progress(project, make_plan(), limits)
    store, before = Store(project.data()), _identity(project, asked, limits)
    known = reuse.recall(store, before)
    if known is not None:
        _note_unchanged(known.name)
        return reuse.of_this_commit(project, store, before, known, _command())
    manifest = carry_out_with_progress(project, make_plan(), limits)
    if _identity(project, asked, limits) == before:  # no file was edited meanwhile
        reuse.remember(store, before, manifest)
    return manifest


def earlier_output(
    project: Project, asked: tuple[object, ...], limits: Limits, required: tuple[str, ...]
) -> PrintedOutput | None:
    """The output of the same call, if nothing has changed since; else None."""
    from vv.run import reuse

    if not _may_reuse(limits):
        return None
    identity, store = _identity(project, asked, limits), Store(project.data())
    found = reuse.output_of(project, store, identity, report_folder(project), required)
    if found is None:
        return None
    _note_unchanged(found[0])
    return found[1]


def keep_output(
    project: Project, asked: tuple[object, ...], limits: Limits, name: str, printed: PrintedOutput
) -> None:
    """Store the final output of a call, so that the same call can print it again."""
    from vv.run import reuse

    if _may_reuse(limits):
        reuse.keep_output(Store(project.data()), _identity(project, asked, limits), name, printed)


def _may_reuse(limits: Limits) -> bool:
    from vv.run.limits import Timing

    return not (limits.fresh or limits.timing is Timing.NEW)


def _identity(project: Project, asked: tuple[object, ...], limits: Limits) -> str:
    from vv.run import reuse
    from vv.run.session import now_utc

    return reuse.identity(project, (*asked, limits.timing), now_utc().date(), limits.against)


def _note_unchanged(name: str) -> None:
    terminal.note(f"nothing has changed since {name}")


def carry_out_with_progress(
    project: Project,
    plan: Plan,
    limits: Limits,
    until: Callable[[Record], bool] | None = None,
    command: Sequence[str] = (),
) -> Manifest:
    """Carry out a plan and show the progress; returns the manifest.

    until: see `carry_out`. command: the words that past runs show; if none, the command line's.
    """
    from vv.run.session import carry_out

    with progress() as shown:
        return carry_out(project, plan, limits, shown, [*command] or _command(), until=until)


def _command() -> list[str]:
    """The command line in the form of a manifest."""
    return ["vv", *sys.argv[1:]]


def write_report(project: Project, manifest: Manifest) -> Path:
    """Write the report; returns its front page.

    A report that is already there and still belongs to the manifest is not written again.
    """
    from vv.run import reuse

    store, folder = Store(project.data()), report_folder(project)
    if not reuse.untouched(store, manifest.name, folder):
        report_writer(project).build(manifest, store, folder, report_extras(project, manifest))
        reuse.note_report(store, manifest.name, folder)
    return folder / "index.html"


def report_folder(project: Project) -> Path:
    """The folder in which commands that run cases write the report."""
    return project.data() / "report"


def write_records(project: Project, manifest: Manifest, json_file: Path | None) -> None:
    """Write the records if asked to."""
    if json_file:
        from vv.output.export import document

        write_output(json_file, document(manifest, Store(project.data())).encode())


def print_summary(project: Project, manifest: Manifest, report: str) -> None:
    """Print refusals, parameters without effect, counts, and where the report is."""
    result_lines.print_refusals(manifest.records)
    result_lines.print_inert(manifest.records)
    programs = options.named_files(project)
    result_lines.print_counts(manifest.records, report, programs, manifest.name)


def report_writer(project: Project) -> ModuleType:
    """The module that writes reports."""
    project.activate()
    from reports import html

    return html


def report_extras(project: Project, manifest: Manifest) -> Beside:
    """The data that a report shows beside the records: papers, and the inputs of codes."""
    from reports.beside import Beside
    from vv.insight.rows_of_run import rows_of_run
    from vv.plan.exact_numbers import with_exact_numbers
    from vv.plan.published import files, papers
    from vv.run.native_inputs import native_inputs

    known = with_exact_numbers(papers(project), project, files(project))
    rows = rows_of_run(known, project, manifest)
    return Beside(list(zip(known, rows, strict=True)), native_inputs(project))
