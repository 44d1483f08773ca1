"""The words of `vv speed`: tables of costs, floors and limits, duels and profiles, line by line."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from vv.insight.accuracy_cost import (
    FACTORS,
    TARGETS,
    Duel,
    Reach,
    cheapest,
    front,
    profile,
    reach,
    shares,
)
from vv.insight.effort import Effort
from vv.records.rungs import Point, Row, describe


def tables(every: Sequence[Effort]) -> Iterator[str]:
    """Of each timed variant: what errors cost, floors, the front, and what to take for an error."""
    for place in dict.fromkeys((e.case, e.variant) for e in every):
        here = [e for e in every if (e.case, e.variant) == place]
        wide = max(len(e.label) for e in here)
        yield f"\n{place[0]}:{place[1]}: CPU seconds of the stepping loop to reach an error of"
        heads = "".join(f"{target:>10.0e}" for target in TARGETS)
        yield f"  {'':<{wide}}{heads}  {'best':>8}  order in dt"
        for one in here:
            costs = "".join(f"{_cost(reach(one, t)):>10}" for t in TARGETS)
            best = "-" if one.best is None else f"{one.best:.1e}"
            yield f"  {one.label:<{wide}}{costs}  {best:>8}  {_orders(one)}"
        yield from (line for one in here for line in _parts(one))
        yield f"  front: {'; '.join(_setting(name, p) for name, p in front(here))}"
        yield from (f"  for {target:g}: {_recommended(here, target)}" for target in TARGETS)


def _cost(reached: Reach) -> str:
    if reached.cpu is None:
        return "-"
    return f"{'<' if reached.bound else ''}{reached.cpu:.1e}"


def _orders(one: Effort) -> str:
    """The fitted orders, of each stiffness where there are several; of a floor there is none."""
    return ", ".join(text for row in one.rows if (text := _order(row)))


def _order(row: Row) -> str:
    at = f" at kn {row.kn:g}" if row.kn else ""
    if row.order:
        return f"{row.order.order:.2f} +- {row.order.spread:.2f}{at}"
    return f"floor{at}" if row.floor else ""


def _parts(one: Effort) -> Iterator[str]:
    """Its floor, and at each stiffness what of the error is the model's and what the step's."""
    if one.floor:
        yield f"  {one.label}: floor {one.floor.error:.1e}, {one.floor.why}"
    for row in one.rows:
        if row.kn and (text := describe(row)):
            yield f"  {one.label} at kn {row.kn:g}: {text}"


def _setting(name: str, point: Point) -> str:
    return f"{name} {_knobs(point)}".rstrip() + f", {point.error:.1e} in {point.cpu:.1e} s"


def _recommended(here: Sequence[Effort], target: float) -> str:
    """The cheapest timed rung of each code that is as accurate, cheapest code first."""
    return "; ".join(_setting(name, point) for name, point in cheapest(here, target)) or "nobody"


def fought(fights: Sequence[Duel]) -> Iterator[str]:
    """How our engines fare beside external codes."""
    if fights:
        yield "\nbest in-house engine against best external code: cost over cost"
    for one in fights:
        which = "stepping in time" if one.stepping else "any engine"
        place = f"  {one.case}:{one.variant} at {one.target:g}, {which}"
        if one.ratio is not None:
            loose = ", or more: their coarsest timed rung is better than asked" if one.loose else ""
            yield f"{place}: {one.ours} / {one.theirs} = {one.ratio:.2g}{loose}"
        elif one.ours:
            least = f"their least error is {one.least:.1e}" if one.least else "they have no error"
            can = "can get there: their floor" if one.floored else "gets there at these rungs"
            yield f"{place}: {one.ours}; no external code {can}, {least}"
        else:
            yield f"{place}: none of ours gets there{f'; {one.theirs} does' if one.theirs else ''}"


def profiles(every: Sequence[Effort]) -> Iterator[str]:
    """Of each scheme, the share of variants it solves within factors of the cheapest."""
    wide = max((len(e.label) for e in every), default=0)
    for target in TARGETS:
        yield f"\nshare of variants solved to {target:g} within a factor of the cheapest"
        yield f"  {'':<{wide}}{''.join(f'{factor:>8g}' for factor in FACTORS)}"
        for name, ratios in profile(every, target).items():
            cells = "".join(f"{100 * share:>7.0f}%" for share in shares(ratios))
            yield f"  {name:<{wide}}{cells}"


def indicative(every: Sequence[Effort]) -> Iterator[str]:
    """Of variants that were not timed: each rung's error and what its run took beside others."""
    for place in dict.fromkeys((e.case, e.variant) for e in every):
        here = [e for e in every if (e.case, e.variant) == place]
        wide = max(len(e.label) for e in here)
        yield (
            f"\n{place[0]}:{place[1]}: not timed; errors, and indicative seconds, "
            "measured while other jobs ran: do not form ratios of them; the last column is the "
            "order in dt"
        )
        for one in here:
            rungs = "; ".join(map(_indicative, one.points))
            yield f"  {one.label:<{wide}}  {rungs}  {_orders(one)}".rstrip()
        yield from (line for one in here for line in _parts(one))


def _indicative(point: Point) -> str:
    error = "no error" if point.error is None else f"{point.error:.1e}"
    return f"{_knobs(point)}{error} in ~{point.indicative:.0e} s"


def _knobs(point: Point) -> str:
    named = (("dt", point.dt), ("kn", point.kn))
    return "".join(f"{knob} {value:g} " for knob, value in named if value)


def beside(untimed: Sequence[str]) -> Iterator[str]:
    """Where to look for what is not timed."""
    if untimed:
        yield (
            f"\nnot timed: {', '.join(untimed)}, and other variants of the cases above; `vv speed "
            "CASE` sets their errors against indicative costs, with --level paper it times them"
        )
