"""The rows of the table of all settings of a variant: a group for each scheme and stiffness."""

from __future__ import annotations

import dataclasses
import itertools
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from reports.marks import Mark
from reports.outcomes import ShownOutcome, shown_by
from vv.base.metrics import Order, order_before_floor
from vv.records.job_record import Record
from vv.records.outcomes import QuantityKind
from vv.records.quantity import MeasuredQuantity
from vv.records.rungs import only_rounding

Measured = tuple[Record, MeasuredQuantity]
Point = tuple[float | None, float | None]  # a step and the error at it


@dataclass(frozen=True)
class Setting:
    """A row of the table of settings: one record and quantity. local: order from the one before."""

    record: Record
    quantity: MeasuredQuantity
    outcome: ShownOutcome
    local: float | None
    note: str


@dataclass(frozen=True)
class Group:
    """The settings of one scheme and quantity at one contact stiffness.

    order: fitted over those before a floor. notes: what all rows share, said once. titled: whether
    it needs a heading, or goes on below that of the stiffness before. first: whether it is of the
    first quantity of its scheme, with which the cost of a setting is told, which all others share.
    """

    mark: Mark
    quantity: str
    unit: str
    rows: Sequence[Setting]
    order: Order | None
    notes: Sequence[str]
    titled: bool = True
    first: bool = True

    @property
    def is_number(self) -> bool:
        """Whether the quantity has a single value, not a series."""
        return self.rows[0].quantity.kind is not QuantityKind.SERIES


def groups(piles: Mapping[str, Sequence[Record]], looks: Mapping[str, Mark]) -> list[Group]:
    """The groups of a variant's runs by scheme, quantity and contact stiffness."""
    found: dict[tuple[str, str, float | None], list[Measured]] = {}
    for label, pile in piles.items():
        for record in pile:
            for one in record.quantities:
                found.setdefault((label, one.name, record.rung.kn), []).append((record, one))
    keys = sorted(found, key=lambda key: (key[0], key[1], key[2] or 0.0))
    made = [_group(looks[key[0]], found[key]) for key in keys]
    pairs = zip([None, *made], made, strict=False)
    names: dict[str, str] = {}
    return [
        dataclasses.replace(
            one,
            titled=not _goes_on(before, one),
            first=names.setdefault(one.mark.label, one.quantity) == one.quantity,
        )
        for before, one in pairs
    ]


def _goes_on(before: Group | None, one: Group) -> bool:
    """Whether the heading of a group would repeat the one above."""
    known = before and (before.mark, before.quantity, before.notes)
    return known == (one.mark, one.quantity, one.notes) and one.order is None


def _group(mark: Mark, rows: Sequence[Measured]) -> Group:
    points = [(r.rung.dt, one.error) for r, one in rows]
    notes = [[text for text in (r.reason, one.note) if text] for r, one in rows]
    shared = notes[0] if all(texts == notes[0] for texts in notes) else []
    local = [None, *(_between(*pair) for pair in itertools.pairwise(points))]
    made = [
        Setting(
            record=record,
            quantity=one,
            outcome=shown_by(record, one),
            local=step,
            note="" if shared else "; ".join(texts),
        )
        for (record, one), texts, step in zip(rows, notes, local, strict=True)
    ]
    one = rows[0][1]
    order = None if only_rounding((r, q.error) for r, q in rows) else observed_order(points)
    return Group(mark, one.name, one.unit, made, order, shared)


def _between(coarse: Point, fine: Point) -> float | None:
    """The order between two settings; None if a step or an error is missing or equal."""
    (h, e), (less, left) = coarse, fine
    if not (h and e and less and left) or h == less or not math.isfinite(e * left):
        return None
    return math.log(e / left) / math.log(h / less)


def observed_order(points: Sequence[Point]) -> Order | None:
    """The observed order in dt over points (dt, error), coarsest first, before their floor."""
    usable = [(dt, error) for dt, error in points if dt and error]
    return order_before_floor([dt for dt, _ in usable], [error for _, error in usable])
