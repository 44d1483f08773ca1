"""Compares codes with measurements: bias and scatter of each.

As in fire modelling (McGrattan and Toman 2011, Fire Safety Journal 46, 1-7), computed values are
assumed to be measured ones times a factor whose logarithm is normally distributed, and the scatter
of the measurements themselves is subtracted. Errors against exact answers and other codes do not
enter.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from vv.records.job_record import Record
from vv.records.manifest import Manifest
from vv.records.outcomes import Verdict
from vv.records.reading import by_fineness, ran

FEWEST = 3  # points from which on a scatter is stated


@dataclass(frozen=True)
class Compared:
    """A computed number and the measured one, both in the unit of the quantity.

    band: how far apart they may be, None if they are only shown; within: whether they are within
    it. over, at: the condition that was varied, and its value.
    """

    quantity: str
    unit: str
    computed: float
    measured: float
    uncertainty: float
    band: float | None
    within: bool
    over: str = ""
    at: float | None = None


@dataclass(frozen=True)
class Agreement:
    """A scheme on a variant, at its finest setting, compared with all its measurements.

    held: those with a band. bias: the factor from measured to computed values; scatter: the
    relative standard deviation about it that the uncertainty of the measurements does not explain.
    Both are of `held`, and None if there are too few. sure: the relative uncertainty of these
    measurements.
    """

    case: str
    variant: str
    label: str
    points: tuple[Compared, ...]
    bias: float | None
    scatter: float | None
    sure: float | None

    @property
    def held(self) -> tuple[Compared, ...]:
        """The points with a band."""
        return tuple(point for point in self.points if point.band is not None)


class Factor(NamedTuple):
    """Bias, scatter of the model, relative uncertainty of the measurements; None for too few."""

    bias: float | None
    scatter: float | None
    sure: float | None


@dataclass(frozen=True)
class Overall:
    """A scheme compared with all measurements of all variants; a point counts for each law.

    held: of the points with a band; every: of all points, also those that are only shown, because
    people who knew where a law fails chose where it has a band.
    """

    label: str
    count: int
    within: int
    points: int
    held: Factor
    every: Factor


def overall(found: Sequence[Agreement]) -> list[Overall]:
    """Each scheme once, in the order in which they are found."""
    points: dict[str, list[Compared]] = {}
    for one in found:
        points.setdefault(one.label, []).extend(one.points)
    return [_overall(label, own) for label, own in points.items()]


def _overall(label: str, points: Sequence[Compared]) -> Overall:
    held = [point for point in points if point.band is not None]
    within = sum(point.within for point in held)
    return Overall(label, len(held), within, len(points), factor(held), factor(points))


def agreements(manifest: Manifest) -> list[Agreement]:
    """All schemes on all variants with a measurement, in the order of the cases."""
    finest: dict[tuple[str, str, str], Record] = {}
    for record in sorted(manifest.records, key=by_fineness):
        if ran(record) and any(one.measurement for one in record.quantities):
            finest[record.case, record.variant, record.label] = record
    order = {(c, v): i for i, (c, v) in enumerate(_places(manifest))}
    keys = sorted(finest, key=lambda key: (order.get(key[:2], len(order)), key[2]))
    return [_agreement(finest[key]) for key in keys]


def _places(manifest: Manifest) -> list[tuple[str, str]]:
    return [(case, name) for case, facts in manifest.cases.items() for name in facts.variants]


def _agreement(record: Record) -> Agreement:
    points = tuple(
        Compared(
            one.name, one.unit, one.value, one.measurement.value, one.measurement.uncertainty,
            one.measurement.band, one.verdict is Verdict.PASS, one.measurement.over,
            one.measurement.at,
        )
        for one in record.quantities
        if one.measurement is not None and one.value is not None
    )  # fmt: skip
    held = [point for point in points if point.band is not None]
    return Agreement(record.case, record.variant, record.label, points, *factor(held))


def factor(points: Sequence[Compared]) -> Factor:
    """Bias, scatter of the model, and relative uncertainty of the measurements.

    With r = ln(computed/measured) of n points, s^2 = sum (r - mean)^2/(n - 1) is the sum of the
    squares of model and measurement, and bias = exp(mean + (model^2 - measurement^2)/2). A scatter
    below that of the measurements leaves none for the model.
    """
    used = [one for one in points if one.computed > 0 and one.measured > 0]
    if len(used) < FEWEST:
        return Factor(None, None, None)
    logs = np.log([one.computed / one.measured for one in used])
    sure = math.sqrt(float(np.mean([(one.uncertainty / one.measured) ** 2 for one in used])))
    model = math.sqrt(max(float(logs.var(ddof=1)) - sure**2, 0.0))
    return Factor(math.exp(float(logs.mean()) + 0.5 * (model**2 - sure**2)), model, sure)
