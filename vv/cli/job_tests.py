"""Presents jobs as pytest tests: the first test runs all jobs, and each test judges one."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from vv.base.errors import UsageError
from vv.case import Level
from vv.cli import options
from vv.plan.project import Project, find

if TYPE_CHECKING:
    from vv.plan.plan import Plan
    from vv.records.finding import Finding
    from vv.records.job_record import Record
    from vv.records.manifest import Manifest
    from vv.run.limits import Limits

REPORTS = pytest.StashKey[list[Path]]()


class _Silent:
    """Shows no progress, since pytest has a display of its own."""

    def begin(self, jobs: int) -> None:
        """Say nothing."""

    def done(self, record: Record) -> None:
        """Say nothing."""

    def timing(self, settings: int) -> None:
        """Say nothing."""


@dataclass(eq=False)
class Invocation:
    """The jobs that the options of pytest select; the first test runs all of them."""

    config: pytest.Config
    project: Project
    plan: Plan
    limits: Limits
    manifest: Manifest | None = None

    def answered(self) -> Manifest:
        """The manifest of all jobs; the first call runs them and writes the report."""
        if self.manifest is None:
            from vv.cli import invocation
            from vv.run.session import carry_out

            command = ["pytest", *self.config.invocation_params.args]
            words = [str(word) for word in command]
            self.manifest = carry_out(self.project, self.plan, self.limits, _Silent(), words)
            report = invocation.write_report(self.project, self.manifest)
            self.config.stash.setdefault(REPORTS, []).append(report)
        return self.manifest

    def lost(self) -> set[str]:
        """The codes named by a file none of whose jobs ran."""
        from vv.records.reading import tried

        took = {record.code for record in filter(tried, self.answered().records)}
        return {*options.named_files(self.project)} - took

    def again(self, finding: Finding, record: Record) -> str:
        """The line with the command that runs a failed job again; empty if there is none."""
        from vv.output.finding_lines import rerun
        from vv.records.reading import rung

        at = {(record.case, record.variant, record.label, rung(record)): record}
        level = Level(self.config.getoption("--vv-level"))
        command = rerun(finding, at, level, options.named_files(self.project))
        return f"again: {command}" if command else ""


class JobTest(pytest.Item):
    """A test of a job: it passes, fails with the findings of the gate, or is skipped."""

    def __init__(self, *, invocation: Invocation, number: int, **named: Any) -> None:
        super().__init__(**named)
        self.invocation, self.number = invocation, number

    def runtest(self) -> None:
        """Judge the job as the gate does."""
        from vv.records.reading import tried

        manifest = self.invocation.answered()
        record = manifest.records[self.number]
        if not tried(record):
            said = f"{record.status.value}: {record.reason}"
            if record.code in self.invocation.lost():
                said = f"{record.code}: required, but none of its jobs ran; {said}"
                pytest.fail(said, pytrace=False)
            pytest.skip(said)
        red = [finding for finding in _findings(manifest, record) if finding.red]
        if red:
            lines = [*(finding.text for finding in red), self.invocation.again(red[0], record)]
            pytest.fail("\n".join(filter(None, lines)), pytrace=False)

    def reportinfo(self) -> tuple[Path, None, str]:
        """The case's file, and the title under which pytest shows a failure.

        The title must not end in the name of the node: pytest would write `::` for the decimal
        points in it.
        """
        case = self.invocation.plan.jobs[self.number].case
        return self.invocation.project.case_file(case), None, f"vv: {self.name}"


def tests(session: pytest.Session) -> Iterator[JobTest]:
    """A test for each job that the options select; raises pytest.UsageError for bad ones."""
    option = session.config.getoption
    try:
        invocation = _invocation(session.config, option("--vv"), option("--vv-code"))
    except (UsageError, ValueError) as error:
        raise pytest.UsageError(f"--vv: {error}") from error
    for number, job in enumerate(invocation.plan.jobs):
        yield JobTest.from_parent(
            session, name=job.label, nodeid=f"vv::{job.label}", invocation=invocation, number=number
        )


def reports(config: pytest.Config) -> Sequence[Path]:
    """The front pages of the reports that were written."""
    return config.stash.get(REPORTS, [])


def _invocation(config: pytest.Config, selection: list[str], codes: str) -> Invocation:
    from vv.plan.plan import Options
    from vv.run.limits import Limits

    option = config.getoption
    project, named = options.with_programs(find(), codes)
    level, rungs = Level(option("--vv-level")), options.knobs(option("--vv-rung"))
    chosen = Options(level, named, tuple(option("--vv-set")), rungs)
    plan = options.plan_of(project, selection, chosen)
    limits = Limits(options.workers(0), options.positive(config.getoption("--vv-timeout")))
    return Invocation(config, project, plan, limits)


def _findings(manifest: Manifest, record: Record) -> Iterator[Finding]:
    """The gate's findings on one record."""
    from vv.gate.judgement import judgement
    from vv.records.reading import rung

    own = (record.case, record.variant, record.label, rung(record))
    for finding in judgement(manifest):
        if (finding.case, finding.variant, finding.label, finding.rung) == own:
            yield finding
