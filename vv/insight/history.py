"""What became of a case over commits, read from the manifests of past runs."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TypeVar

from vv.gate.judgement import counted
from vv.records.job_record import Record
from vv.records.manifest import Manifest
from vv.records.outcomes import Outcome
from vv.records.provenance import Machine, Provenance
from vv.records.reading import rung
from vv.store.store import Store

COMMITS = 8  # shown
Place = tuple[str, str, str]
Head = tuple[tuple[str, ...], Provenance]  # the cases of a past run, and where it comes from
Past = tuple[Provenance, Sequence[Record]]
Part = TypeVar("Part")
NOWHERE = Provenance("", "", False, "", Machine("", None, "", ""), {}, 1)  # of what is damaged


@dataclass(frozen=True)
class Point:
    """A case at one commit.

    closeness: scheme -> largest error over tolerance. cost: scheme -> geometric mean of its timed
    solves in calibration kernels. Both are over those places only that all points of the scheme
    have. outcomes: scheme -> outcomes counted.
    """

    utc: str
    commit: str
    dirty: bool
    closeness: Mapping[str, float]
    cost: Mapping[str, float]
    outcomes: Mapping[str, Mapping[Outcome, int]]

    @property
    def name(self) -> str:
        """The commit as people say it; + for uncommitted changes."""
        return (self.commit[:9] or "no commit") + ("+" if self.dirty else "")


def history(store: Store, case: str, passed_over: Callable[[str], None]) -> list[Point]:
    """The newest run of a case at each of the last commits, oldest first; as `histories`."""
    return histories(store, [case], {}, passed_over)[case]


def histories(
    store: Store,
    cases: Iterable[str],
    at_hand: Mapping[str, Manifest],
    passed_over: Callable[[str], None],
) -> dict[str, list[Point]]:
    """The history of each case, from its own records of past runs.

    at_hand: manifests by their names, which need not be read. passed_over: is called once with a
    sentence on each past run that is damaged.
    """
    names = store.manifests()[::-1]
    past = _PastRuns(store, at_hand, functools.cache(passed_over))
    return {case: _points(_newest(case, names, past)[::-1]) for case in cases}


@dataclass(frozen=True)
class _PastRuns:
    """Reads past runs in parts; of damaged ones there is nothing, which is said once."""

    store: Store
    at_hand: Mapping[str, Manifest]
    passed_over: Callable[[str], None]
    heads: dict[str, Head] = field(default_factory=dict)

    def head(self, name: str) -> Head:
        """The cases of a past run and where it comes from; no cases if it is damaged."""
        if name not in self.heads:
            self.heads[name] = self._of(name, lambda: self.store.head(name)) or ((), NOWHERE)
        return self.heads[name]

    def records(self, name: str, case: str) -> Sequence[Record]:
        """The records of a case in a past run."""
        if name in self.at_hand:
            return [record for record in self.at_hand[name].records if record.case == case]
        return self._of(name, lambda: self.store.records_of(name, case)) or ()

    def _of(self, name: str, read: Callable[[], Part]) -> Part | None:
        try:
            return read()
        except OSError as error:
            self.passed_over(f"past run {name}: {error.strerror}; passed over")
            return None


def _points(found: Sequence[Past]) -> list[Point]:
    closeness = _over_common([_measured(records, _closeness) for _, records in found], max)
    cost = _over_common([_measured(records, _relative) for _, records in found], _geometric_mean)
    return [
        Point(provenance.utc, provenance.commit, provenance.dirty, near, dear, _by_scheme(records))
        for (provenance, records), near, dear in zip(found, closeness, cost, strict=True)
    ]


def _newest(case: str, names: Iterable[str], past: _PastRuns) -> list[Past]:
    """The newest run at each commit that holds unmodified records of the case, newest first."""
    found: dict[tuple[str, bool], Past] = {}
    for name in names:
        holds, provenance = past.head(name)
        at = provenance.commit, provenance.dirty
        if at in found or case not in holds:
            continue
        own = [record for record in past.records(name, case) if not record.modified]
        if own:
            found[at] = provenance, own
        if len(found) == COMMITS:
            break
    return list(found.values())


def _measured(
    records: Iterable[Record], measure: Callable[[Record], Mapping[str, float]]
) -> dict[str, dict[Place, float]]:
    """Scheme -> place -> what is measured there."""
    found: dict[str, dict[Place, float]] = {}
    for record in records:
        for name, value in measure(record).items():
            place = record.variant, rung(record), name
            found.setdefault(record.label, {})[place] = value
    return found


def _closeness(record: Record) -> dict[str, float]:
    pairs = {one.name: (one.error, one.tolerance) for one in record.quantities}
    return {name: error / bound for name, (error, bound) in pairs.items() if error and bound}


def _relative(record: Record) -> dict[str, float]:
    relative = record.cost.relative
    return {"cost": math.sqrt(relative[0] * relative[1])} if relative else {}


def _over_common(
    points: list[dict[str, dict[Place, float]]], reduce: Callable[[list[float]], float]
) -> list[dict[str, float]]:
    """Each scheme's values at the places that all points of it have, reduced to one number."""
    common: dict[str, set[Place]] = {}
    for point in points:
        for scheme, values in point.items():
            common[scheme] = common.get(scheme, values.keys()) & values.keys()
    return [
        {
            scheme: reduce([values[place] for place in common[scheme]])
            for scheme, values in point.items()
            if common[scheme]
        }
        for point in points
    ]


def _geometric_mean(values: list[float]) -> float:
    return math.exp(math.fsum(map(math.log, values)) / len(values))  # in whatever order


def _by_scheme(records: Iterable[Record]) -> dict[str, Mapping[Outcome, int]]:
    found: dict[str, list[Record]] = {}
    for record in records:
        found.setdefault(record.label, []).append(record)
    return {scheme: counted(own) for scheme, own in found.items()}
