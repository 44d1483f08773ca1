"""How much faster a leapfrog oscillates than the exact motion, at every stable step."""

from __future__ import annotations

import math

MORE = 1.03  # the bound over the error of a leapfrog
STABLE = 2.0  # w dt above which a leapfrog diverges


def hastened(turned: float) -> float:
    """How much faster a leapfrog turns than w, over w, where w dt = turned.

    Its phase in a step is W dt with sin(W dt/2) = w dt/2, from v_(n+1) - 2 v_n + v_(n-1) =
    -(w dt)^2 v_n, so that the error is (w dt)^2/24 (1 + 9 (w dt)^2/80 + ...): the first term is a
    seventh too small at w dt = 1. Above STABLE it diverges, and the value there is that at STABLE.
    """
    half = min(turned, STABLE) / 2.0
    return math.asin(half) / half - 1.0
