"""Compares two invocations: outcomes, errors, observed orders, costs."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from vv.base.errors import UsageError
from vv.base.metrics import Order
from vv.base.notices import notice
from vv.gate.judgement import outcome
from vv.records.job_record import Record
from vv.records.manifest import Manifest
from vv.records.reading import rung, shortest
from vv.records.rungs import Key, orders
from vv.store.store import Store

SAME = 1e-6  # smaller relative changes of an error are not shown
LISTED = 3  # the number of runs named if one is not found
NOISE = 1e-12  # an error below it is rounding
LAST = re.compile(r"last(?:~(\d+))?")  # how a run is named by its age
ORDER = 0.02  # smaller changes of an observed order are not shown
COST = 1.25  # smaller ratios of costs are not shown, since rounds differ by as much


@dataclass(frozen=True)
class Change:
    """A difference between two invocations. size: the sort key among changes of one kind."""

    kind: str
    where: str
    text: str
    size: float = 0.0


def manifest_of(store: Store, name: str, known: Callable[[str], str]) -> Manifest:
    """The run of that name, or the newest at a commit, preferably without uncommitted changes.

    `last` is the newest run, `last~1` the one before it. A commit is given by its beginning, or by
    a name; `known` returns the commit of a name, or ''.
    """
    names = store.manifests.names()
    if back := LAST.fullmatch(name):
        return _back(store, names, int(back[1] or 0))
    if name in names:
        return store.manifests.read(name)
    commit = known(name) or (name if len(name) >= 4 else "")
    edited = ""
    for run in reversed(names if commit else []):
        try:
            came_from = store.manifests.head(run)[1]
            if came_from.commit.startswith(commit) and not came_from.dirty:
                return store.manifests.read(run)
        except OSError as error:  # damaged from outside
            notice(f"past run {run}: {error.strerror}; skipped")
        else:
            edited = edited or (run if came_from.commit.startswith(commit) else "")
    if edited:
        return store.manifests.read(edited)
    last = ", ".join(names[: -LISTED - 1 : -1])
    if known(name):
        raise UsageError(f"nothing was run at {name}; {how_to_make(name)}; last runs: {last}")
    raise UsageError(f"no run and no commit '{name}' in the store; the last runs are {last}")


def _back(store: Store, names: Sequence[str], steps: int) -> Manifest:
    """The run that many before the newest; damaged ones are not counted."""
    for name in reversed(names):
        found = store.manifests.newest_of([name], notice)
        if found and not steps:
            return found[0]
        steps -= len(found)
    raise UsageError("there are not so many runs; `vv runs` lists all")


def how_to_make(name: str) -> str:
    """The commands that give results for a commit in the store."""
    return f"to get results for a commit: git switch --detach {name} && vv run CASE; git switch -"


def changes(one: Manifest, other: Manifest) -> list[Change]:
    """The differences of `other` from `one`: parameters, outcomes, errors, orders and costs."""
    before, after = _by_place(one.records), _by_place(other.records)
    problems = list(_parameter_changes(one.records, other.records))
    found, others = [*_presence(before, after), *problems], {change.where for change in problems}
    for place in before.keys() & after.keys():
        pair, where = (before[place], after[place]), " ".join(part for part in place if part)
        found += _outcome_changes(where, *pair)
        found += () if place[0] in others else _number_changes(where, *pair)
    moved = _order_changes(orders(one.records), orders(other.records))
    found += [change for change in moved if change.where.split()[0] not in others]
    kinds = ("parameters", "outcome", "only in A", "only in B", "error", "order", "cost")
    return sorted(found, key=lambda change: (kinds.index(change.kind), -change.size, change.where))


def _by_place(records: Iterable[Record]) -> dict[tuple[str, ...], Record]:
    return {(f"{r.case}:{r.variant}", r.label, rung(r)): r for r in records}


def _parameter_changes(one: Iterable[Record], other: Iterable[Record]) -> Iterator[Change]:
    """The parameters that differ, one line per variant, whose numbers are not compared."""
    before, after = ({(r.case, r.variant): r.parameters for r in own} for own in (one, other))
    for place in before.keys() & after.keys():
        a, b = before[place], after[place]
        moved = [name for name in {**a, **b} if a.get(name) != b.get(name)]
        if moved:
            texts = [f"{name} = {_known(a.get(name))} -> {_known(b.get(name))}" for name in moved]
            text = f"{', '.join(texts)}; numbers of different problems are not compared"
            yield Change("parameters", ":".join(place), text)


def _known(value: float | None) -> str:
    return "none" if value is None else shortest(value)


def _presence(
    before: Mapping[tuple[str, ...], Record], after: Mapping[tuple[str, ...], Record]
) -> Iterator[Change]:
    """Results that only one of the two has, one line per scheme and variant."""
    for kind, own, others in (("only in A", before, after), ("only in B", after, before)):
        counts: dict[str, int] = {}
        for place in own.keys() - others.keys():
            where = " ".join(place[:2])
            counts[where] = counts.get(where, 0) + 1
        for where, count in counts.items():
            yield Change(kind, where, f"{count} setting{'s' if count > 1 else ''}")


def _outcome_changes(where: str, one: Record, other: Record) -> Iterator[Change]:
    was, now = outcome(one), outcome(other)
    if was is not now:
        yield Change("outcome", where, f"{was.value} -> {now.value}")


def _number_changes(where: str, one: Record, other: Record) -> Iterator[Change]:
    errors = [{q.name: q.error for q in record.quantities} for record in (one, other)]
    for name in errors[0].keys() & errors[1].keys():
        a, b = errors[0][name] or 0.0, errors[1][name] or 0.0
        if max(a, b) > NOISE and abs(a - b) > SAME * max(a, b):
            size = abs(math.log(b / a)) if a and b else math.inf
            yield Change("error", f"{where} {name}", f"{a:.3g} -> {b:.3g}{_times(a, b)}", size)
    cost, later = _cost(one), _cost(other)
    if cost and later and not 1 / COST <= later / cost <= COST:
        text = f"{cost:.3g} -> {later:.3g} calibration kernels{_times(cost, later)}"
        yield Change("cost", where, text, abs(math.log(later / cost)))


def _cost(record: Record) -> float | None:
    """The timed cost in calibration kernels, so that sessions can be compared."""
    return record.cost.relative[0] if record.cost.relative else None


def _order_changes(one: Mapping[Key, Order], other: Mapping[Key, Order]) -> Iterator[Change]:
    for key in one.keys() & other.keys():
        a, b = one[key].order, other[key].order
        if abs(a - b) > ORDER:
            case, variant, code, scheme, quantity, kn = key
            at = f" kn={kn:g}" if kn else ""
            where = f"{case}:{variant} {code}/{scheme}{at} {quantity}"
            yield Change("order", where, f"{a:.2f} -> {b:.2f}", abs(a - b))


def _times(a: float, b: float) -> str:
    return f" (x {b / a:.3g})" if a and b else ""
