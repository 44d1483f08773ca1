"""The cost of an error in each code as one JSON document."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Sequence

from vv.insight.accuracy_cost import TARGETS, Comparison, cheapest, error_cost, front, profile
from vv.insight.effort import Effort
from vv.records import codec
from vv.records.rungs import Point


def document(
    every: Sequence[Effort], untimed: Sequence[Effort], compared: Sequence[Comparison]
) -> str:
    """Efforts, comparisons and profiles as JSON, without infinities."""
    efforts = [
        {**codec.to_data(one), "reach": {f"{t:g}": error_cost(one, t) for t in TARGETS}}
        for one in every
    ]
    return codec.render(
        {
            "targets": TARGETS,
            "efforts": efforts,
            "indicative": untimed,
            "fronts": _of_variants(every, front),
            "cheapest": {
                f"{target:g}": _of_variants(every, functools.partial(cheapest, target=target))
                for target in TARGETS
            },
            "duels": compared,
            "profiles": {f"{target:g}": _profile(every, target) for target in TARGETS},
        }
    )


def _of_variants(
    every: Sequence[Effort], chosen: Callable[[Sequence[Effort]], list[tuple[str, Point]]]
) -> dict[str, list[dict[str, object]]]:
    """CASE:VARIANT -> a value for each scheme that ran it, with setting and cost."""
    found = {}
    for case, variant in dict.fromkeys((e.case, e.variant) for e in every):
        here = [e for e in every if (e.case, e.variant) == (case, variant)]
        picked = [{"scheme": name, **codec.to_data(point)} for name, point in chosen(here)]
        found[f"{case}:{variant}"] = picked
    return found


def _profile(every: Sequence[Effort], target: float) -> dict[str, list[float | None]]:
    return {
        name: [ratio if math.isfinite(ratio) else None for ratio in ratios]
        for name, ratios in profile(every, target).items()
    }
