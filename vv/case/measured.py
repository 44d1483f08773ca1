"""Measurements as references, with their uncertainties, and the judge that compares with them."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Measurement:
    """A measured value, in the unit of its quantity, with standard uncertainties.

    digitisation: of reading the value from a figure; experiment: of the published value, or its
    scatter. conditions: of the experiment; source: where it is published, and who digitised it.
    over, at: the condition that was varied, with its unit, and its value here; '' and None if none
    was. Raises ValueError unless the uncertainties are finite, not negative and not both zero,
    since every measurement is uncertain.
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
    """Judge: the value must lie within `band` of a measurement; with None it is only shown.

    The band is the deviation that the model may have, with the reason. It is not a tolerance of a
    method: a code that solves the model exactly may lie anywhere in the band, and outside if the
    model does not hold. law: whether the measurement is a measured law that is evaluated at the
    parameters; otherwise it holds for the parameters of the case only, and nothing is compared with
    it at others. Raises ValueError for a band below the uncertainty of the measurement.
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
