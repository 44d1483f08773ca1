"""Lines of text for findings of the gate: similar ones merged, with the command to rerun them."""

from __future__ import annotations

import shlex
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING

from vv.case import Level
from vv.records.finding import Aspect, Change, Finding, worst_first
from vv.records.job_record import Record
from vv.records.reading import rung, settings

if TYPE_CHECKING:
    from vv.insight.diagnosis import Diagnosis

SHOWN = 12  # the most lines of findings; the report and the files have all
THAN = {  # the words for a change since the baseline
    Change.WORSE.value: "worse than accepted: ",
    Change.BETTER.value: "better than accepted: ",
    Change.MOVED.value: "moved since it was accepted: ",
    Change.SLOWER.value: "slower than accepted: ",
    Change.FASTER.value: "faster than accepted: ",
    "refused otherwise": "not supported, for another reason: ",
}
NO_PROGRAMS: Mapping[str, Path] = MappingProxyType({})
Place = tuple[str, str, str, str]  # case, variant, scheme, knobs


@dataclass(frozen=True)
class Folded:
    """A finding, and the number of similar ones on the same scheme and variant."""

    finding: Finding
    others: int


def folded(findings: Iterable[Finding]) -> list[Folded]:
    """The findings, sorted worst first; those that differ only in their setting are merged."""
    piles: dict[tuple[object, ...], list[Finding]] = {}
    for one in worst_first(findings):
        bare = one.kind == Change.NO_BASELINE.value
        whole = () if bare else (one.case, one.variant, one.label, one.quantity)
        piles.setdefault((one.red, one.check, one.kind, *whole), []).append(one)
    return [Folded(pile[0], len(pile) - 1) for pile in piles.values()]


def lines(
    findings: Iterable[Finding],
    records: Iterable[Record],
    level: Level,
    programs: Mapping[str, Path] = NO_PROGRAMS,
    patterns: Sequence[Diagnosis] = (),
) -> Iterator[str]:
    """Red findings first and worst first; below each red one the command that reruns it.

    programs: the files of codes that were named by a file. patterns: the failure patterns of
    schemes in cases, printed with their first finding.
    """
    looks = {(one.case, one.label): one.text for one in patterns}
    at = {(r.case, r.variant, r.label, rung(r)): r for r in records}
    ranked = folded(findings)
    for one in ranked[:SHOWN]:
        yield _line(one)
        again = rerun(one.finding, at, level, programs)
        if one.finding.red and again:
            yield f"  again: {again}"
        if one.finding.red and (look := looks.pop((one.finding.case, one.finding.label), "")):
            yield f"  pattern: {look}"
    if len(ranked) > SHOWN:
        red = sum(one.finding.red for one in ranked[SHOWN:])
        yield f"and {len(ranked) - SHOWN} more, {red} of them red; the report has them all"


def _line(one: Folded) -> str:
    found = one.finding
    mark = "red" if found.red else "reported only" if found.bit else "note"
    if found.kind == Change.NO_BASELINE.value:
        more = f" and {one.others} more" if one.others else ""
        return f"{mark}: {found.case}{more}: {found.text}"
    more = f" (and at {_settings(one.others)})" if one.others else ""
    return f"{mark}: {since_accepted(found)}{more}"


def since_accepted(found: Finding) -> str:
    """The place and the text of a finding; for a change, also the kind of change.

    Of a case without a baseline only this is said, since whoever reads it is about to accept one.
    """
    if found.kind == Change.NO_BASELINE.value:
        return f"{found.case}: no baseline yet"
    where = f"{found.where}: " if found.where else ""
    return f"{where}{THAN.get(found.kind, '')}{found.text}"


def _settings(count: int) -> str:
    return f"{count} more setting{'s' if count > 1 else ''}"


def rerun(
    finding: Finding,
    at: Mapping[Place, Record],
    level: Level,
    programs: Mapping[str, Path] = NO_PROGRAMS,
) -> str:
    """The command that reruns the result of a finding; empty if it concerns no single result."""
    record = at.get((finding.case, finding.variant, finding.label, finding.rung))
    if record is None or finding.check is Aspect.SPEED:
        return ""
    words = ["--rung", finding.rung] if finding.rung else []
    words += ["--level", level.value] if level is Level.PAPER else []
    return command("run", record, programs, words)


def command(
    verb: str, record: Record, programs: Mapping[str, Path] = NO_PROGRAMS, more: Sequence[str] = ()
) -> str:
    """A command on one scheme in one variant, at the parameters of its record."""
    named = f"{programs.get(record.code, record.code)}/{record.scheme}"
    words = ["vv", verb, f"{record.case}:{record.variant}", "--codes", named, *more]
    return shlex.join([*words, *(word for text in settings(record) for word in ("--set", text))])
