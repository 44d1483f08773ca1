"""The history of a case over commits, read from the manifests of past runs."""

from __future__ import annotations

import dataclasses
import functools
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass

from vv.base.digest import digest
from vv.insight.past_runs import Digest, Figures, PastRuns
from vv.records.manifest import Manifest, Provenance
from vv.records.outcomes import Outcome
from vv.store.store import Store

COMMITS = 8  # shown
RUNS = 20  # the most at one commit whose results are put together
Past = tuple[Provenance, Digest]
Commits = dict[tuple[str, bool], list[tuple[str, Provenance]]]  # commit -> runs, newest first


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
    """A case at each of its last commits, oldest first; as `histories`."""
    return histories(store, [case], {}, passed_over)[case]


def histories(
    store: Store,
    cases: Iterable[str],
    at_hand: Mapping[str, Manifest],
    passed_over: Callable[[str], None],
) -> dict[str, list[Point]]:
    """The history of each case: at each commit the newest unmodified records of each scheme.

    at_hand: manifests by name, which need not be read. passed_over: called once for each damaged
    past run, with a sentence.
    """
    past = PastRuns(store, at_hand, functools.cache(passed_over))
    told = _last_runs(store, past, cases)
    keys = {case: _key(past, case, commits) for case, commits in told.items()}
    facts = {case: store.facts(tuple[Point, ...], key) for case, key in keys.items() if key}
    kept = {case: own for case, own in facts.items() if own and len(own) == len(told[case])}
    found = _worked_out(past, {case: own for case, own in told.items() if case not in kept})
    for case, new in found.items():
        if keys[case] and len(new) == len(told[case]):  # none is empty
            store.keep_facts(keys[case], new)
    for case, own in kept.items():
        newest = [runs[0][1] for runs in told[case].values()][::-1]
        found[case] = [
            dataclasses.replace(point, utc=at.utc, commit=at.commit, dirty=at.dirty)
            for point, at in zip(own, newest, strict=True)
        ]
    return {case: found[case] for case in told}


def _key(past: PastRuns, case: str, commits: Commits) -> str:
    """The digest of the records of a case in these runs by commit; empty if one is not stored."""
    held = [past.key_of([name for name, _ in runs], case) for runs in commits.values()]
    return digest(held) if held and all(held) else ""


def _last_runs(store: Store, past: PastRuns, cases: Iterable[str]) -> dict[str, Commits]:
    """The last runs of each case at its last commits, newest first.

    Of runs with the same records of the case only the newest is listed.
    """
    found: dict[str, Commits] = {case: {} for case in cases}
    waiting = set(found)
    for name in store.manifests.names()[::-1]:
        if not waiting:
            break
        holds, provenance = past.head(name)
        at = provenance.commit, provenance.dirty
        for case in waiting.intersection(holds):
            commits = found[case]
            if at not in commits and len(commits) == COMMITS:
                waiting.remove(case)
                continue
            runs = commits.setdefault(at, [])
            same = {past.key_of([other], case) for other, _ in runs} - {""}
            if len(runs) < RUNS and past.key_of([name], case) not in same:
                runs.append((name, provenance))
    return found


def _worked_out(past: PastRuns, told: Mapping[str, Commits]) -> dict[str, list[Point]]:
    """The points of each case, oldest first; commits with only modified records have none."""
    wanted = {
        (name, case)
        for case, commits in told.items()
        for runs in commits.values()
        for name, _ in runs
    }
    digests = {place: past.digest(*place) for place in sorted(wanted)}  # each run is read once
    found: dict[str, list[Past]] = {case: [] for case in told}
    for case, commits in told.items():
        for runs in [*commits.values()][::-1]:
            merged = _newest_of_each([digests[name, case] for name, _ in runs])
            if merged.outcomes:
                found[case].append((runs[0][1], merged))
    return {case: _points(own) for case, own in found.items()}


def _newest_of_each(runs: Iterable[Digest]) -> Digest:
    """The figures of each scheme in the newest run that has it; runs: newest first."""
    found: dict[str, Digest] = {}
    for one in runs:
        found = {**dict.fromkeys(one.outcomes, one), **found}
    return Digest(
        {scheme: own.closeness[scheme] for scheme, own in found.items() if scheme in own.closeness},
        {scheme: own.cost[scheme] for scheme, own in found.items() if scheme in own.cost},
        {scheme: own.outcomes[scheme] for scheme, own in found.items()},
    )


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
