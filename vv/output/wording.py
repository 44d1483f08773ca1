"""Outcomes of results in the words that people read, counted and ranked."""

from __future__ import annotations

from collections.abc import Mapping

from vv.gate.judgement import NOT_CONSERVED

WORDS = {  # of one, and of many
    "blow-up": ("blow-up to show", "blow-ups to show"),
    "xfail": ("known disagreement", "known disagreements"),
    "xpass": ("unexpected pass", "unexpected passes"),
    "no-reference": ("shown only", "shown only"),
}
ORDER = ("pass", "fail", NOT_CONSERVED, "xpass", "xfail", "no-reference")


def in_words(outcome: str, count: int = 1) -> str:
    """What an outcome is called, of one result or of several."""
    return WORDS.get(outcome, (outcome, outcome))[count != 1]


def listed(counts: Mapping[str, int]) -> str:
    """Outcomes with how often each came, what was judged first."""
    ranked = sorted(counts, key=lambda word: (ORDER.index(word) if word in ORDER else 9, word))
    return ", ".join(f"{counts[word]} {in_words(word, counts[word])}" for word in ranked)
