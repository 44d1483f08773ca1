"""A collapsing column of grains: its geometry in grains, and the measured laws.

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
    """The number of layers of spheres whose height is closest to a given one."""
    return round(height / RISE)


def radius(spheres: float) -> float:
    """The radius of the circle that holds this many spheres of a triangular lattice."""
    return math.sqrt(spheres * math.sqrt(0.75) / math.pi)


def run_out(a: float) -> float:
    """(r - r0)/r0 of a column whose height is a times its radius."""
    return 1.24 * a if a < TALL else 1.6 * math.sqrt(a)


def height(a: float) -> float:
    """h/r0 of the deposit of a tall column."""
    return float(0.88 * a ** (1.0 / 6.0))
