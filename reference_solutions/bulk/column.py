"""A column of grains that collapses: its geometry in grains, and the laws that were measured.

Run-out and height are those that others cite of Lube, Huppert, Sparks and Hallworth (2004).
Lengths are in diameters of a grain.
"""

from __future__ import annotations

import math

RISE = math.sqrt(2.0 / 3.0)
"""Height of a layer of spheres that lie in the hollows of the one below."""
GROUND = RISE - 0.5
"""Where the lowest of grains in the hollows of a floor begin, above the centres of the floor's."""
TALL = 1.7


def layers(height: float) -> int:
    """The layers of spheres that come closest to a height."""
    return round(height / RISE)


def radius(spheres: float) -> float:
    """The radius of the circle that so many spheres of a triangular lattice have room in."""
    return math.sqrt(spheres * math.sqrt(0.75) / math.pi)


def run_out(a: float) -> float:
    """(r - r0)/r0 of a column a times as high as its radius."""
    return 1.24 * a if a < TALL else 1.6 * math.sqrt(a)


def height(a: float) -> float:
    """h/r0 of what was a tall column."""
    return float(0.88 * a ** (1.0 / 6.0))
