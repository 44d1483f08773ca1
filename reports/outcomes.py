"""Outcomes of records as pages show them: a symbol, a word and a style class."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from vv.gate.judgement import counted as counted_by_outcome
from vv.gate.judgement import outcome, outcome_by
from vv.records.job_record import Record
from vv.records.outcomes import Outcome
from vv.records.quantity import MeasuredQuantity


@dataclass(frozen=True)
class ShownOutcome:
    """How an outcome is shown. look: good, known, idle, shown, odd or bad; bad and odd need
    attention."""

    key: Outcome
    symbol: str
    word: str
    look: str
    meaning: str

    @property
    def troubling(self) -> bool:
        """Whether someone must look at it."""
        return self.look in ("bad", "odd")


WORST_FIRST = (
    ShownOutcome(
        Outcome.ERROR, "‼", "error", "bad", "the code or its adapter stopped with an error"
    ),
    ShownOutcome(Outcome.DIVERGED, "∞", "diverged", "bad", "the result is not finite"),
    ShownOutcome(
        Outcome.TIMEOUT, "◷", "timeout", "bad", "stopped because it exceeded its time limit"
    ),
    ShownOutcome(
        Outcome.NOT_REPORTED, "?", "not reported", "bad", "it ran, but reported nothing to judge"
    ),
    ShownOutcome(
        Outcome.FAIL,
        "✗",
        "fail",
        "bad",
        "outside the tolerance, or the band of a known error",
    ),
    ShownOutcome(
        Outcome.NOT_CONSERVED,
        "≠",
        "not conserved",
        "bad",
        "its own energy balance shows created energy or a violated law",
    ),
    ShownOutcome(
        Outcome.XPASS, "!", "unexpected pass", "odd", "passes although a disagreement is on record"
    ),
    ShownOutcome(Outcome.NOT_RUN, "·", "not run", "odd", "planned, but not run"),
    ShownOutcome(
        Outcome.XFAIL,
        "≈",
        "known disagreement",
        "known",
        "fails within its band",
    ),
    ShownOutcome(
        Outcome.REFUSED,
        "⊘",
        "not supported",
        "idle",
        "the code cannot solve this problem as stated",
    ),
    ShownOutcome(
        Outcome.TOO_LONG,
        "…",
        "too long",
        "idle",
        "left out because the code would need too many steps",
    ),
    ShownOutcome(Outcome.NOT_INSTALLED, "○", "not installed", "idle", "the code was not found"),
    ShownOutcome(
        Outcome.BLOW_UP, "✸", "blow-up", "shown", "diverged in a map, where divergence is a result"
    ),
    ShownOutcome(
        Outcome.NO_REFERENCE,
        "◇",
        "shown only",
        "shown",
        "shown and not judged: there is no reference, or no tolerance for the class of method",
    ),
    ShownOutcome(Outcome.PASS, "✓", "pass", "good", "within the tolerance of its class of method"),
)
OUTCOMES = {known.key: known for known in WORST_FIRST}
RANKS = {known.key: rank for rank, known in enumerate(WORST_FIRST)}


def shown_outcome(record: Record) -> ShownOutcome:
    """The outcome of a record in the form in which it is shown."""
    return OUTCOMES[outcome(record)]


def shown_by(record: Record, one: MeasuredQuantity) -> ShownOutcome:
    """The outcome of a record by one of its quantities, in the form in which it is shown."""
    return OUTCOMES[outcome_by(record, (one,))]


def counted(records: Iterable[Record]) -> list[tuple[ShownOutcome, int]]:
    """(outcome, number of records) for each outcome of the records, worst first."""
    return _worst_first(counted_by_outcome(records))


def summed(shown: Iterable[ShownOutcome]) -> list[tuple[ShownOutcome, int]]:
    """(outcome, number) for each of these outcomes, worst first."""
    return _worst_first(Counter(one.key for one in shown))


def _worst_first(counts: Mapping[Outcome, int]) -> list[tuple[ShownOutcome, int]]:
    return [(OUTCOMES[key], counts[key]) for key in sorted(counts, key=RANKS.__getitem__)]
