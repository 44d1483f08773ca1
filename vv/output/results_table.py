"""The results of a run as a table: error, bound, order, cost and verdict of each scheme."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from vv.ask import Method
from vv.gate.judgement import outcome
from vv.output.wording import duration, in_words
from vv.records.finding import Finding
from vv.records.job_record import Record
from vv.records.outcomes import Outcome
from vv.records.quantity import MeasuredQuantity
from vv.records.reading import by_fineness, ran, settings, tried
from vv.records.rungs import row_of

ROWS = 60  # the most rows; if there are more, variants are counted instead
CLAIMED = {Method.SECOND_ORDER: 2, Method.FIRST_ORDER: 1}  # orders in dt
COUNTED = (
    "FAIL",
    "reported only",
    "known disagreement",
    "shown only",
    "pass",
)  # verdicts that are counted separately
STABLE = "stable to"  # before the step that a search found
NAMED = 2  # the most schemes of a code that a line names; more are counted
RANKS = (Outcome.XFAIL, Outcome.BLOW_UP, Outcome.PASS, Outcome.NO_REFERENCE)
Place = tuple[str, str, str]  # case, variant, scheme


@dataclass(frozen=True)
class Row:
    """A scheme on a variant, at its finest setting that ran.

    error, allowed: of the quantity closest to its bound; if none is judged, the largest error, and
    None; order: observed in dt; cpu: of the stepping loop [s], or of the whole process; timed:
    whether the cost was measured alone on a core; verdict: of the gate, over all settings.
    """

    place: Place
    setting: str
    error: float | None
    allowed: float | None
    order: float | None
    claimed: int | None
    cpu: float
    timed: bool
    whole: bool
    verdict: str


def rows(records: Iterable[Record], findings: Iterable[Finding]) -> list[Row]:
    """A row for each scheme on each variant that it supports, in the order of the records."""
    piles: dict[Place, list[Record]] = {}
    for record in filter(tried, records):
        piles.setdefault((record.case, record.variant, record.label), []).append(record)
    found: dict[Place, list[Finding]] = {}
    for one in findings:
        found.setdefault((one.case, one.variant, one.label), []).append(one)
    return [_row(place, pile, found.get(place, [])) for place, pile in piles.items()]


def _row(place: Place, pile: Sequence[Record], findings: Sequence[Finding]) -> Row:
    done = sorted(filter(ran, pile), key=by_fineness)
    verdict = _verdict(pile, findings)
    if not done:
        return Row(place, "", None, None, None, None, 0.0, False, False, verdict)
    finest = done[-1]
    known = [one for one in finest.quantities if one.error is not None]
    worst = max(known, key=_closeness, default=None)
    fitted = row_of(finest.rung.kn, [r for r in done if r.rung.kn == finest.rung.kn]).order
    return Row(
        place,
        _setting(finest),
        worst.error if worst else None,
        worst.tolerance if worst else None,
        fitted.order if fitted else None,
        CLAIMED.get(finest.method.general) if fitted else None,
        finest.cost.solve_cpu,
        finest.cost.timed,
        finest.cost.whole,
        verdict,
    )


def _setting(record: Record) -> str:
    """The knobs in short form, dt=5e-05,kn=1e+09; of a search with the step that it found."""
    knobs, found = record.rung, record.largest_step
    dt = (f"{STABLE} dt", found) if found else ("dt", knobs.dt)
    named = (dt, ("kn", knobs.kn), ("dd", knobs.dd))
    return ",".join(f"{name}={value:g}" for name, value in named if value is not None)


def _closeness(one: MeasuredQuantity) -> tuple[bool, float]:
    """Orders quantities: those that are judged by their errors over their bounds, then others."""
    return bool(one.tolerance), (one.error or 0.0) / (one.tolerance or 1.0)


def _verdict(pile: Sequence[Record], findings: Sequence[Finding]) -> str:
    """The verdict of the gate: red, or reported only, or the worst outcome in words."""
    if any(one.red for one in findings):
        return "FAIL"
    if any(one.bit for one in findings):
        return "reported only"
    came = {outcome(record) for record in pile}
    worst = next((one for one in RANKS if one in came), Outcome.PASS)
    return in_words(worst)


def table(records: Iterable[Record], findings: Iterable[Finding]) -> Iterator[str]:
    """The lines of the table; of many variants, one row for each scheme of a case."""
    given = list(records)
    every, modified = rows(given, findings), _modified(given)
    if len(every) > ROWS:
        yield from _summary(every)
        if modified:
            yield f"  (with changed parameters: {'; '.join(dict.fromkeys(modified.values()))})"
        return
    for place in dict.fromkeys(row.place[:2] for row in every):
        here = [row for row in every if row.place[:2] == place]
        mark = f" with {modified[place]}" if place in modified else ""
        yield from _of_variant(f"{place[0]}:{place[1]}{mark}", here)


def _modified(records: Iterable[Record]) -> dict[tuple[str, str], str]:
    """(case, variant) -> its changed parameters in words, where a user changed some."""
    return {(r.case, r.variant): ", ".join(settings(r)) for r in records if r.modified}


def _of_variant(title: str, here: Sequence[Row]) -> Iterator[str]:
    wide = max(24, *(len(row.place[2]) + 2 for row in here))
    far = max(10, *(len(row.setting) + 2 for row in here))
    claims = any(row.claimed for row in here)
    yield ""
    yield title
    yield (
        f"  {'scheme':<{wide}}{'setting':<{far}}{'error':>8} {'allowed':>8}"
        f"  {'order':<13}{'CPU':>9}  verdict"
    )
    for row in here:
        of = f" of {row.claimed}" if row.claimed else ""
        order = "-" if row.order is None else f"{row.order:.2f}{of}"
        yield (
            f"  {row.place[2]:<{wide}}{row.setting or '-':<{far}}{_short(row.error):>8} "
            f"{_short(row.allowed):>8}  {order:<13}{_cpu(row):>9}  {row.verdict}"
        ).rstrip()
    yield f"  {_legend(here, claims)}"


def _legend(here: Sequence[Row], claims: bool) -> str:
    sought = any(row.setting.startswith(STABLE) for row in here)
    parts = ["the largest step that was stable" if sought else "finest setting"]
    parts += ["order in dt: observed of claimed"] if claims else []
    beside = any(not row.timed and row.cpu for row in here)
    parts += ["~: timed while other jobs ran"] if beside else []
    parts += ["*: of the whole process"] if any(row.whole and row.cpu for row in here) else []
    return f"({'; '.join(parts)})"


def _cpu(row: Row) -> str:
    marks = "" if row.timed else "~", "*" if row.whole else ""
    return duration(row.cpu).join(marks) if row.cpu else "-"


def _short(value: float | None) -> str:
    return "-" if value is None else f"{value:.1e}"


def _summary(every: Sequence[Row]) -> Iterator[str]:
    """A row for each scheme: the number of variants by outcome, and the errors at the finest."""
    schemes: dict[str, list[Row]] = {}
    for row in every:
        schemes.setdefault(row.place[2], []).append(row)
    wide = max(len(name) + 2 for name in ("scheme", *schemes))
    yield ""
    heads = "".join(f"{head:>{len(head) + 2}}" for head in (*COUNTED, "other"))
    yield f"  {'scheme':<{wide}}{'variants':>8}{heads}{'error':>10}"
    for name, own in schemes.items():
        counts = [sum(row.verdict == head for row in own) for head in COUNTED]
        told = zip((*COUNTED, "other"), (*counts, len(own) - sum(counts)), strict=True)
        cells = "".join(f"{count or '-':>{len(head) + 2}}" for head, count in told)
        errors = [row.error for row in own if row.error is not None and row.allowed]
        middle = _short(float(np.median(errors))) if errors else "-"
        yield f"  {name:<{wide}}{len(own):>8}{cells}{middle:>10}"
    yield "  (error: the median of those judged, at the finest setting; `vv run CASE` shows each)"


def unsupported(records: Iterable[Record]) -> str:
    """One line on the schemes that refused everything; empty if there are none."""
    given = list(records)
    took = {record.label for record in filter(tried, given)}
    return by_outcome({r.label: outcome(r) for r in given if r.label not in took})


def by_outcome(outcomes: Mapping[str, Outcome]) -> str:
    """Schemes by their outcome, in a line. outcomes: CODE/SCHEME -> outcome."""
    parts = []
    for why in dict.fromkeys(outcomes.values()):
        names = [name for name, one in outcomes.items() if one is why]
        parts.append(f"{in_words(why)}: {', '.join(_by_code(names))}")
    return "; ".join(parts)


def _by_code(labels: Iterable[str]) -> list[str]:
    """Schemes by code: by name, or their number if a code has more than `NAMED`."""
    codes: dict[str, list[str]] = {}
    for label in labels:
        code, _, scheme = label.partition("/")
        codes.setdefault(code, []).append(scheme)
    return [
        f"{code} ({len(own)} schemes)"
        if len(own) > NAMED
        else ", ".join(f"{code}/{scheme}" for scheme in own)
        for code, own in codes.items()
    ]
