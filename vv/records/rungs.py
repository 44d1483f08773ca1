"""The rungs of a scheme that differ in dt alone: order, floor, and the limit of small steps."""

from __future__ import annotations

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
from vv.records.reading import Record, error_of

FORMAL = 2.0  # no stepping scheme here is of higher order: what more was seen promises is chance


@dataclass(frozen=True)
class Point:
    """A rung: its knobs, its largest judged error, its CPU seconds.

    error None: it gave none that is finite. cpu: as timed, None where it was not; spread: of its
    repeats, relative. indicative: of the run that was judged, beside which others ran.
    """

    dt: float | None
    kn: float | None
    error: float | None
    cpu: float | None
    spread: float
    indicative: float


@dataclass(frozen=True)
class Floor:
    """The error a scheme does not get below, and how that was seen."""

    error: float
    why: str


@dataclass(frozen=True)
class Limit:
    """Where the final value of the first quantity goes as dt -> 0, from three steps or more.

    dt: the finest. model: how far the limit is off the exact value, None without a limit or an
    exact value; step: how far the finest is off the limit, not less than at order FORMAL; known:
    how well the limit is known, that times the factor of the grid convergence index. All over the
    quantity's scale.
    """

    dt: float
    found: Convergence | NoLimit
    model: float | None = None
    step: float | None = None
    known: float | None = None


@dataclass(frozen=True)
class Row:
    """The rungs of a scheme that differ in dt alone, coarsest first.

    order: of the rungs before the floor, None where they are too few. floor: of dt at this kn.
    """

    kn: float | None
    points: tuple[Point, ...]
    order: Order | None
    floor: Floor | None
    limit: Limit | None

    @property
    def errors(self) -> list[float]:
        """Those of the rungs that have one."""
        return [point.error for point in self.points if point.error is not None]


def row_of(kn: float | None, pile: Sequence[Record]) -> Row:
    """The row that records of one scheme and stiffness make, coarsest first."""
    points = tuple(map(_point, pile))
    known = [(p.dt, p.error) for p in points if p.dt and p.error]
    errors = [error for _, error in known]
    order = order_before_floor([dt for dt, _ in known], errors)
    why = f"two refinements of dt improved less than {LEAST_IMPROVEMENT:g} times"
    floor = Floor(min(errors), why) if count_before_floor(errors) < len(errors) else None
    return Row(kn, points, order, floor, _limit(pile))


def _point(record: Record) -> Point:
    cost = record["cost"]
    timed = cost["kind"] == "timed" and cost["solve_cpu"] > 0
    return Point(
        record["rung"]["dt"],
        record["rung"]["kn"],
        _error(record),
        cost["solve_cpu"] if timed else None,
        cost["spread"],
        cost["solve_cpu"],
    )


def _error(record: Record) -> float | None:
    """The largest error that is judged; None where one of them is missing."""
    errors = [error_of(entry) for entry in record["quantities"] if entry["judge"] == "exact"]
    finite = [error for error in errors if error is not None]
    return max(finite) if finite and len(finite) == len(errors) else None


def _limit(pile: Sequence[Record]) -> Limit | None:
    """What the final values of the three finest steps say, and how that meets the exact one."""
    ran = [r for r in pile if r["rung"]["dt"] and r["quantities"]][-3:]
    entries = [record["quantities"][0] for record in reversed(ran)]
    finals = [entry["figures"].get("final") for entry in entries]
    if len(finals) < 3 or None in finals:
        return None
    steps = tuple(record["rung"]["dt"] for record in reversed(ran))
    found, end, scale = (
        convergence(steps, tuple(finals)),
        entries[0].get("end"),
        entries[0]["scale"],
    )
    if isinstance(found, NoLimit) or not scale:
        return Limit(steps[0], found)
    model = None if end is None else abs(found.limit - end) / scale
    ratio = (steps[1] / steps[0]) ** min(found.order, FORMAL)
    step = abs(finals[1] - finals[0]) / (ratio - 1) / scale
    return Limit(steps[0], found, model, step, GCI_SAFETY_FACTOR * step)


def told(row: Row) -> str:
    """What a row shows of the model's error and of the step's, in words; empty if nothing."""
    said = [f"floor {row.floor.error:.1e}, {row.floor.why}"] if row.floor else []
    if row.limit and row.kn:
        said.append(_told(row.limit))
    return "; ".join(said)


def _told(limit: Limit) -> str:
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
        dt = record["rung"]["dt"]
        for entry in record["quantities"]:
            error = error_of(entry)
            if dt and error:
                points.setdefault(ladder(record, entry["name"]), []).append((dt, error))
    fitted = {
        key: observed_order(*map(list, zip(*pairs, strict=True))) for key, pairs in points.items()
    }
    return {key: order for key, order in fitted.items() if order is not None}


def ladder(record: Record, quantity: str) -> Key:
    """What the rungs that differ in dt alone have in common: all but dt, for one quantity."""
    names = ("case", "variant", "code", "scheme")
    return (*(record[name] for name in names), quantity, record["rung"]["kn"])
