"""The history of a case over commits, read from the manifests of past runs."""

from __future__ import annotations

import dataclasses
import functools
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass

from vv.insight.past_runs import Digest, Figures, PastRuns
from vv.records.manifest import Manifest, Provenance
from vv.records.outcomes import Outcome
from vv.store.store import Store

COMMITS = 8  # shown
Past = tuple[Provenance, Digest]


@dataclass(frozen=True)
class Point:
    """A case at one commit.

    closeness: scheme -> largest error over tolerance. cost: scheme -> geometric mean of its timed
    solves in calibration kernels. Both use only the places that all points of the scheme have.
    outcomes: scheme -> numbers of outcomes.
    """

    utc: str
    commit: str
    dirty: bool
    closeness: Mapping[str, float]
    cost: Mapping[str, float]
    outcomes: Mapping[str, Mapping[Outcome, int]]

    @property
    def name(self) -> str:
        """The commit in short form; + for uncommitted changes."""
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
    """The history of each case: at each commit its newest run with unmodified records.

    at_hand: manifests by name, which need not be read. passed_over: called once for each damaged
    past run, with a sentence.
    """
    past = PastRuns(store, at_hand, functools.cache(passed_over))
    told = {case: [*last.values()] for case, last in _last_runs(store, past, cases).items()}
    keys = {case: past.key_of([name for name, _ in runs], case) for case, runs in told.items()}
    facts = {case: store.facts(tuple[Point, ...], key) for case, key in keys.items() if key}
    kept = {case: own for case, own in facts.items() if own and len(own) == len(told[case])}
    found = _worked_out(store, past, [case for case in told if not kept.get(case)])
    points = {case: _points([*runs.values()][::-1]) for case, runs in found.items()}
    for case, new in points.items():
        if keys[case] and len(new) == len(told[case]):  # none is empty
            store.keep_facts(keys[case], new)
    for case, runs in told.items():
        if own := kept.get(case):
            points[case] = [
                dataclasses.replace(point, utc=at.utc, commit=at.commit, dirty=at.dirty)
                for point, (_, at) in zip(own, runs[::-1], strict=True)
            ]
    return {case: points[case] for case in told}


def _last_runs(
    store: Store, past: PastRuns, cases: Iterable[str]
) -> dict[str, dict[tuple[str, bool], tuple[str, Provenance]]]:
    """Case -> commit -> name and provenance of the newest run that holds it, newest first."""
    found: dict[str, dict[tuple[str, bool], tuple[str, Provenance]]] = {c: {} for c in cases}
    for name in store.manifests.names()[::-1]:
        short = {case for case, commits in found.items() if len(commits) < COMMITS}
        if not short:
            break
        holds, provenance = past.head(name)
        for case in short.intersection(holds):
            at = provenance.commit, provenance.dirty
            found[case].setdefault(at, (name, provenance))
    return found


def _worked_out(
    store: Store, past: PastRuns, cases: Iterable[str]
) -> dict[str, dict[tuple[str, bool], Past]]:
    """Case -> commit -> its newest run with unmodified records, newest first."""
    found: dict[str, dict[tuple[str, bool], Past]] = {case: {} for case in cases}
    for name in store.manifests.names()[::-1]:  # each is read once, in parts
        short = {case for case, commits in found.items() if len(commits) < COMMITS}
        if not short:
            break
        holds, provenance = past.head(name)
        at = provenance.commit, provenance.dirty
        for case in holds:
            if case in short and at not in found[case]:
                own = past.digest(name, case)
                if own.outcomes:
                    found[case][at] = provenance, own
    return found


def _points(found: Sequence[Past]) -> list[Point]:
    closeness = _over_common([digest.closeness for _, digest in found], max)
    cost = _over_common([digest.cost for _, digest in found], _geometric_mean)
    return [
        Point(told.utc, told.commit, told.dirty, near, dear, digest.outcomes)
        for (told, digest), near, dear in zip(found, closeness, cost, strict=True)
    ]


def _over_common(
    points: Sequence[Figures], reduce: Callable[[list[float]], float]
) -> list[dict[str, float]]:
    """Each scheme's values at the places that all points of it have, reduced to one number."""
    common: dict[str, set[str]] = {}
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
    return math.exp(math.fsum(map(math.log, values)) / len(values))  # independent of the order
