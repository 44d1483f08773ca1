"""Printed answers of other codes as references, and the judge that compares with them."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Printed:
    """The printed answer of another code, in the unit of its quantity.

    rounding: half of its last digit, or the accuracy with which it could be read; code: the code
    and its case; source: where it is printed. Raises ValueError if the value or the rounding is not
    finite, or the code has no name.
    """

    value: float
    rounding: float
    code: str
    source: str

    def __post_init__(self) -> None:
        if not math.isfinite(self.value):
            raise ValueError(f"Printed.value = {self.value!r}; it must be finite")
        if not 0 < self.rounding < math.inf:
            raise ValueError(f"Printed.rounding = {self.rounding!r}; it must be positive")
        if not self.code:
            raise ValueError("Printed.code is empty; an answer must name the code that gave it")


@dataclass(frozen=True)
class CodeToCode:
    """Judge: the value must lie within `band` of another code's; with None it is only shown.

    Agreement shows that both codes do the same, not that either is right, which only an exact
    answer can show. The reason of the band says how the two codes differ. Raises ValueError for a
    band below the rounding of the printed value.
    """

    answer: Printed
    band: float | None
    reason: str

    def __post_init__(self) -> None:
        least = self.answer.rounding
        if self.band is not None and not least <= self.band < math.inf:
            raise ValueError(
                f"CodeToCode.band = {self.band!r}; it must be finite, and not below the rounding "
                f"of what is printed, {least:.3g}"
            )
