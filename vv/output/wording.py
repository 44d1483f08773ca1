"""Words for outcomes, durations and tolerances, and counts of outcomes in order of severity."""

from __future__ import annotations

from collections.abc import Mapping

from vv.case import LARGEST_TOLERANCE, Tolerance
from vv.records.case_facts import ToleranceFacts
from vv.records.outcomes import Outcome

WORDS = {  # the phrases for one result and for several
    Outcome.REFUSED: ("not supported", "not supported"),
    Outcome.BLOW_UP: ("blow-up to show", "blow-ups to show"),
    Outcome.XFAIL: ("known disagreement", "known disagreements"),
    Outcome.XPASS: ("unexpected pass", "unexpected passes"),
    Outcome.NO_REFERENCE: ("shown only", "shown only"),
}
FIRST = (Outcome.PASS, Outcome.FAIL, Outcome.NOT_CONSERVED, Outcome.XPASS, Outcome.XFAIL)
ORDER = {outcome: rank for rank, outcome in enumerate((*FIRST, Outcome.NO_REFERENCE))}


def in_words(outcome: Outcome, count: int = 1) -> str:
    """The phrase for an outcome, of one result or of several."""
    return WORDS.get(outcome, (outcome.value, outcome.value))[count != 1]


def duration(seconds: float) -> str:
    """A time to two digits in the unit that suits it: 91 ms, 2.4 s."""
    if not seconds > 0:
        return "0 s"
    for unit, size in (("s", 1.0), ("ms", 1e-3), ("us", 1e-6)):
        if seconds >= 0.995 * size:
            return f"{float(f'{seconds / size:.2g}'):g} {unit}"
    return f"{seconds / 1e-6:.2g} us"


def listed(counts: Mapping[Outcome, int]) -> str:
    """The outcomes with their counts in words, judged ones first."""
    ranked = sorted(counts, key=lambda one: (ORDER.get(one, len(ORDER)), one.value))
    return ", ".join(f"{counts[one]} {in_words(one, counts[one])}" for one in ranked)


def scaled(tolerance: Tolerance | ToleranceFacts) -> str:
    """The bound of a tolerance with all by which it changes: 1e-4 at dt = 1e-3 s, as dt^2."""
    one = tolerance
    parts = [f"{one.value:g}"]
    if one.dt:
        parts.append(f" at dt = {one.dt:g} s, as dt^{one.order}")
    if one.kn:
        parts.append(f"{',' * bool(one.dt)} at kn = {one.kn:g} N/m, as kn^-{one.softness:g}")
    if one.late:
        parts.append(f", plus {one.late:g} 1/s times dt")
    if one.floor and (one.dt or one.kn):
        parts.append(f", at least {one.floor:g}")
    if one.value > LARGEST_TOLERANCE:
        parts.append(f", cut at {LARGEST_TOLERANCE:g} at the case's own parameters and settings")
    return "".join(parts)
