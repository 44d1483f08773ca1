"""What people see on the terminal: progress, tables, counts and explanations."""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Container, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from vv.case import Case
from vv.codes.adapter import Adapter
from vv.gate.judgement import counted, outcome
from vv.output.wording import in_words, listed
from vv.plan.plan import Job, Plan
from vv.records.finding import Bit, Finding, from_data, worst_first
from vv.records.reading import label, tried

if TYPE_CHECKING:
    from vv.insight.compare import Change
    from vv.insight.history import Point

STORED = "stored"
REASONS = 6  # why codes refused: the most frequent ones
SHOWN = 12  # findings of a gate; the report and the files have all


def say(text: str) -> None:
    """Print a line."""
    print(text, flush=True)


def note(text: str) -> None:
    """Print a line beside what was asked for, which may be going down a pipe."""
    print(text, file=sys.stderr, flush=True)


def complain(text: str) -> int:
    """Print an error line and return the exit status of a usage error."""
    print(f"vv: {text}", file=sys.stderr)
    return int(Bit.USAGE)


def print_refusals(records: Iterable[Mapping[str, Any]]) -> None:
    """Each reason why something was refused or is not installed, once, with how often."""
    reasons = Counter(
        f"{record['code']}/{record['scheme']}: {outcome(record)}: {record['reason']}"
        for record in records
        if not tried(record)
    )
    for reason, times in reasons.most_common(REASONS):
        print(f"{reason} ({times} times)" if times > 1 else reason, file=sys.stderr)
    if len(reasons) > REASONS:
        rest = len(reasons) - REASONS
        print(f"and {rest} more reasons to refuse; the report has them all", file=sys.stderr)


def print_failures(findings: Sequence[Finding]) -> None:
    """What did not run, and the results farthest outside their tolerances, as the gate says it."""
    found = [one for one in worst_first(findings) if one.check in ("accuracy", "run")]
    for finding in found[:REASONS]:
        note(f"{finding.kind}: {finding.where}: {finding.text}")
    if len(found) > REASONS:
        note(f"and {len(found) - REASONS} more like these; the report has them all")


def print_counts(records: Iterable[Mapping[str, Any]], report: str) -> None:
    """The last line of a run: outcomes counted, where the report is, where to read why.

    report: its path, or what writes it.
    """
    say(f"{listed(counted(records))}; report: {report}; why: vv explain CASE")


def print_findings(findings: Sequence[Finding]) -> None:
    """The verdict of a gate: its colour, then what is red, worst first, and what is new."""
    from vv.output.markdown import headline

    ranked = worst_first(findings)
    for finding in ranked[:SHOWN]:
        mark = "red" if finding.red else "reported only" if finding.bit else "note"
        say(f"{mark}: {finding.check} {finding.kind}: {finding.where}: {finding.text}")
    if len(ranked) > SHOWN:
        say(f"and {len(ranked) - SHOWN} more")
    say(f"gate: {headline(findings)}")


def print_difference(manifest: Mapping[str, Any], case: str) -> None:
    """What moved since the baseline of a case, worst first."""
    moved = [f for f in map(from_data, manifest["findings"]) if f.compares]
    for finding in worst_first(moved):
        say(f"{finding.kind}: {finding.where}: {finding.text}")
    if not moved:
        say(f"{case}: nothing moved since its baseline")


def print_unacceptable(records: Iterable[Mapping[str, Any]]) -> None:
    """Which results do not enter a baseline, counted by scheme and outcome."""
    counts = Counter((label(record), outcome(record)) for record in records)
    for (scheme, word), number in counts.items():
        say(f"not accepted: {number} of {scheme}: {in_words(word, number)}")


def print_changes(
    changes: Sequence[Change], one: Mapping[str, Any], other: Mapping[str, Any], rows: int
) -> None:
    """What moved between two invocations, the largest of each kind first."""
    for name, manifest in (("A", one), ("B", other)):
        told = manifest["provenance"]
        dirty = " with uncommitted changes" if told["dirty"] else ""
        commit = f"commit {told['commit'][:9]}{dirty}" if told["commit"] else "no commit"
        say(f"{name}: {told['utc']}, {commit}, {len(manifest['records'])} results")
    for kind in dict.fromkeys(change.kind for change in changes):
        own = [change for change in changes if change.kind == kind]
        for change in own[:rows]:
            say(f"{kind}: {change.where}: {change.text}")
        if len(own) > rows:
            say(f"{kind}: and {len(own) - rows} more")
    if not changes:
        say("nothing moved")


def print_history(case: str, points: Sequence[Point]) -> None:
    """A case over commits: for each scheme its error over tolerance and its relative cost."""
    if not points:
        say(f"{case}: no run is stored")
    for point in points:
        say(f"{case} at {point.name}, {point.utc}")
        for scheme, counts in sorted(point.outcomes.items()):
            near = point.closeness.get(scheme)
            cost = point.cost.get(scheme)
            told = [listed(counts)]
            told += [f"error {near:.3g} of the tolerance"] if near is not None else []
            told += [f"cost {cost:.3g} calibration kernels"] if cost is not None else []
            say(f"  {scheme}: {', '.join(told)}")


def print_jobs(plan: Plan, stored: Container[int]) -> None:
    """Each job in a line, with why it would not run; stored: the numbers of those answered."""
    told = {number: _fate(job, number in stored) for number, job in enumerate(plan.jobs)}
    for number, job in enumerate(plan.jobs):
        say(f"{job.label}{f'  ({told[number]})' if told[number] else ''}")
    run, kept = (sum(fate == which for fate in told.values()) for which in ("", STORED))
    say(f"{len(plan.jobs)} jobs, {run} would run, {kept} are stored")


def _fate(job: Job, stored: bool) -> str:
    if job.settled:
        return f"{job.settled.status.value}: {job.settled.reason}"
    return STORED if stored else ""


def print_cases(cases: Sequence[Case]) -> None:
    """Cases with their variants."""
    for case in cases:
        say(f"{case.name}  {case.title} [{case.source.doi or case.source.citation}]")
        width = max((len(variant.name) for variant in case.variants), default=0)
        for variant in case.variants:
            say(f"  {case.name}:{variant.name:<{width}}  {variant.summary}")


def print_codes(adapters: Sequence[Adapter]) -> None:
    """Codes with version, place, schemes, and how to install those that are missing."""
    for adapter in adapters:
        found = adapter.found()
        state = f"{found.version}  {found.path}" if found.installed else "not installed"
        say(f"{adapter.name}  {state}")
        if not found.installed:
            say(f"  to install: {found.how_to_install}")
        for scheme in adapter.schemes:
            knobs = ", ".join(scheme.knobs) or "none"
            lowered = [f"; {m.value} with {t.value}" for t, m in scheme.lowered.items()]
            how = f"[{scheme.method.value}{''.join(lowered)}; knobs: {knobs}]"
            say(f"  {adapter.name}/{scheme.name}: {scheme.summary} {how}")
