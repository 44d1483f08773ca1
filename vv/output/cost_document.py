"""What an error costs in each code, as one document for other programs."""

from __future__ import annotations

import math
from collections.abc import Sequence

from vv.insight.accuracy_cost import TARGETS, Duel, profile, reach
from vv.insight.effort import Effort
from vv.records import codec


def document(every: Sequence[Effort], rest: Sequence[Effort], fights: Sequence[Duel]) -> str:
    """Efforts, duels and profiles, without infinities. rest: what was not timed."""
    efforts = [
        {**codec.to_data(one), "reach": {f"{t:g}": reach(one, t) for t in TARGETS}} for one in every
    ]
    return codec.render(
        {
            "targets": TARGETS,
            "efforts": efforts,
            "indicative": rest,
            "duels": fights,
            "profiles": {f"{target:g}": _profile(every, target) for target in TARGETS},
        }
    )


def _profile(every: Sequence[Effort], target: float) -> dict[str, list[float | None]]:
    return {
        name: [ratio if math.isfinite(ratio) else None for ratio in ratios]
        for name, ratios in profile(every, target).items()
    }
