"""Convergence in dt of the rungs of a scheme: observed order, floor, and limit of small steps."""

from __future__ import annotations

import functools
import sys
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from vv.base.metrics import (
    GCI_SAFETY_FACTOR,
    LEAST_IMPROVEMENT,
    Convergence,
    NoLimit,
    Order,
    convergence,
    count_before_floor,
    observed_order,
    order_before_floor,
)
from vv.records.job_record import Record
from vv.records.outcomes import JudgeKind

EPSILON = sys.float_info.epsilon  # a step rounds by half of it or less, and several times
FORMAL = 2.0  # no scheme here has a higher formal order; a higher observed one is accidental


@dataclass(frozen=True)
class Point:
    """A rung: its knobs, its largest judged error, its CPU seconds.

    error: None if it is not finite. cpu: the timed cost, None if untimed; spread: the relative
    spread of its repeats. indicative: the cost of the judged run, measured while other jobs ran.
    """

    dt: float | None
    kn: float | None
    error: float | None
    cpu: float | None
    spread: float
    indicative: float


@dataclass(frozen=True)
class Floor:
    """The smallest error that a scheme reaches, and how this was determined."""

    error: float
    why: str


@dataclass(frozen=True)
class Limit:
    """The limit of the final value of the first quantity as dt -> 0, from three steps or more.

    dt: the finest step. model: the distance of the limit from the exact value, None without a limit
    or an exact value; step: the distance of the finest value from the limit, at least that for
    order FORMAL; known: the uncertainty of the limit, `step` times the factor of the grid
    convergence index. All are relative to the scale of the quantity.
    """

    dt: float
    found: Convergence | NoLimit
    model: float | None = None
    step: float | None = None
    known: float | None = None


@dataclass(frozen=True)
class Row:
    """The rungs of a scheme that differ in dt alone, coarsest first.

    pile: the records of the points, from which the properties are computed.
    """

    kn: float | None
    points: tuple[Point, ...]
    pile: tuple[Record, ...]

    @functools.cached_property
    def order(self) -> Order | None:
        """The order in dt of the rungs before the floor; None if there are too few.

        Nor is there one where all errors are rounding.
        """
        if only_rounding(zip(self.pile, (p.error for p in self.points), strict=True)):
            return None
        known = self._known
        return order_before_floor([dt for dt, _ in known], [error for _, error in known])

    @functools.cached_property
    def floor(self) -> Floor | None:
        """The floor of dt at this kn; None if smaller steps still help."""
        errors = [error for _, error in self._known]
        if count_before_floor(errors) == len(errors):
            return None
        why = f"two refinements of dt improved less than {LEAST_IMPROVEMENT:g} times"
        return Floor(min(errors), why)

    @functools.cached_property
    def limit(self) -> Limit | None:
        """The limit of small steps at this kn."""
        return _limit(self.pile)

    @property
    def _known(self) -> list[tuple[float, float]]:
        """(dt, error) of the rungs that have both."""
        return [(p.dt, p.error) for p in self.points if p.dt and p.error]

    @property
    def errors(self) -> list[float]:
        """The errors of the rungs that have one."""
        return [point.error for point in self.points if point.error is not None]


def only_rounding(errors: Iterable[tuple[Record, float | None]]) -> bool:
    """Whether none of these errors exceeds what rounding in each step of its run may sum up to.

    A fit to such errors says nothing of the method.
    """
    return all(error is None or error <= run.steps * EPSILON for run, error in errors)


def row_of(kn: float | None, pile: Sequence[Record]) -> Row:
    """The row of the records of one scheme and stiffness, coarsest first."""
    return Row(kn, tuple(map(_point, pile)), tuple(pile))


def _point(record: Record) -> Point:
    cost = record.cost
    cpu = cost.solve_cpu if cost.timed and cost.solve_cpu > 0 else None
    dt, kn = record.rung.dt, record.rung.kn
    return Point(dt, kn, _error(record), cpu, cost.spread, cost.solve_cpu)


def _error(record: Record) -> float | None:
    """The largest judged error; None if one of the errors is missing."""
    errors = [one.error for one in record.quantities if one.judge is JudgeKind.EXACT]
    finite = [error for error in errors if error is not None]
    return max(finite) if finite and len(finite) == len(errors) else None


def _limit(pile: Sequence[Record]) -> Limit | None:
    """The limit from the final values of the three finest steps, compared with the exact one."""
    ran = [(r.rung.dt, r.quantities[0]) for r in pile if r.rung.dt and r.quantities][:-4:-1]
    rows = [(dt, final) for dt, one in ran if (final := one.figures.get("final")) is not None]
    if len(rows) < 3:
        return None
    (h1, f1), (h2, f2), (h3, f3) = rows
    found, finest = convergence((h1, h2, h3), (f1, f2, f3)), ran[0][1]
    end, scale = finest.end, finest.scale
    if isinstance(found, NoLimit) or not scale:
        return Limit(h1, found)
    model = None if end is None else abs(found.limit - end) / scale
    step = abs(f2 - f1) / ((h2 / h1) ** min(found.order, FORMAL) - 1) / scale
    return Limit(h1, found, model, step, GCI_SAFETY_FACTOR * step)


def describe(row: Row) -> str:
    """The model error and the time-step error of a row, in words; empty if it shows none."""
    parts = [f"floor {row.floor.error:.1e}, {row.floor.why}"] if row.floor else []
    if row.limit and row.kn:
        parts.append(_describe_limit(row.limit))
    return "; ".join(parts)


def _describe_limit(limit: Limit) -> str:
    if isinstance(limit.found, NoLimit):
        return f"final value: no limit of small steps, {limit.found.reason}"
    step = (
        f"the step's part {limit.step:.1e} at dt = {limit.dt:g}, of order {limit.found.order:.2f}"
    )
    if limit.model is None or limit.known is None:
        return f"final value: {step}"
    if limit.model <= limit.known:
        return f"final value: the model's part below {limit.known:.1e}, {step}"
    return f"final value: limit of small steps {limit.model:.1e} off the exact, {step}"


Key = tuple[str | float | None, ...]


def orders(records: Iterable[Record]) -> dict[Key, Order]:
    """Observed order in dt on each ladder, where its rungs allow a fit."""
    points: dict[Key, list[tuple[float, float]]] = {}
    for record in records:
        dt = record.rung.dt
        for one in record.quantities:
            if dt and one.error:
                points.setdefault(ladder(record, one.name), []).append((dt, one.error))
    fitted = {
        key: observed_order(*map(list, zip(*pairs, strict=True))) for key, pairs in points.items()
    }
    return {key: order for key, order in fitted.items() if order is not None}


def ladder(record: Record, quantity: str) -> Key:
    """The key of a ladder for one quantity: everything except dt."""
    return record.case, record.variant, record.code, record.scheme, quantity, record.rung.kn
