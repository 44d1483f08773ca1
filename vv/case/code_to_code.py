"""Answers of other codes as references: what one printed, to which digit, and what judges by it."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Printed:
    """What another code answered, in the unit of its quantity, as it is printed.

    rounding: half of its last digit, or how well it could be read; code: which one, and its case;
    source: where it is printed.
    Raises ValueError for a value or a rounding that is no number, or a code without a name.
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
    """Judge: the value must lie within `band` of another code's; None: it is shown beside it.

    Agreement shows that both do the same, and not that either is right: that is what exact answers
    are for. The band says by how much they may differ, and why: what they do otherwise.
    Raises ValueError for a band below the rounding of what is printed.
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
