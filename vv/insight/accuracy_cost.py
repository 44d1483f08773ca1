"""The cost of an error: interpolation between rungs, Pareto front, rankings and profiles.

Only timed rungs count, since all of these were timed in one session.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any, TypeVar

from vv.insight.effort import Effort
from vv.records.rungs import Point

TARGETS = (1e-2, 1e-3, 1e-4, 1e-6)  # relative errors that users ask for
FACTORS = (
    1.0,
    2.0,
    10.0,
    100.0,
    1e4,
)  # multiples of the cost of the cheapest at which profiles are printed
Ranked = TypeVar("Ranked", bound=tuple[Any, ...])
LEAST = 1e-17  # stands for an error of zero on a logarithmic scale


@dataclass(frozen=True)
class ErrorCost:
    """The CPU time [s] a scheme needs for an error. cpu None: the error was not reached.

    bound: cpu is an upper bound, as the coarsest timed rung is accurate enough already.
    point: the cheapest timed rung that is as accurate.
    """

    cpu: float | None
    bound: bool = False
    point: Point | None = None


def error_cost(effort: Effort, target: float) -> ErrorCost:
    """The cost of an error in a scheme, interpolated between rungs on logarithmic scales."""
    timed = [
        (p.cpu, max(p.error, LEAST), p) for p in effort.points if p.cpu and p.error is not None
    ]
    before: tuple[float, float] | None = None
    for cpu, error, point in sorted(timed, key=lambda row: (row[0], row[1])):
        if error <= target:
            if before is None:
                return ErrorCost(cpu, True, point)
            share = math.log(before[1] / target) / math.log(before[1] / error)
            return ErrorCost(before[0] * (cpu / before[0]) ** share, False, point)
        if before is None or error < before[1]:
            before = cpu, error
    return ErrorCost(None)


def front(every: Iterable[Effort]) -> list[tuple[str, Point]]:
    """The Pareto front of error and cost: (label, point) of timed rungs, cheapest first."""
    timed = [
        (p.cpu, p.error, effort.label, p)
        for effort in every
        for p in effort.points
        if p.cpu is not None and p.error is not None
    ]
    return [(name, point) for _, _, name, point in unbeaten(sorted(timed, key=lambda t: t[:3]))]


def unbeaten(rows: Iterable[Ranked]) -> list[Ranked]:
    """Of rows (cost, error, ...) sorted by cost, those with a smaller error than all before."""
    kept: list[Ranked] = []
    for row in rows:
        if not kept or row[1] < kept[-1][1]:
            kept.append(row)
    return kept


def cheapest(every: Iterable[Effort], target: float) -> list[tuple[str, Point]]:
    """The cheapest timed rung of each code within an error, (label, point), cheapest first."""
    found = [(effort.label, error_cost(effort, target).point) for effort in every]
    able = [(p.cpu, name, p) for name, p in found if p is not None and p.cpu is not None]
    first: dict[str, tuple[str, Point]] = {}
    for _, name, point in sorted(able, key=lambda row: row[:2]):
        first.setdefault(name.partition("/")[0], (name, point))
    return list(first.values())


@dataclass(frozen=True)
class Comparison:
    """The cheapest in-house engine and the cheapest external code at an error, on one variant.

    stepping: only engines that step in time are compared. ours, theirs: labels, '' if none
    reaches the error. ratio: our cost over theirs; None if one is missing. loose: theirs may be
    cheaper, as their coarsest timed rung is more accurate already. least: the smallest error of
    the external codes, if none reaches the target; floored: each has reached its floor.
    """

    case: str
    variant: str
    target: float
    stepping: bool
    ours: str
    theirs: str
    ratio: float | None
    loose: bool
    least: float | None
    floored: bool


def comparisons(every: Sequence[Effort], targets: Sequence[float]) -> list[Comparison]:
    """The comparisons for each variant and error: of all in-house engines, and of stepping ones."""
    variants = dict.fromkeys((e.case, e.variant) for e in every if e.external)
    found = []
    for case, variant in variants:
        here = [e for e in every if (e.case, e.variant) == (case, variant)]
        theirs = [e for e in here if e.external]
        for target in targets:
            for stepping in (False, True):
                ours = [e for e in here if not e.external and (e.stepping or not stepping)]
                found.append(_comparison(case, variant, target, stepping, ours, theirs))
    return found


def _comparison(
    case: str,
    variant: str,
    target: float,
    stepping: bool,
    ours: Sequence[Effort],
    theirs: Sequence[Effort],
) -> Comparison:
    mine, other = _cheapest(ours, target), _cheapest(theirs, target)
    ratio = mine[0] / other[0] if mine and other else None
    least = min((e.best for e in theirs if e.best is not None), default=None)
    return Comparison(
        case, variant, target, stepping, mine[1] if mine else "", other[1] if other else "",
        ratio, bool(other and other[2]), None if other else least,
        other is None and all(e.floor for e in theirs if e.best is not None),
    )  # fmt: skip


def _cheapest(every: Sequence[Effort], target: float) -> tuple[float, str, bool] | None:
    found = [(error_cost(effort, target), effort.label) for effort in every]
    return min(((r.cpu, name, r.bound) for r, name in found if r.cpu is not None), default=None)


def profile(every: Sequence[Effort], target: float) -> dict[str, list[float]]:
    """Label -> the cost of each variant relative to the cheapest, sorted; inf where it failed.

    The share of entries up to a factor is the performance profile of Dolan and More (2002).
    Variants that no scheme solves to the target are left out.
    """
    names = dict.fromkeys(e.label for e in every)
    ratios: dict[str, list[float]] = {name: [] for name in names}
    for place in dict.fromkeys((e.case, e.variant) for e in every):
        here = {e.label: error_cost(e, target).cpu for e in every if (e.case, e.variant) == place}
        best = min((cpu for cpu in here.values() if cpu is not None), default=None)
        if best is not None:
            for name in names:
                cpu = here.get(name)
                ratios[name].append(math.inf if cpu is None else cpu / best)
    return {name: sorted(row) for name, row in ratios.items()}


def shares(ratios: Sequence[float]) -> list[float]:
    """The shares of variants solved within each of FACTORS, from a row of a profile."""
    return [sum(ratio <= factor for ratio in ratios) / len(ratios) for factor in FACTORS if ratios]
