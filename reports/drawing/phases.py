"""Draws phase plots: one quantity over another for each scheme, on the exact curve."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from reports.drawing.charts import Chart, Curve
from reports.drawing.collect import History
from reports.drawing.curves import draw
from reports.drawing.gallery import Figure
from vv.records.case_facts import QuantityFacts


def phase_figures(
    along: Sequence[History], up: Sequence[History], facts: tuple[QuantityFacts, QuantityFacts]
) -> list[Figure]:
    """A picture of all schemes that have both quantities; empty if there are none."""
    others: Mapping[str, History] = {history.mark.label: history for history in up}
    pairs = [(one, others[one.mark.label]) for one in along if one.mark.label in others]
    if not pairs:
        return []
    chart = Chart(
        facts[0].symbol, facts[1].symbol, False, False,
        tuple(_curve(*pair) for pair in pairs), _exact(pairs),
    )  # fmt: skip
    names = f"{facts[1].symbol} over {facts[0].symbol}"
    known = "Grey: the exact one; its corners are outputs beside an impact. " if chart.exact else ""
    caption = f"{known}Each scheme at its finest setting. {facts[0].meaning}; {facts[1].meaning}."
    alt = f"{names} in {', '.join(one.mark.label for one, _ in pairs)}"
    return [Figure(draw(chart), f"Phase picture: {names}", caption, alt)]


def _curve(along: History, up: History) -> Curve:
    none = np.zeros(len(along.value), bool)
    return Curve(along.mark, along.value, up.value, none, none, none, ~none)


def _exact(pairs: Sequence[tuple[History, History]]) -> tuple[np.ndarray, np.ndarray] | None:
    """The exact curve, from the scheme with the most output times."""
    known = [(a.reference, b.reference) for a, b in pairs]
    whole = [(a, b) for a, b in known if a is not None and b is not None]
    return max(whole, key=lambda pair: len(pair[0])) if whole else None
