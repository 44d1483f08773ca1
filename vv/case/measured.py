"""Measurements as references: a value, how uncertain it is and why, and what judges by it."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Measurement:
    """A measured value, in the unit of its quantity, with standard uncertainties.

    digitisation: of reading it off a print; experiment: of the value printed, or of its scatter.
    conditions: of the experiment; source: where it is published, and who read it off. over, at:
    the condition that was varied, with its unit, and its value here; '' and None if none was.
    Raises ValueError unless the uncertainties are finite, not negative and not both zero: a number
    without any is no measurement.
    """

    value: float
    digitisation: float
    experiment: float
    conditions: str
    source: str
    over: str = ""
    at: float | None = None

    def __post_init__(self) -> None:
        if not math.isfinite(self.value):
            raise ValueError(f"Measurement.value = {self.value!r}; it must be finite")
        for name in ("digitisation", "experiment"):
            size = getattr(self, name)
            if not 0 <= size < math.inf:
                raise ValueError(f"Measurement.{name} = {size!r}; it must be zero or more")
        if self.uncertainty == 0:
            raise ValueError("Measurement has no uncertainty; every measurement has one")

    @property
    def uncertainty(self) -> float:
        """Standard uncertainty of both sources together."""
        return math.hypot(self.digitisation, self.experiment)


@dataclass(frozen=True)
class Measured:
    """Judge: the value must lie within `band` of a measurement; None: it is shown beside it.

    The band says what the model may miss, with the reason; it is no tolerance of a method: a code
    that solves the model exactly may lie anywhere in it, and outside if the model does not hold.
    law: whether the measurement is worked out from the parameters, by a law that was measured;
    else it holds for the case's own alone, and at others nothing is compared with it.
    Raises ValueError for a band below the uncertainty of the measurement.
    """

    measurement: Measurement
    band: float | None
    reason: str
    law: bool = False

    def __post_init__(self) -> None:
        least = self.measurement.uncertainty
        if self.band is not None and not least <= self.band < math.inf:
            raise ValueError(
                f"Measured.band = {self.band!r}; it must be finite, and not below the uncertainty "
                f"of the measurement, {least:.3g}"
            )
