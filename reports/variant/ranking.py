"""Ranks the schemes of a variant by error and by cost, and says why their colours differ."""

from __future__ import annotations

import functools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from reports import plain
from reports.book import Book, Place
from reports.marks import Mark
from reports.outcomes import ShownOutcome, counted, shown_outcome
from reports.text import brief, sci
from reports.variant.reading import anchor, judged_error, margin, nearest
from reports.variant.settings import observed_order
from vv.base.metrics import Order
from vv.records import codec
from vv.records.job_record import ModelSummary, Record
from vv.records.outcomes import StudyKind
from vv.records.rungs import only_rounding


@dataclass(frozen=True)
class Ranked:
    """A scheme in a variant: its error at the finest setting, and its worst outcome.

    why: of its worst setting, in plain words, with the setting and the command; empty if none.
    """

    anchor: str
    mark: Mark
    outcomes: Sequence[tuple[ShownOutcome, int]]
    ladder: bool
    error: float | None
    quantity: str
    tolerance: float | None
    method: str
    order: Order | None
    setting: str
    cpu: float | None
    timed: bool
    whole: bool
    unknowns: int | None
    model: ModelSummary | None
    balance: str
    why: str
    worst_setting: str
    command: str

    @property
    def worst(self) -> ShownOutcome:
        """The outcome that determines its colour."""
        return self.outcomes[0][0]


def ranked(piles: Mapping[str, Sequence[Record]], looks: Mapping[str, Mark]) -> list[Ranked]:
    """The schemes that attempted a variant, most accurate first; piles: label -> its records."""
    rows = [_ranked(pile, looks[label]) for label, pile in piles.items()]
    return sorted(rows, key=lambda row: (row.error is None, row.error or 0.0, row.mark.label))


@functools.lru_cache(maxsize=1)
def ranks(book: Book) -> dict[Place, list[Ranked]]:
    """(case, variant) -> its schemes, most accurate first: pages of cases and of codes show it."""
    return {place: ranked(piles, book.marks) for place, piles in book.ran.items()}


@dataclass(frozen=True)
class Dear:
    """A scheme in a variant by the cost of its finest setting. dearer: over the cheapest.

    whole: whether the cost is that of a whole process.
    """

    mark: Mark
    cpu: float
    timed: bool
    whole: bool
    dearer: float
    error: float | None
    setting: str


def cheapest(rows: Sequence[Ranked]) -> list[Dear]:
    """The schemes that attempted a variant and have a cost, cheapest first."""
    known = sorted((row.cpu, row.mark.label, row) for row in rows if row.cpu)
    return [
        Dear(row.mark, cpu, row.timed, row.whole, cpu / known[0][0], row.error, row.setting)
        for cpu, _, row in known
    ]


def _ranked(pile: Sequence[Record], mark: Mark) -> Ranked:
    measured = [record for record in pile if record.quantities]
    finest = measured[-1] if measured else pile[-1]
    one = nearest(finest)
    outcomes = counted(pile)
    bad = _worst_of(pile, outcomes[0][0])
    cost = finest.cost
    return Ranked(
        anchor=anchor(finest),
        mark=mark,
        outcomes=outcomes,
        ladder=finest.study is StudyKind.LADDER,
        error=judged_error(one),
        quantity=one.name if one and len(finest.quantities) > 1 else "",
        tolerance=one.tolerance if one else None,
        method=codec.word(finest.method).replace("-", " "),
        order=_order_of(pile, one.name) if one else None,
        setting=plain.setting(finest),
        cpu=cost.solve_cpu or None,
        timed=cost.timed,
        whole=cost.whole,
        unknowns=finest.model.unknowns if finest.model else None,
        model=finest.model,
        balance=_balance(finest),
        why=plain.reason(bad, outcomes[0][0].key) if bad else "",
        worst_setting=plain.setting(bad) if bad else "",
        command=plain.command(bad) if bad else "",
    )


def _worst_of(pile: Sequence[Record], worst: ShownOutcome) -> Record | None:
    """The record farthest out of bounds, which explains the colour; None if all is well.

    worst: the worst outcome in it.
    """
    if worst.look not in ("bad", "odd", "known"):
        return None
    own = [record for record in pile if shown_outcome(record).key is worst.key]
    return min(own, key=_closeness)


def _closeness(record: Record) -> float:
    one = nearest(record)
    return (margin(one) if one else None) or float("inf")


def _balance(record: Record) -> str:
    """The unaccounted energy of a run, and the bound that its scheme declares, in words."""
    ledger = record.ledger
    if ledger is None:
        return ""
    promised = "nothing promised" if ledger.bound is None else f"of {brief_j(ledger.bound)}"
    return f"off {brief_j(ledger.unaccounted)} {promised}"


def brief_j(energy: float) -> str:
    """An energy to two digits."""
    return f"{brief(float(f'{energy:.2g}'))} J"


def _order_of(pile: Sequence[Record], quantity: str) -> Order | None:
    """The observed order of a quantity at the stiffest springs, before its floor."""
    own = [r for r in pile if r.rung.kn == pile[-1].rung.kn]
    errors = [(r, one.error) for r in own if (one := r.quantity(quantity))]
    if only_rounding(errors):
        return None
    return observed_order([(r.rung.dt, error) for r, error in errors])


def why_colours_differ(rows: Sequence[Ranked]) -> str:
    """Why a scheme is green though its error is larger than one that is not; empty if none is."""
    green = [r for r in rows if r.worst.look == "good" and r.error and r.tolerance]
    for other in rows:
        if other.worst.look in ("known", "bad") and other.error and other.tolerance:
            for row in green:
                if (row.error or 0.0) > other.error:
                    return _difference(row, other)
    return ""


def _difference(row: Ranked, other: Ranked) -> str:
    def has(one: Ranked) -> str:
        return f"{one.mark.label} ({one.method}) has {sci(one.error, 1)} of {sci(one.tolerance, 1)}"

    why = f": {other.why}" if other.why else ""
    return (
        "Each scheme is judged by the tolerance of its class of method at its setting: "
        f"{has(row)} and passes; {has(other)} and is '{other.worst.word}'{why}"
    )
