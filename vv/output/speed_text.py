"""Writes the tables of `vv speed`: the cost of an error in each code; its JSON has all figures.

Durations are CPU time of the stepping loop.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from vv.insight.accuracy_cost import (
    FACTORS,
    TARGETS,
    ErrorCost,
    cheapest,
    error_cost,
    profile,
    shares,
)
from vv.insight.effort import Effort
from vv.output.wording import duration
from vv.records.job_record import Record
from vv.records.rungs import Point

PROFILED = 1e-3  # the error for which codes are compared over many variants; the JSON has all
NOTES = (
    "* cheapest; costs in the table are interpolated between timed settings; <: upper bound, since",
    "the coarsest timed setting is already more accurate; -: not reached; least: smallest error;",
    "floor: finer settings do not reduce the error further; take: the cheapest timed setting",
    "whose error does not exceed the one asked for",
)


def tables(every: Sequence[Effort]) -> Iterator[str]:
    """For each timed variant: the cost of errors in each scheme, and the recommended settings."""
    for place in dict.fromkeys((e.case, e.variant) for e in every):
        here = [e for e in every if (e.case, e.variant) == place]
        wide = max(8, *(len(e.label) for e in here))
        yield ""
        yield f"{place[0]}:{place[1]}: CPU time of the stepping loop to reach an error of"
        heads = "".join(f"{target:>11.0e}" for target in TARGETS)
        yield f"  {'scheme':<{wide}}{heads}{'least':>10}        order in dt"
        costs = [[error_cost(one, target) for target in TARGETS] for one in here]
        best = [_least(column) for column in zip(*costs, strict=True)]
        for one, row in zip(here, costs, strict=True):
            cells = "".join(f"{_cost(r, b):>11}" for r, b in zip(row, best, strict=True))
            least = "-" if one.best is None else f"{one.best:.1e}"
            floor = "floor" if one.floor else ""
            yield f"  {one.label:<{wide}}{cells}{least:>10} {floor:<6} {_order(one)}".rstrip()
        yield from _advice(here)
    if every:
        yield from ("", *NOTES)


def _least(column: Sequence[ErrorCost]) -> float | None:
    return min((reached.cpu for reached in column if reached.cpu is not None), default=None)


def _cost(reached: ErrorCost, best: float | None) -> str:
    if reached.cpu is None:
        return "-"
    mark = "*" if reached.cpu == best else ""
    return f"{'<' if reached.bound else ''}{duration(reached.cpu)}{mark}"


def _order(one: Effort) -> str:
    """The fitted order, if no stiffness limits the error too; the JSON has that of each."""
    fitted = [row.order for row in one.rows if row.order and not row.kn]
    return f"{fitted[-1].order:.2f}" if fitted else "-"


def _advice(here: Sequence[Effort]) -> Iterator[str]:
    """The cheapest timed setting of all for each error; errors with one answer in one line."""
    told: dict[str, list[str]] = {}
    for target in TARGETS:
        for name, point in cheapest(here, target)[:1]:
            error = "-" if point.error is None else f"{point.error:.1e}"
            spent = duration(point.cpu or 0.0)
            text = f"{name}{_setting(point)}: error {error} in {spent}"
            told.setdefault(text, []).append(f"{target:.0e}")
    for text, targets in told.items():
        yield f"  for {', '.join(targets)} take, of timed settings, {text}"


def _setting(point: Point) -> str:
    named = (("dt", point.dt, "s"), ("kn", point.kn, "N/m"))
    known = [f"{knob} = {value:g} {unit}" for knob, value, unit in named if value]
    return f" at {', '.join(known)}" if known else ""


def profiles(every: Sequence[Effort]) -> Iterator[str]:
    """Of each scheme, the share of variants it solves within factors of the cheapest."""
    if len({(e.case, e.variant) for e in every}) < 2:
        return
    found = profile(every, PROFILED)
    count = max(map(len, found.values()), default=0)
    wide = max(8, *(len(name) for name in found))
    yield ""
    yield (
        f"share of the {count} variants that some scheme solves to {PROFILED:g}, at a cost within "
        "a factor of the cheapest"
    )
    yield f"  {'scheme':<{wide}}{''.join(f'{factor:>8g}' for factor in FACTORS)}"
    for name, ratios in sorted(found.items(), key=lambda item: [-s for s in shares(item[1])]):
        cells = "".join(f"{100 * share:>7.0f}%" for share in shares(ratios))
        yield f"  {name:<{wide}}{cells}"


def indicative(every: Sequence[Effort]) -> Iterator[str]:
    """Of variants that were not timed: the error of each scheme's most accurate setting."""
    for place in dict.fromkeys((e.case, e.variant) for e in every):
        here = [e for e in every if (e.case, e.variant) == place]
        wide = max(8, *(len(e.label) for e in here))
        yield ""
        yield (
            f"{place[0]}:{place[1]}: not timed; errors, and indicative costs, measured while "
            "other jobs ran"
        )
        yield f"  {'scheme':<{wide}}{'error':>10}{'cost':>10}  {'order':<6}setting"
        for one in here:
            points = [p for p in one.points if p.error is not None]
            best = min(points, key=lambda p: p.error or 0.0)
            spent = f"~{duration(best.indicative)}"
            setting = _setting(best).removeprefix(" at ")
            row = f"  {one.label:<{wide}}{best.error:>10.1e}{spent:>10}  {_order(one):<6}{setting}"
            yield row.rstrip()


def whole(records: Iterable[Record]) -> Iterator[str]:
    """The schemes whose programs do not report the cost of their steps alone."""
    for label in sorted({record.label for record in records if record.cost.whole}):
        yield f"{label}: its costs are those of whole processes, start and output included"


def beside(untimed: Sequence[str]) -> Iterator[str]:
    """A note on variants that are not timed."""
    if untimed:
        yield (
            f"\nnot timed: {', '.join(untimed)}, and other variants of the cases above; `vv speed "
            "CASE` shows their errors and indicative costs; with --level paper it times them"
        )
