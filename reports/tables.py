"""The rows of the report's tables, made from records: the matrix and the rungs."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from reports.marks import Mark
from reports.outcomes import Outcome, counted, outcome_of
from reports.text import slug
from vv.base.metrics import Order, order_before_floor
from vv.records.reading import Record, error_of, fineness, label

NORMS = {"max": "max", "final": "final", "pointwise": "pointwise", "l2": "L2"}


def anchor(record: Record) -> str:
    """The place in the page where the rungs of a record's scheme stand."""
    return slug(record["case"], record["variant"], label(record))


def margin(entry: Mapping[str, Any]) -> float | None:
    """Tolerance over error; None where either is missing or the error is zero."""
    error = error_of(entry)
    return entry["tolerance"] / error if error and entry["tolerance"] else None


@dataclass(frozen=True)
class Cell:
    """A cell of the matrix: the outcomes of all rungs, and the error at the finest."""

    anchor: str
    error: float | None
    quantity: str
    outcomes: Sequence[tuple[Outcome, int]]

    @property
    def worst(self) -> Outcome:
        """What colours the cell."""
        return self.outcomes[0][0]


def cell(records: Sequence[Record]) -> Cell:
    """One scheme's cell for one variant; records of its rungs, at least one."""
    finest = sorted(records, key=fineness)[-1]
    entries = finest["quantities"]
    worst = min(entries, key=lambda e: margin(e) or float("inf")) if entries else None
    return Cell(
        anchor(finest),
        error_of(worst) if worst else None,
        worst["name"] if worst and len(entries) > 1 else "",
        counted(records),
    )


@dataclass(frozen=True)
class Rung:
    """A row of a table of rungs; order: observed from the rung before to this one."""

    record: Record
    entry: Mapping[str, Any]
    outcome: Outcome
    order: float | None
    note: str

    @property
    def margin(self) -> float | None:
        """Tolerance over error."""
        return margin(self.entry)


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
        return bool(self.rungs[0].entry["kind"] != "series")


@dataclass(frozen=True)
class Absent:
    """Rungs of one scheme that gave nothing, all for one reason."""

    anchor: str
    mark: Mark
    outcome: Outcome
    steps: Sequence[float]
    reason: str


def groups(records: Sequence[Record], marks: Mapping[str, Mark]) -> list[Group]:
    """The tables of a variant's runs that ran: per scheme, quantity and contact stiffness."""
    piles: dict[tuple[str, str, float | None], list[tuple[Record, Mapping[str, Any]]]] = {}
    for record in sorted(records, key=fineness):
        for entry in record["quantities"]:
            key = (label(record), entry["name"], record["rung"]["kn"])
            piles.setdefault(key, []).append((record, entry))
    keys = sorted(piles, key=lambda key: (key[0], key[1], key[2] or 0.0))
    return [_group(marks[key[0]], key[2], piles[key]) for key in keys]


def _group(mark: Mark, kn: float | None, rows: Sequence[tuple[Record, Mapping[str, Any]]]) -> Group:
    points = [(r["rung"]["dt"], error_of(e)) for r, e in rows]
    notes = [[text for text in (r["reason"], e["note"]) if text] for r, e in rows]
    shared = notes[0] if all(said == notes[0] for said in notes) else []
    local = [None, *(_order(list(pair)) for pair in itertools.pairwise(points))]
    rungs = [
        Rung(
            record=record,
            entry=entry,
            outcome=outcome_of({**record, "quantities": [entry]}),
            order=step.order if step else None,
            note="" if shared else "; ".join(said),
        )
        for (record, entry), said, step in zip(rows, notes, local, strict=True)
    ]
    record, entry = rows[0]
    place = anchor(record)
    return Group(place, mark, entry["name"], entry["unit"], kn, rungs, _order(points), shared)


def _order(points: Sequence[tuple[float | None, float | None]]) -> Order | None:
    """The observed order in dt over points (dt, error), coarsest first, before their floor."""
    usable = [(dt, error) for dt, error in points if dt and error]
    return order_before_floor([dt for dt, _ in usable], [error for _, error in usable])


def absent(records: Sequence[Record], marks: Mapping[str, Mark]) -> list[Absent]:
    """What gave no quantity: one row per scheme, outcome and reason."""
    piles: dict[tuple[str, str, str], list[Record]] = {}
    for record in sorted(records, key=fineness):
        if not record["quantities"]:
            key = (label(record), outcome_of(record).key, record["reason"])
            piles.setdefault(key, []).append(record)
    return [
        Absent(
            anchor(pile[0]),
            marks[name],
            outcome_of(pile[0]),
            [r["rung"]["dt"] for r in pile if r["rung"]["dt"]],
            reason,
        )
        for (name, _, reason), pile in sorted(piles.items())
    ]
