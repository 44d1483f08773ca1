"""The command that says what accuracy costs: `vv speed`."""

from __future__ import annotations

import dataclasses
import json
import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Annotated, Any

import typer

from vv import effort
from vv.cli import options
from vv.cli.invocation import answered
from vv.effort import TARGETS, Duel, Effort, Point, Reach
from vv.gate import RUN_BITS, exit_bits
from vv.plan import Options, Plan, restricted
from vv.project import find
from vv.screen import say
from vv.settings import UsageError
from vv.store import deliver

FACTORS = (1.0, 2.0, 10.0, 100.0, 1e4)


def speed(
    selection: options.Selection = None,
    codes: options.Codes = "*",
    fresh: options.Fresh = False,
    jobs: options.Jobs = 0,
    timeout: options.Timeout = options.TIMEOUT,
    json_file: Annotated[
        Path | None, typer.Option("--json", metavar="FILE", help="Write all that is shown.")
    ] = None,
) -> None:
    """Time the cases that ask for it, and say what an error costs in each code."""
    from vv.session import Limits, Timing

    project = find()

    def make_plan() -> Plan:
        whole = options.plan_of(project, selection or [], Options(codes=options.codes(codes)))
        timed = {(job.case, job.variant) for job in whole.jobs if job.timed}
        plan = restricted(whole, lambda job: (job.case, job.variant) in timed)
        if not plan.jobs:
            raise UsageError("nothing selected is timed; `vv speed` alone times all that is")
        return plan

    limits = Limits(options.workers(jobs), options.positive(timeout), fresh, Timing.STORED)
    manifest = answered(project, make_plan, limits, None)
    every = effort.efforts(manifest)
    fights = effort.duels(every, TARGETS)
    failed = [f"not timed, it failed: {name}" for name in manifest["untimed"]]
    for line in (*_tables(every), *failed, *_fought(fights), *_profiles(every)):
        say(line)
    if json_file:
        deliver(json_file, json.dumps(_document(every, fights), allow_nan=False).encode())
    raise typer.Exit(exit_bits(manifest["records"]) & RUN_BITS)


def _tables(every: Sequence[Effort]) -> Iterator[str]:
    for place in dict.fromkeys((e.case, e.variant) for e in every):
        here = [e for e in every if (e.case, e.variant) == place]
        wide = max(len(e.label) for e in here)
        yield f"\n{place[0]}:{place[1]}: CPU seconds of the stepping loop to reach an error of"
        heads = "".join(f"{target:>10.0e}" for target in TARGETS)
        yield f"  {'':<{wide}}{heads}  {'best':>8}  order in dt"
        for one in here:
            costs = "".join(f"{_cost(effort.reach(one, t)):>10}" for t in TARGETS)
            best = "-" if one.best is None else f"{one.best:.1e}"
            yield f"  {one.label:<{wide}}{costs}  {best:>8}  {_orders(one)}"
        yield from (f"  {one.label}: floor {_floor(one)}" for one in here if one.floor)
        yield from (line for one in here for line in _parts(one))
        yield f"  front: {'; '.join(_setting(name, p) for name, p in effort.front(here))}"
        yield from (f"  for {target:g}: {_recommended(here, target)}" for target in TARGETS)


def _cost(reached: Reach) -> str:
    if reached.cpu is None:
        return "-"
    return f"{'<' if reached.bound else ''}{reached.cpu:.1e}"


def _orders(one: Effort) -> str:
    """The fitted orders, of each stiffness where there are several."""
    return ", ".join(
        f"{order.order:.2f} +- {order.spread:.2f}{f' at kn {kn:g}' if kn else ''}"
        for kn, order in one.orders
    )


def _floor(one: Effort) -> str:
    return f"{one.floor.error:.1e}: {one.floor.why}" if one.floor else ""


def _parts(one: Effort) -> Iterator[str]:
    """Where a stiffness stands for rigid contact: how much of the error is the step's."""
    for kn, limit in one.limits:
        finest = [p for p in one.points if p.kn == kn and p.error is not None][-1:]
        if kn and finest and finest[0].error is not None:
            yield (
                f"  {one.label} at kn {kn:g}: error {finest[0].error:.1e} at dt {finest[0].dt:g}; "
                f"the step's own part by the grid convergence index {limit.fine:.1e}"
            )


def _setting(name: str, point: Point) -> str:
    knobs = [f"{knob} {value:g}" for knob, value in (("dt", point.dt), ("kn", point.kn)) if value]
    return f"{' '.join([name, *knobs])}, {point.error:.1e} in {point.cpu:.1e} s"


def _recommended(here: Sequence[Effort], target: float) -> str:
    """The cheapest timed rung of each code that is as accurate, cheapest code first."""
    found = [(e.label, effort.reach(e, target).point) for e in here]
    able = sorted(
        ((p.cpu, name, p) for name, p in found if p is not None and p.cpu is not None),
        key=lambda row: row[:2],
    )
    first: dict[str, str] = {}
    for _, name, point in able:
        first.setdefault(name.partition("/")[0], _setting(name, point))
    return "; ".join(first.values()) or "nobody"


def _fought(fights: Sequence[Duel]) -> Iterator[str]:
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
            yield f"{place}: {one.ours}; no external code gets there at these rungs, {least}"
        else:
            yield f"{place}: none of ours gets there{f'; {one.theirs} does' if one.theirs else ''}"


def _profiles(every: Sequence[Effort]) -> Iterator[str]:
    """Of each scheme, the share of variants it solves within factors of the cheapest."""
    wide = max((len(e.label) for e in every), default=0)
    for target in TARGETS:
        yield f"\nshare of variants solved to {target:g} within a factor of the cheapest"
        yield f"  {'':<{wide}}{''.join(f'{factor:>8g}' for factor in FACTORS)}"
        for name, ratios in effort.profile(every, target).items():
            shares = [
                sum(r <= factor for r in ratios) / len(ratios) for factor in FACTORS if ratios
            ]
            yield f"  {name:<{wide}}{''.join(f'{100 * share:>7.0f}%' for share in shares)}"


def _document(every: Sequence[Effort], fights: Sequence[Duel]) -> dict[str, Any]:
    """All of it as plain data, without infinities."""
    return {
        "targets": list(TARGETS),
        "efforts": [
            {
                **dataclasses.asdict(one),
                "reach": {f"{t:g}": dataclasses.asdict(effort.reach(one, t)) for t in TARGETS},
            }
            for one in every
        ],
        "duels": [dataclasses.asdict(one) for one in fights],
        "profiles": {
            f"{t:g}": {
                name: [r if math.isfinite(r) else None for r in ratios]
                for name, ratios in effort.profile(every, t).items()
            }
            for t in TARGETS
        },
    }
