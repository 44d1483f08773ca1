"""The collapse of a column of grains: its geometry in grains, and the measured laws.

The run-out and the height follow Lube, Huppert, Sparks and Hallworth (2004), as cited by others.
Lengths are in diameters of a grain.
"""

from __future__ import annotations

import math

RISE = math.sqrt(2.0 / 3.0)
"""The height of a layer of spheres that lie in the hollows of the layer below."""
GROUND = RISE - 0.5
"""The lowest point of grains in the hollows of a floor of spheres, above the centres of these."""
TALL = 1.7


def layers(height: float) -> int:
    """The number of layers of spheres whose height is closest to the given one."""
    return round(height / RISE)


def radius(spheres: float) -> float:
    """The radius of the circle with the area of this many spheres of a triangular lattice."""
    return math.sqrt(spheres * math.sqrt(0.75) / math.pi)


def run_out(a: float) -> float:
    """The run-out (r - r0)/r0 of a column whose height is a times its radius."""
    return 1.24 * a if a < TALL else 1.6 * math.sqrt(a)


def height(a: float) -> float:
    """The height h/r0 of the deposit of a tall column whose height is a times its radius."""
    return float(0.88 * a ** (1.0 / 6.0))
