"""The bound of a frequency that a leapfrog has, at every step at which the leapfrog is stable."""

from __future__ import annotations

import math
from dataclasses import dataclass

from vv.ask import Knobs
from vv.case import Tolerance

MORE = 1.03  # the bound over the error of a leapfrog
STABLE = 2.0  # w dt above which a leapfrog diverges


def hastened(turned: float) -> float:
    """How much faster a leapfrog turns than w, over w, where w dt = turned.

    Its phase in a step is W dt with sin(W dt/2) = w dt/2, from v_(n+1) - 2 v_n + v_(n-1) =
    -(w dt)^2 v_n. Above STABLE it diverges, and the value there is that at STABLE.
    """
    half = min(turned, STABLE) / 2.0
    return math.asin(half) / half - 1.0


@dataclass(frozen=True)
class HastenedTolerance(Tolerance):
    """A tolerance that beyond its own step grows as the error of a leapfrog, and not as dt^2.

    frequency: of the exact motion [1/s]. The series of the phase error is (w dt)^2/24 (1 +
    9 (w dt)^2/80 + ...): its first term is a seventh too small at w dt = 1.
    """

    frequency: float = 0.0

    def uncut(self, knobs: Knobs) -> float:
        """The bound at a setting, which may exceed LARGEST_TOLERANCE."""
        turned = self.frequency * (knobs.dt or 0.0)
        grown = MORE * hastened(turned) if turned else 0.0
        return max(super().uncut(knobs), grown)
