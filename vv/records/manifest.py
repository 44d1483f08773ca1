"""The manifest of an invocation: its records, cases, codes and circumstances."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from vv.records.accepted import BaselineSummary
from vv.records.case_facts import CaseFacts
from vv.records.fields import optional
from vv.records.finding import Finding
from vv.records.job_record import Record
from vv.records.recorded import RecordedResult


@dataclass(frozen=True, slots=True)
class Machine:
    """A processor, its cores and the system; the fingerprint identifies the machine."""

    processor: str
    cores: int | None
    system: str
    fingerprint: str


@dataclass(frozen=True, slots=True)
class Provenance:
    """The circumstances of an invocation. utc: ISO time; dirty: files differed from the commit."""

    utc: str
    commit: str
    dirty: bool
    command: str
    machine: Machine
    versions: Mapping[str, str]
    threads: int


@dataclass(frozen=True, slots=True)
class CodeFound:
    """An installed or missing code. files: path -> digest; empty for a code that is only source."""

    version: str
    installed: bool
    files: Mapping[str, str]


@dataclass(frozen=True, slots=True)
class Manifest:
    """One invocation.

    untimed: the jobs that were to be timed and could not be. findings: those that do not follow
    from the records alone. baselines: with which the records were compared; recorded: results of
    codes that are not installed. timed_on: the machine on which costs were timed, if it is another.
    name: in the store; it is not part of the file.
    """

    provenance: Provenance
    codes: Mapping[str, CodeFound]
    cases: Mapping[str, CaseFacts]
    untimed: tuple[str, ...]
    records: tuple[Record, ...]
    findings: tuple[Finding, ...]
    baselines: Mapping[str, BaselineSummary]
    recorded: tuple[RecordedResult, ...]
    timed_on: Machine | None = optional(None)  # noqa: RUF009
    name: str = optional("")

    def external(self) -> set[str]:
        """The codes that are programs of others; what is in-house is always installed."""
        return {code for code, f in self.codes.items() if f.files or not f.installed}


@dataclass(frozen=True, slots=True)
class TimedRun:
    """The timed cost of a run: seconds, and the ratios to the calibration kernel."""

    startup: float
    setup: float
    solve_cpu: float
    solve_wall: float
    output: float
    repeats: int
    spread: float
    relative: tuple[float, float]
    whole: bool = optional(False)


@dataclass(frozen=True, slots=True)
class PrintedOutput:
    """The final output of an invocation.

    notes, lines: on standard error and standard output; status: its exit status; of: the digest of
    the files that the lines describe and of the required codes.
    """

    notes: tuple[str, ...]
    lines: tuple[str, ...]
    status: int
    of: str


@dataclass(frozen=True, slots=True)
class Answer:
    """The reusable answer to an invocation (manifest, output), or the file states of a report.

    records: digest of the states of all stored records when those of the manifest were complete.
    """

    manifest: str = optional("")
    records: str = optional("")
    report: tuple[int, ...] = optional(())
    printed: PrintedOutput | None = optional(None)  # noqa: RUF009  # None is frozen
