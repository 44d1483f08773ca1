"""Recommends the cheapest setting of each code that reaches an error."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass

from reports.text import brief, seconds
from vv.insight.effort import Effort
from vv.records.rungs import Point

TARGETS = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6)  # relative errors that users ask for


@dataclass(frozen=True)
class Advice:
    """For one error or several, in words: (scheme, setting, cost in words) of each code that gets
    there, cheapest first."""

    errors: str
    settings: Sequence[tuple[str, str, str]]


def advice(here: Sequence[Effort]) -> list[Advice]:
    """The advice for every error that some scheme reaches, by timed costs if all are timed."""
    timed = any(effort.timed for effort in here)
    settings = [(target, _settings(here, target, timed)) for target in TARGETS]
    found = []
    for own, alike in itertools.groupby(settings, key=lambda pair: pair[1]):
        targets = [brief(target) for target, _ in alike]
        if own:
            found.append(Advice(" to ".join(dict.fromkeys((targets[0], targets[-1]))), own))
    return found


def _settings(here: Sequence[Effort], target: float, timed: bool) -> list[tuple[str, str, str]]:
    able = [
        (cpu, effort.label, point)
        for effort in here
        for point in effort.points
        if point.error is not None
        and point.error <= target
        and (cpu := point.cpu if timed else point.indicative)
    ]
    first: dict[str, tuple[str, str, str]] = {}
    for cpu, label, point in sorted(able, key=lambda row: row[:2]):
        cost = seconds(cpu) + ("" if timed else " (indicative)")
        first.setdefault(label.partition("/")[0], (label, _knobs(point), cost))
    return list(first.values())


def _knobs(point: Point) -> str:
    knobs = (("dt", point.dt, "s"), ("kn", point.kn, "N/m"))
    named = [f"{name} = {brief(value)} {unit}" for name, value, unit in knobs if value]
    return ", ".join(named) or "no knob"
