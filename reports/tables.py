"""The rows of the report's tables, made from records: the matrix and the rungs."""

from __future__ import annotations

import dataclasses
import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from reports.marks import Mark
from reports.outcomes import ShownOutcome, counted, shown_outcome
from reports.text import slug
from vv.base.metrics import Order, order_before_floor
from vv.case import Norm
from vv.records.job_record import Record
from vv.records.outcomes import QuantityKind
from vv.records.quantity import MeasuredQuantity
from vv.records.reading import by_fineness

NORM_NAMES = {
    Norm.MAX: "max",
    Norm.FINAL: "final",
    Norm.POINTWISE: "pointwise",
    Norm.L2: "L2",
}
Measured = tuple[Record, MeasuredQuantity]


def anchor(record: Record) -> str:
    """The place in the page where the rungs of a record's scheme stand."""
    return slug(record.case, record.variant, record.label)


def margin(one: MeasuredQuantity) -> float | None:
    """Tolerance over error; None where either is missing or the error is zero."""
    return one.tolerance / one.error if one.error and one.tolerance else None


@dataclass(frozen=True)
class Cell:
    """A cell of the matrix: the outcomes of all rungs, and the error at the finest."""

    anchor: str
    error: float | None
    quantity: str
    outcomes: Sequence[tuple[ShownOutcome, int]]

    @property
    def worst(self) -> ShownOutcome:
        """What colours the cell."""
        return self.outcomes[0][0]


def cell(records: Sequence[Record]) -> Cell:
    """One scheme's cell for one variant; records of its rungs, at least one."""
    finest = sorted(records, key=by_fineness)[-1]
    measured = finest.quantities
    worst = min(measured, key=lambda one: margin(one) or float("inf")) if measured else None
    return Cell(
        anchor(finest),
        worst.error if worst else None,
        worst.name if worst and len(measured) > 1 else "",
        counted(records),
    )


@dataclass(frozen=True)
class Rung:
    """A row of a table of rungs; order: observed from the rung before to this one."""

    record: Record
    quantity: MeasuredQuantity
    outcome: ShownOutcome
    order: float | None
    note: str

    @property
    def margin(self) -> float | None:
        """Tolerance over error."""
        return margin(self.quantity)


@dataclass(frozen=True)
class Group:
    """The rungs of one scheme and quantity at one contact stiffness.

    order: fitted over those before a floor. notes: what all rows share, said once.
    """

    anchor: str
    mark: Mark
    quantity: str
    unit: str
    kn: float | None
    rungs: Sequence[Rung]
    order: Order | None
    notes: Sequence[str]

    @property
    def is_number(self) -> bool:
        """Whether the quantity has a single value, not a series."""
        return self.rungs[0].quantity.kind is not QuantityKind.SERIES


@dataclass(frozen=True)
class Absent:
    """Rungs of one scheme that gave nothing, all for one reason."""

    anchor: str
    mark: Mark
    outcome: ShownOutcome
    steps: Sequence[float]
    reason: str


def groups(records: Sequence[Record], marks: Mapping[str, Mark]) -> list[Group]:
    """The tables of a variant's runs that ran: per scheme, quantity and contact stiffness."""
    piles: dict[tuple[str, str, float | None], list[Measured]] = {}
    for record in sorted(records, key=by_fineness):
        for one in record.quantities:
            key = (record.label, one.name, record.rung.kn)
            piles.setdefault(key, []).append((record, one))
    keys = sorted(piles, key=lambda key: (key[0], key[1], key[2] or 0.0))
    return [_group(marks[key[0]], key[2], piles[key]) for key in keys]


def _group(mark: Mark, kn: float | None, rows: Sequence[Measured]) -> Group:
    points = [(r.rung.dt, one.error) for r, one in rows]
    notes = [[text for text in (r.reason, one.note) if text] for r, one in rows]
    shared = notes[0] if all(texts == notes[0] for texts in notes) else []
    local = [None, *(_order(list(pair)) for pair in itertools.pairwise(points))]
    rungs = [
        Rung(
            record=record,
            quantity=one,
            outcome=shown_outcome(dataclasses.replace(record, quantities=(one,))),
            order=step.order if step else None,
            note="" if shared else "; ".join(texts),
        )
        for (record, one), texts, step in zip(rows, notes, local, strict=True)
    ]
    record, one = rows[0]
    place = anchor(record)
    return Group(place, mark, one.name, one.unit, kn, rungs, _order(points), shared)


def _order(points: Sequence[tuple[float | None, float | None]]) -> Order | None:
    """The observed order in dt over points (dt, error), coarsest first, before their floor."""
    usable = [(dt, error) for dt, error in points if dt and error]
    return order_before_floor([dt for dt, _ in usable], [error for _, error in usable])


def absent(records: Sequence[Record], marks: Mapping[str, Mark]) -> list[Absent]:
    """What gave no quantity: one row per scheme, outcome and reason."""
    piles: dict[tuple[str, str, str], list[Record]] = {}
    for record in sorted(records, key=by_fineness):
        if not record.quantities:
            key = (record.label, shown_outcome(record).key.value, record.reason)
            piles.setdefault(key, []).append(record)
    return [
        Absent(
            anchor(pile[0]),
            marks[name],
            shown_outcome(pile[0]),
            [r.rung.dt for r in pile if r.rung.dt],
            reason,
        )
        for (name, _, reason), pile in sorted(piles.items())
    ]
