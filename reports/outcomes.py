"""What a record came to: one outcome with a symbol, a word and a class of look for each."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from vv.gate.judgement import counted as counted_by_word
from vv.gate.judgement import outcome
from vv.records.reading import Record


@dataclass(frozen=True)
class Outcome:
    """How an outcome is shown. look: good, known, idle, odd or bad; bad and odd need attention."""

    key: str
    symbol: str
    word: str
    look: str
    meaning: str

    @property
    def troubling(self) -> bool:
        """Whether someone must look at it."""
        return self.look in ("bad", "odd")


WORST_FIRST = (
    Outcome("error", "‼", "error", "bad", "the code or its adapter stopped with an error"),
    Outcome("diverged", "∞", "diverged", "bad", "the result is not finite"),
    Outcome("timeout", "◷", "timeout", "bad", "stopped after its time was over"),
    Outcome("not reported", "?", "not reported", "bad", "it ran, but reported nothing to judge"),
    Outcome("fail", "✗", "fail", "bad", "outside the tolerance, or outside a known band"),
    Outcome("not conserved", "≠", "not conserved", "bad", "its energy ledger breaks a law"),
    Outcome("xpass", "!", "unexpected pass", "odd", "passes, though a disagreement is on record"),
    Outcome("not run", "·", "not run", "odd", "planned, but it never ran"),
    Outcome("xfail", "≈", "known disagreement", "known", "fails inside the band on record"),
    Outcome("refused", "⊘", "refused", "idle", "the code cannot do this honestly, and says so"),
    Outcome("too long", "…", "too long", "idle", "left out: it would take the code too many steps"),
    Outcome("not installed", "○", "not installed", "idle", "the code was not found"),
    Outcome("blow-up", "✸", "blow-up", "shown", "diverged in a map, which shows where codes do"),
    Outcome("no-reference", "◇", "no reference", "shown", "shown, with nothing to judge it by"),
    Outcome("pass", "✓", "pass", "good", "within the tolerance of its class of method"),
)
OUTCOMES = {known.key: known for known in WORST_FIRST}
RANKS = {known.key: rank for rank, known in enumerate(WORST_FIRST)}


def outcome_of(record: Record) -> Outcome:
    """The outcome of a record, as it is shown."""
    return OUTCOMES[outcome(record)]


def counted(records: Iterable[Record]) -> list[tuple[Outcome, int]]:
    """(outcome, how many) for the outcomes there are, worst first."""
    counts = counted_by_word(records)
    return [(OUTCOMES[key], counts[key]) for key in sorted(counts, key=RANKS.__getitem__)]
