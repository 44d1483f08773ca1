"""Lays out the axes of a chart: limits around the data, few readable ticks."""

from __future__ import annotations

import math
import sys
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from reports.text import brief, power
from vv.base.metrics import Vector

DECADES = 6  # approximate maximum of labels on a logarithmic axis
STEPS = 5  # the same on a linear axis
LEAST, LARGEST = sys.float_info.min_10_exp, sys.float_info.max_10_exp  # of powers of ten


@dataclass(frozen=True)
class Axis:
    """The map from values to positions; limits are powers of ten if log; start, end: positions."""

    low: float
    high: float
    log: bool
    start: float
    end: float
    ticks: tuple[tuple[float, str], ...]

    def at(self, values: Vector | float) -> Vector:
        """The positions of values; nan for values without a logarithm."""
        known = np.asarray(values, float)
        if self.log:
            known = np.log10(np.where(known > 0, known, np.nan))
        return self.start + (known - self.low) / (self.high - self.low) * (self.end - self.start)

    def place(self, value: float) -> float:
        """The position of one value, such as a tick; it must be positive on a logarithmic axis."""
        known = math.log10(value) if self.log else value
        return self.start + (known - self.low) / (self.high - self.low) * (self.end - self.start)

    def limits(self) -> str:
        """The limits, and 1 if they are powers of ten, for the script of the page."""
        return f"{self.low:.6g} {self.high:.6g}{' 1' if self.log else ''}"

    def value(self, part: float) -> float:
        """The value at a fraction of the way from start to end."""
        found = self.low + part * (self.high - self.low)
        return 10.0**found if self.log else found


def log_axis(values: Vector, margin: float, start: float, end: float) -> Axis:
    """A logarithmic axis around positive values, with a label at each decade or every few."""
    low, high = np.log10([values.min(), values.max()]).tolist() if len(values) else (-1.0, 0.0)
    pad = max(0.12, margin * (high - low))
    low, high = max(low - pad, LEAST), min(high + pad, LARGEST)
    return Axis(low, high, True, start, end, tuple(_decades(low, high)))


def _decades(low: float, high: float) -> Iterable[tuple[float, str]]:
    """(tick, label) between two powers of ten; within a decade or so also 2 and 5."""
    decades = range(math.ceil(low), math.floor(high) + 1)
    if len(decades) >= 3:
        stride = math.ceil(len(decades) / DECADES)
        return [(10.0**n, power(n)) for n in decades if n % stride == 0]
    fine = [m * 10.0**n for n in range(math.floor(low), math.ceil(high) + 1) for m in (1, 2, 5)]
    return [(tick, brief(tick)) for tick in fine if low <= math.log10(tick) <= high]


def linear_axis(values: Vector, start: float, end: float, pad: float = 0.04) -> Axis:
    """A linear axis around values, with round numbers on it."""
    low, high = (float(values.min()), float(values.max())) if len(values) else (0.0, 1.0)
    if not high - low > 1e-12 * max(abs(low), abs(high)):  # a constant, up to rounding
        low, high = low - 0.5 * (abs(low) or 1.0), high + 0.5 * (abs(high) or 1.0)
    low, high = low - pad * (high - low), high + pad * (high - low)
    raw = (high - low) / STEPS
    unit = 10.0 ** math.floor(math.log10(raw))
    step = min(unit * m for m in (1, 2, 5, 10) if unit * m >= raw * 0.999)
    ticks = [n * step for n in range(math.ceil(low / step), math.floor(high / step) + 1)]
    return Axis(low, high, False, start, end, tuple((t, brief(float(f"{t:.9g}"))) for t in ticks))
