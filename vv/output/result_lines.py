"""Prints the results of an invocation: counts, refusals, failures, changes."""

from __future__ import annotations

import shlex
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from vv.ask import NO_STIFFNESS
from vv.case import Level
from vv.gate.judgement import counted, outcome
from vv.output import finding_lines
from vv.output.results_table import table, unsupported
from vv.output.terminal import note, say
from vv.output.wording import in_words, listed
from vv.records.finding import Finding, worst_first
from vv.records.job_record import Record
from vv.records.manifest import Manifest, Provenance
from vv.records.outcomes import Outcome
from vv.records.reading import rung, settings, tried

INERT = ": inert, "  # the words of a plan in the note of a record

if TYPE_CHECKING:
    from vv.insight.compare import Change
    from vv.insight.history import Point

FAILED = frozenset(
    (Outcome.FAIL, Outcome.NOT_CONSERVED, Outcome.XPASS, Outcome.ERROR, Outcome.DIVERGED)
)
REASONS = 6  # the most reasons for refusals that are shown


def print_refusals(records: Sequence[Record]) -> None:
    """Print the schemes that refused everything in one line; if all did, also the reasons."""
    if any(map(tried, records)):
        if text := unsupported(records):
            note(f"{text}; `{_explained(records)}` says why")
        if any(NO_STIFFNESS in record.reason for record in records):
            note(NO_STIFFNESS)
        return
    reasons = Counter(
        f"{record.label}: {in_words(outcome(record))}: {record.reason}" for record in records
    )
    for reason, times in reasons.most_common(REASONS):
        note(f"{reason} ({times} times)" if times > 1 else reason)
    if len(reasons) > REASONS:
        rest = len(reasons) - REASONS
        note(f"and {rest} more reasons; the report has them all")


def _case(records: Iterable[Record]) -> str:
    """The case of these records as users type it; the first with a failure, if any."""
    given = list(records)
    failed = (record.case for record in given if outcome(record) in FAILED)
    return next(failed, given[0].case if given else "CASE")


def _explained(records: Sequence[Record]) -> str:
    """The command that says why schemes refuse a case, as it was run."""
    took = {record.label for record in filter(tried, records)}
    case = next(record.case for record in records if record.label not in took)
    own = [record for record in records if record.case == case]
    rungs = {rung(record) for record in own} - {""}
    words = [word for text in settings(own[0]) for word in ("--set", text)]
    if len(rungs) == 1:
        words += ["--rung", *rungs]
    return shlex.join(["vv", "explain", case, *words])


def print_inert(records: Iterable[Record]) -> None:
    """Name the changed parameters on which the exact answer does not depend."""
    for text in dict.fromkeys(
        f"{record.case}:{record.variant}: {part}"
        for record in records
        if record.modified and record.model is not None
        for part in record.model.note.split("; ")
        if INERT in part
    ):
        note(text)


def print_counts(
    records: Iterable[Record],
    report: str,
    programs: Mapping[str, Path] = finding_lines.NO_PROGRAMS,
    run: str = "",
) -> None:
    """The last line of a run: counts of outcomes, the report, and the command that explains them.

    The command names the first scheme and variant that failed. report: its path, or the command
    that writes it. run: its name in the store. programs: see `vv.output.finding_lines.lines`.
    """
    given = list(records)
    failed = next((record for record in given if outcome(record) in FAILED), None)
    details = f"vv explain {_case(given)}"
    if failed:
        details = finding_lines.command("explain", failed, programs)
    named = f"run: {run}; " if run else ""
    say(f"settings: {listed(counted(given))}; {named}report: {report}; details: {details}")


def print_table(records: Sequence[Record], findings: Sequence[Finding]) -> None:
    """Errors, orders, costs and verdicts of each scheme, if any scheme supports a variant."""
    if any(map(tried, records)):
        say(*table(records, findings))


def print_findings(
    findings: Sequence[Finding],
    records: Sequence[Record] = (),
    level: Level = Level.DEFAULT,
    programs: Mapping[str, Path] = finding_lines.NO_PROGRAMS,
    manifest: Manifest | None = None,
) -> None:
    """The findings of a gate, red ones first and worst first, and then its colour.

    programs: see `vv.output.finding_lines.lines`. manifest: that of the records, from which
    patterns of failures are known.
    """
    from vv.insight.diagnosis import diagnoses
    from vv.output.markdown import headline

    patterns = diagnoses(manifest) if manifest and any(one.red for one in findings) else []
    say(*finding_lines.lines(findings, records, level, programs, patterns))
    say(f"gate: {headline(findings)}")


def print_difference(manifest: Manifest, case: str) -> None:
    """What changed since the baseline of a case, worst first."""
    moved = [f for f in manifest.findings if f.compares]
    for finding in worst_first(moved):
        say(finding_lines.since_accepted(finding))
    if not moved:
        say(f"{case}: no change since its baseline")


def print_unacceptable(records: Iterable[Record]) -> None:
    """Which results do not enter a baseline, counted by scheme and outcome."""
    counts = Counter((record.label, outcome(record)) for record in records)
    for (scheme, came), number in counts.items():
        say(f"not in the baseline: {number} of {scheme}: {in_words(came, number)}")


def print_changes(changes: Sequence[Change], one: Manifest, other: Manifest, rows: int) -> None:
    """How two invocations differ, the largest difference of each kind first.

    With the command that made each, since what they computed may differ by intention.
    """
    for name, manifest in (("A", one), ("B", other)):
        where = manifest.provenance
        dirty = " with uncommitted changes" if where.dirty else ""
        commit = f"commit {where.commit[:9]}{dirty}" if where.commit else "no commit"
        say(f"{name}: {where.utc}, {commit}, {len(manifest.records)} results: {where.command}")
    for kind in dict.fromkeys(change.kind for change in changes):
        own = [change for change in changes if change.kind == kind]
        for change in own[:rows]:
            say(f"{kind}: {change.where}: {change.text}")
        if len(own) > rows:
            say(f"{kind}: and {len(own) - rows} more")
    if not changes:
        say("no difference")


def print_runs(past: Iterable[tuple[str, tuple[str, ...], Provenance]]) -> None:
    """Past runs, each with its name, commit, cases and command."""
    for name, cases, where in past:
        commit = (where.commit[:9] or "no commit") + ("+" if where.dirty else "")
        held = cases[0] if len(cases) == 1 else f"{len(cases)} cases"
        say(f"{name}  {commit}  {held}  {where.command}")


def print_history(case: str, points: Sequence[Point]) -> None:
    """A case over commits: for each scheme its error over tolerance and its relative cost."""
    if not points:
        say(f"{case}: no run is stored")
    for point in points:
        say(f"{case} at {point.name}, {point.utc}")
        for scheme, counts in sorted(point.outcomes.items()):
            near = point.closeness.get(scheme)
            cost = point.cost.get(scheme)
            parts = [listed(counts)]
            parts += [f"error {near:.3g} times the tolerance"] if near is not None else []
            parts += [f"cost {cost:.3g} calibration kernels"] if cost is not None else []
            say(f"  {scheme}: {', '.join(parts)}")
