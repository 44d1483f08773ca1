"""Plots the energy of a run over time: a chart for each scheme, a curve for each form."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from reports.drawing.charts import Chart, Curve
from reports.drawing.collect import History
from reports.drawing.curves import draw
from reports.drawing.gallery import Figure
from reports.marks import COLOURS, UNNUMBERED, Mark
from reports.text import sci
from vv.records.case_facts import QuantityFacts

JOULE = "J"
FEWEST = 2  # forms of energy that make a chart


def energy_figures(
    over_time: Mapping[str, Sequence[History]], facts: Sequence[QuantityFacts]
) -> list[Figure]:
    """A chart for each scheme that records some forms of energy; over_time: by quantity."""
    forms = [one for one in facts if one.unit == JOULE]
    found: dict[str, list[tuple[QuantityFacts, History]]] = {}
    for form in forms:
        for history in over_time.get(form.name, ()):
            found.setdefault(history.mark.label, []).append((form, history))
    return [_figure(label, own) for label, own in found.items() if len(own) >= FEWEST]


def _figure(label: str, own: Sequence[tuple[QuantityFacts, History]]) -> Figure:
    curves = tuple(_curve(form, number, history) for number, (form, history) in enumerate(own))
    ends = ", ".join(f"{form.symbol} {sci(float(h.value[-1]))} J" for form, h in own)
    meanings = "; ".join(f"{form.symbol}: {form.meaning}" for form, _ in own)
    chart = Chart("t [s]", "energy [J]", False, False, curves)
    return Figure(
        draw(chart),
        f"Energy over time in {label}",
        f"At its finest setting. {meanings}.",
        f"Energy over time in {label}; at the final time: {ends}",
    )


def _curve(form: QuantityFacts, number: int, history: History) -> Curve:
    """A form of energy, as a line without markers."""
    mark = Mark(form.symbol, number % len(COLOURS), (), "", UNNUMBERED)
    none = np.zeros(len(history.value), bool)
    return Curve(mark, history.t, history.value, none, none, none, ~none)
