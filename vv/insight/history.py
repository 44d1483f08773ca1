"""What became of a case over commits, read from the manifests of past runs."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from vv.gate.judgement import counted
from vv.records.reading import error_of, label, rung
from vv.store.store import Store

COMMITS = 8  # shown
Record = Mapping[str, Any]
Place = tuple[str, str, str]


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
    outcomes: Mapping[str, Mapping[str, int]]

    @property
    def name(self) -> str:
        """The commit as people say it; + for uncommitted changes."""
        return (self.commit[:9] or "no commit") + ("+" if self.dirty else "")


def history(store: Store, case: str) -> list[Point]:
    """The newest run of a case at each of the last commits, oldest first."""
    return histories(store, [case], {})[case]


def histories(
    store: Store, cases: Iterable[str], at_hand: Mapping[str, Mapping[str, Any]]
) -> dict[str, list[Point]]:
    """The history of each case, from its own records of past runs.

    at_hand: manifests by their names, which need not be read.
    """
    names, head = store.manifests()[::-1], functools.cache(store.head)

    def read(name: str, case: str) -> list[Record]:
        if name not in at_hand:
            return list(store.records_of(name, case))
        return [record for record in at_hand[name]["records"] if record["case"] == case]

    return {case: _points(_newest(case, names, head, read)[::-1]) for case in cases}


def _points(found: Sequence[tuple[Mapping[str, Any], list[Record]]]) -> list[Point]:
    closeness = _over_common([_measured(records, _closeness) for _, records in found], max)
    cost = _over_common([_measured(records, _relative) for _, records in found], _geometric_mean)
    return [
        Point(told["utc"], told["commit"], told["dirty"], near, dear, _by_scheme(records))
        for (told, records), near, dear in zip(found, closeness, cost, strict=True)
    ]


def _newest(
    case: str,
    names: Iterable[str],
    head: Callable[[str], tuple[list[str], Mapping[str, Any]]],
    read: Callable[[str, str], list[Record]],
) -> list[tuple[Mapping[str, Any], list[Record]]]:
    """(provenance, records of the case) of the newest run at each commit, newest first."""
    found: dict[tuple[str, bool], tuple[Mapping[str, Any], list[Record]]] = {}
    for name in names:
        try:
            held, told = head(name)
            at = told["commit"], told["dirty"]
            if at in found or case not in held:
                continue
            records = read(name, case)
        except OSError:
            continue  # damaged from outside: the others still tell
        own = [r for r in records if not r["modified"]]
        if own:
            found[at] = told, own
        if len(found) == COMMITS:
            break
    return list(found.values())


def _measured(records: Iterable[Record], measure: Any) -> dict[str, dict[Place, float]]:
    """Scheme -> place -> what is measured there."""
    found: dict[str, dict[Place, float]] = {}
    for record in records:
        for name, value in measure(record).items():
            place = record["variant"], rung(record), name
            found.setdefault(label(record), {})[place] = value
    return found


def _closeness(record: Record) -> dict[str, float]:
    pairs = {e["name"]: (error_of(e), e["tolerance"]) for e in record["quantities"]}
    return {name: error / bound for name, (error, bound) in pairs.items() if error and bound}


def _relative(record: Record) -> dict[str, float]:
    relative = record["cost"].get("relative")
    return {"cost": math.sqrt(relative[0] * relative[1])} if relative else {}


def _over_common(
    points: list[dict[str, dict[Place, float]]], reduce: Any
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
    return math.exp(sum(map(math.log, values)) / len(values))


def _by_scheme(records: Iterable[Record]) -> dict[str, Mapping[str, int]]:
    found: dict[str, list[Record]] = {}
    for record in records:
        found.setdefault(label(record), []).append(record)
    return {scheme: counted(own) for scheme, own in found.items()}
