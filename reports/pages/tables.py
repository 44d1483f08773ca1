"""The rows of a variant's tables, made from records: schemes ranked, and all settings."""

from __future__ import annotations

import dataclasses
import itertools
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from reports import plain
from reports.marks import Mark
from reports.outcomes import ShownOutcome, counted, shown_outcome
from reports.text import brief, sci, slug
from vv.base.metrics import Order, order_before_floor
from vv.gate.judgement import outcome
from vv.records import codec
from vv.records.job_record import ModelSummary, Record
from vv.records.outcomes import JudgeKind, QuantityKind
from vv.records.quantity import MeasuredQuantity
from vv.records.reading import tried

Measured = tuple[Record, MeasuredQuantity]


def anchor(record: Record) -> str:
    """The place in a page where a scheme in a variant stands."""
    return slug(record.case, record.variant, record.label)


def margin(one: MeasuredQuantity) -> float | None:
    """Tolerance over error; None where either is missing or the error is zero."""
    return one.tolerance / one.error if one.error and one.tolerance else None


def judged_error(one: MeasuredQuantity | None) -> float | None:
    """The error of a quantity; None where its value is judged by an interval, not its error."""
    return None if one is None or one.judge is JudgeKind.INTERVAL else one.error


def nearest(record: Record) -> MeasuredQuantity | None:
    """The quantity of a record that is nearest to its tolerance, or farthest outside."""
    return min(record.quantities, key=lambda q: margin(q) or float("inf"), default=None)


@dataclass(frozen=True)
class Ranked:
    """A scheme in a variant: what it reached at its finest setting, and what came of all.

    why: of its worst setting, in plain words, with the setting and the command; empty if none.
    """

    anchor: str
    mark: Mark
    outcomes: Sequence[tuple[ShownOutcome, int]]
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
        """What colours it."""
        return self.outcomes[0][0]


def ranked(piles: Mapping[str, Sequence[Record]], looks: Mapping[str, Mark]) -> list[Ranked]:
    """The schemes that took a variant on, most accurate first; piles: label -> its records."""
    rows = [_ranked(pile, looks[label]) for label, pile in piles.items()]
    return sorted(rows, key=lambda row: (row.error is None, row.error or 0.0, row.mark.label))


@dataclass(frozen=True)
class Dear:
    """A scheme in a variant by what its finest setting costs. dearer: over the cheapest.

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
    """The schemes that took a variant on, cheapest first; those without a cost are left out."""
    known = sorted((row.cpu, row.mark.label, row) for row in rows if row.cpu)
    return [
        Dear(row.mark, cpu, row.timed, row.whole, cpu / known[0][0], row.error, row.setting)
        for cpu, _, row in known
    ]


def _ranked(pile: Sequence[Record], mark: Mark) -> Ranked:
    measured = [record for record in pile if record.quantities]
    finest = measured[-1] if measured else pile[-1]
    one = nearest(finest)
    bad = _worst_of(pile)
    cost = finest.cost
    return Ranked(
        anchor=anchor(finest),
        mark=mark,
        outcomes=counted(pile),
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
        why=plain.reason(bad, outcome(bad)) if bad else "",
        worst_setting=plain.setting(bad) if bad else "",
        command=plain.command(bad) if bad else "",
    )


def _worst_of(pile: Sequence[Record]) -> Record | None:
    """The record that explains the colour of a pile, farthest outside; None if all is well."""
    worst = counted(pile)[0][0]
    if worst.look not in ("bad", "odd", "known"):
        return None
    own = [record for record in pile if shown_outcome(record).key is worst.key]
    return min(own, key=_closeness)


def _closeness(record: Record) -> float:
    one = nearest(record)
    return (margin(one) if one else None) or float("inf")


def _balance(record: Record) -> str:
    """What the balance of energy of a run says."""
    ledger = record.ledger
    if ledger is None:
        return ""
    promised = (
        "nothing is promised" if ledger.bound is None else f"promised {brief_j(ledger.bound)}"
    )
    return f"Energy not accounted for: {brief_j(ledger.unaccounted)}; {promised}."


def brief_j(energy: float) -> str:
    """An energy to two digits."""
    return f"{brief(float(f'{energy:.2g}'))} J"


def _order_of(pile: Sequence[Record], quantity: str) -> Order | None:
    """The observed order of a quantity at the stiffest springs, before its floor."""
    own = [r for r in pile if r.rung.kn == pile[-1].rung.kn]
    return _order([(r.rung.dt, one.error) for r in own if (one := r.quantity(quantity))])


def _order(points: Sequence[tuple[float | None, float | None]]) -> Order | None:
    """The observed order in dt over points (dt, error), coarsest first, before their floor."""
    usable = [(dt, error) for dt, error in points if dt and error]
    return order_before_floor([dt for dt, _ in usable], [error for _, error in usable])


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
    it needs a heading, or goes on below that of the stiffness before.
    """

    mark: Mark
    quantity: str
    unit: str
    rows: Sequence[Setting]
    order: Order | None
    notes: Sequence[str]
    titled: bool = True

    @property
    def is_number(self) -> bool:
        """Whether the quantity has a single value, not a series."""
        return self.rows[0].quantity.kind is not QuantityKind.SERIES


