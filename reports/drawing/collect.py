"""Collects the data of figures from records and their series."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from reports.marks import Mark
from reports.outcomes import shown_outcome
from vv.base.metrics import Vector
from vv.records.job_record import Record
from vv.records.reading import by_fineness, too_long, tried

Arrays = Callable[[str], Mapping[str, Vector]]


@dataclass(frozen=True, eq=False)
class History:
    """A code's answer over time at its finest rung; reference None where there is none."""

    mark: Mark
    dt: float | None
    t: Vector
    value: Vector
    reference: Vector | None


@dataclass(frozen=True)
class Point:
    """A rung of a ladder; error: None if it is not finite."""

    dt: float | None
    error: float | None
    cpu: float
    timed: bool
    troubling: bool
    refused: bool = False
    too_long: bool = False
    whole: bool = False


@dataclass(frozen=True)
class Ladder:
    """The points of one code/scheme with one setting of all knobs but dt, coarsest first."""

    mark: Mark
    kn: float | None
    points: tuple[Point, ...]


def histories(
    records: Sequence[Record], quantity: str, marks: Mapping[str, Mark], arrays: Arrays
) -> list[History]:
    """The series of each scheme at its finest rung that ran, if the store still has it."""
    found = []
    for name, pile in _by_label(records).items():
        ran = [r for r in pile if r.quantity(quantity)]
        kept = arrays(ran[-1].key) if ran else {}
        value, t = kept.get(f"{quantity}.value"), kept.get("t")
        if value is not None and t is not None:
            reference = kept.get(f"{quantity}.reference")
            found.append(History(marks[name], ran[-1].rung.dt, t, value, reference))
    return found


def ladders(records: Sequence[Record], quantity: str, marks: Mapping[str, Mark]) -> list[Ladder]:
    """Each scheme's errors against the step; one ladder per contact stiffness."""
    found = []
    for name, pile in _by_label(records).items():
        for kn in dict.fromkeys(record.rung.kn for record in pile):
            rungs = [record for record in pile if record.rung.kn == kn]
            points = tuple(_point(record, quantity) for record in rungs)
            found.append(Ladder(marks[name], kn, points))
    return found


def same_curve(one: Sequence[History], other: Sequence[History]) -> bool:
    """Whether two variants have the same reference up to its sign, so that one plot is enough."""
    first, second = (next(iter(h), None) for h in (one, other))
    if first is None or second is None or first.reference is None or second.reference is None:
        return False
    a, b = np.abs(first.reference), np.abs(second.reference)
    return a.shape == b.shape and bool(np.allclose(a, b, rtol=1e-9, atol=1e-9 * a.max()))


def _by_label(records: Iterable[Record]) -> dict[str, list[Record]]:
    piles: dict[str, list[Record]] = {}
    for record in sorted(records, key=by_fineness):
        piles.setdefault(record.label, []).append(record)
    return dict(sorted(piles.items()))


def _point(record: Record, quantity: str) -> Point:
    one = record.quantity(quantity)
    return Point(
        record.rung.dt,
        one.error if one else None,
        record.cost.solve_cpu,
        record.cost.timed,
        shown_outcome(record).troubling,
        not tried(record),
        too_long(record),
        record.cost.whole,
    )
