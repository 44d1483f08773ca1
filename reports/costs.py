"""What accuracy costs, as the page shows it: time to reach an error, advice, and profiles."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from reports.charts import shares as shares_chart
from reports.gallery import Draw, Figure
from reports.marks import Mark
from reports.text import brief, sci, short
from vv.insight.accuracy_cost import TARGETS, Reach, cheapest, profile, reach, shares
from vv.insight.effort import Effort, efforts
from vv.records.manifest import Manifest
from vv.records.rungs import Point, describe


@dataclass(frozen=True)
class CostRow:
    """A scheme: what each error costs it, its smallest error, floors and limits in words."""

    mark: Mark
    reached: Sequence[Reach]
    best: float | None
    notes: Sequence[str]


@dataclass(frozen=True)
class Costs:
    """A timed variant. advice: for each error, the setting of each code that gets there."""

    rows: Sequence[CostRow]
    advice: Sequence[tuple[float, str]]


@dataclass(frozen=True)
class Profile:
    """At one error: scheme -> the share of variants it solves within each of FACTORS."""

    target: float
    shares: Sequence[tuple[Mark, Sequence[float]]]
    figures: Sequence[Figure]


def costs(
    manifest: Manifest, marks: Mapping[str, Mark], draw: Draw
) -> tuple[dict[tuple[str, str], Costs], list[Profile]]:
    """(case, variant) -> its costs, and the profiles over all of them."""
    every = efforts(manifest)
    places = dict.fromkeys((e.case, e.variant) for e in every)
    found = {
        place: _costs([e for e in every if (e.case, e.variant) == place], marks) for place in places
    }
    return found, [_profile(every, target, marks, draw) for target in TARGETS if every]


def _costs(here: Sequence[Effort], marks: Mapping[str, Mark]) -> Costs:
    rows = [
        CostRow(marks[e.label], [reach(e, target) for target in TARGETS], e.best, list(_notes(e)))
        for e in here
    ]
    return Costs(rows, [(target, _advice(here, target)) for target in TARGETS])


def _notes(one: Effort) -> Iterator[str]:
    """Its floor, and at each stiffness what of the error is the model's and what the step's."""
    if one.floor:
        yield f"{sci(one.floor.error, 1)}: {one.floor.why}"
    for row in one.rows:
        if row.kn and (text := describe(row)):
            yield f"kn = {brief(row.kn)}: {text}"


def _advice(here: Sequence[Effort], target: float) -> str:
    """The cheapest timed setting of each code that is as accurate, cheapest code first."""
    return "; ".join(_setting(name, point) for name, point in cheapest(here, target)) or "nobody"


def _setting(name: str, point: Point) -> str:
    knobs = [f"{k} = {brief(value)}" for k, value in (("dt", point.dt), ("kn", point.kn)) if value]
    return f"{', '.join([name, *knobs])} ({short(1e3 * (point.cpu or 0.0))} ms)"


def _profile(
    every: Sequence[Effort], target: float, marks: Mapping[str, Mark], draw: Draw
) -> Profile:
    ratios = profile(every, target)
    named = [(marks[name], row) for name, row in ratios.items() if row]
    chart = shares_chart(named, f"share solved to {brief(target)}")
    within = [(mark, shares(row)) for mark, row in named]
    text = ", ".join(f"{mark.label} {100 * row[-1]:.0f} %" for mark, row in within)
    title = f"Profile at an error of {brief(target)}"
    caption = "Share of the timed variants solved within a factor of the cheapest scheme's cost."
    drawn = (
        [Figure(draw(chart), title, caption, f"{title}; solved at all: {text}")] if chart else []
    )
    return Profile(
        target, sorted(within, key=lambda pair: tuple(pair[1][::-1]), reverse=True), drawn
    )