def groups(piles: Mapping[str, Sequence[Record]], looks: Mapping[str, Mark]) -> list[Group]:
    """The tables of a variant's runs that ran: per scheme, quantity and contact stiffness."""
    found: dict[tuple[str, str, float | None], list[Measured]] = {}
    for label, pile in piles.items():
        for record in pile:
            for one in record.quantities:
                found.setdefault((label, one.name, record.rung.kn), []).append((record, one))
    keys = sorted(found, key=lambda key: (key[0], key[1], key[2] or 0.0))
    made = [_group(looks[key[0]], found[key]) for key in keys]
    pairs = zip([None, *made], made, strict=False)
    return [dataclasses.replace(one, titled=not _goes_on(before, one)) for before, one in pairs]


def _goes_on(before: Group | None, one: Group) -> bool:
    """Whether all that a heading of a group would say stands above it already."""
    known = before and (before.mark, before.quantity, before.notes)
    return known == (one.mark, one.quantity, one.notes) and one.order is None


def _group(mark: Mark, rows: Sequence[Measured]) -> Group:
    points = [(r.rung.dt, one.error) for r, one in rows]
    notes = [[text for text in (r.reason, one.note) if text] for r, one in rows]
    shared = notes[0] if all(texts == notes[0] for texts in notes) else []
    local = [None, *(_order(list(pair)) for pair in itertools.pairwise(points))]
    made = [
        Setting(
            record=record,
            quantity=one,
            outcome=shown_outcome(dataclasses.replace(record, quantities=(one,))),
            local=step.order if step else None,
            note="" if shared else "; ".join(texts),
        )
        for (record, one), texts, step in zip(rows, notes, local, strict=True)
    ]
    one = rows[0][1]
    return Group(mark, one.name, one.unit, made, _order(points), shared)


@dataclass(frozen=True)
class Absent:
    """Settings of one scheme that gave nothing, all for one reason.

    anchor: the scheme's place, if nothing else of it has that. whole: whether nothing of it ran.
    """

    anchor: str
    mark: Mark
    outcome: ShownOutcome
    settings: Sequence[str]
    reason: str
    whole: bool


def absent(piles: Mapping[str, Sequence[Record]], looks: Mapping[str, Mark]) -> list[Absent]:
    """What gave no quantity: one row per scheme, outcome and reason."""
    rows: dict[tuple[str, str, str], list[Record]] = {}
    for label, pile in piles.items():
        for record in pile:
            if not record.quantities:
                key = (label, shown_outcome(record).key.value, record.reason)
                rows.setdefault(key, []).append(record)
    anchored = {label for label, pile in piles.items() if any(map(tried, pile))}
    found = []
    for (label, _, why), pile in rows.items():
        place = "" if label in anchored else anchor(pile[0])
        whole = not any(map(tried, piles[label]))
        settings = [text for r in pile if (text := plain.setting(r))]
        found.append(Absent(place, looks[label], shown_outcome(pile[0]), settings, why, whole))
        anchored.add(label)
    return found


@dataclass(frozen=True)
class Silent:
    """Schemes of which nothing ran, all for one reason. marks: the place of each, and its look."""

    outcome: ShownOutcome
    reason: str
    marks: Sequence[tuple[str, Mark]]


def silent(rows: Sequence[Absent]) -> list[Silent]:
    """Those of which nothing ran, a row for each reason."""
    found: dict[tuple[ShownOutcome, str], list[tuple[str, Mark]]] = {}
    for row in rows:
        if row.whole:
            reason = row.reason.removeprefix(f"{row.mark.label} does not support: ")
            found.setdefault((row.outcome, reason), []).append((row.anchor, row.mark))
    return [Silent(outcome, reason, marks) for (outcome, reason), marks in found.items()]


@dataclass(frozen=True)
class Modelled:
    """Schemes that modelled a scene in the same way, and how; or what all of a code share."""

    note: str
    rows: Sequence[Ranked]
    code: str = ""


def models(rows: Sequence[Ranked]) -> list[Modelled]:
    """How the schemes modelled a scene, a row for each way."""
    piles: dict[str, list[tuple[list[str], Ranked]]] = {}
    for row in rows:
        if row.model:
            said = (row.model.note or "as the scene states it").split("; ")
            clauses = [*said, f"unknowns: {row.model.unknowns}"]
            piles.setdefault(row.mark.code, []).append((clauses, row))
    return [model for pile in piles.values() for model in _models(pile)]


def _models(pile: Sequence[tuple[list[str], Ranked]]) -> Iterator[Modelled]:
    """Those of one code: what all its schemes have in common stands once."""
    common = [c for c in pile[0][0] if all(c in clauses for clauses, _ in pile)]
    found: dict[str, list[Ranked]] = {}
    for clauses, row in pile:
        own = clauses if len(pile) == 1 else [c for c in clauses if c not in common]
        found.setdefault("; ".join(own), []).append(row)
    if len(found) == 1:
        yield Modelled("; ".join(pile[0][0]), [row for _, row in pile])
        return
    if common:
        yield Modelled("; ".join(common), [], pile[0][1].mark.code)
    yield from (Modelled(note or "nothing else", own) for note, own in found.items())
