"""The rate at which grains leave a silo through a round hole in its floor (Beverloo 1961).

W = C rho sqrt(g) (D - k d)^(5/2): grains fall freely from a dome over the hole, the edge of the
hole keeps their centres at a distance, and the height of the fill does not matter. Lengths are in
diameters d of a grain, times in sqrt(d/g).
"""

from __future__ import annotations

import math

FREE, EDGE = 0.58, 1.4
"""C and k of spheres."""
FREE_SURE, EDGE_SURE = 0.03, 0.1
"""Standard uncertainties: sources state C from 0.55 to 0.65, and k of spheres as 1.5 or 1.4."""


PITCH = 1.02


def edge(clear: float) -> tuple[float, int]:
    """The radius of a ring of grains that nearly touch round a hole, and their number."""
    ring = 0.5 * (clear + 1.0)
    return ring, int(math.pi / math.asin(0.5 * PITCH / ring))


def across(clear: float) -> float:
    """The diameter of a circle with the area of the opening between these grains.

    The area is that of the polygon through their centres less the sector of each inside it.
    """
    ring, many = edge(clear)
    polygon = 0.5 * many * ring**2 * math.sin(2.0 * math.pi / many)
    sectors = many / 8.0 * (math.pi - 2.0 * math.pi / many)
    return 2.0 * math.sqrt((polygon - sectors) / math.pi)


def rate(opening: float, filled: float) -> float:
    """The number of grains per unit of time; filled: solid fraction of the poured grains."""
    return FREE * filled * 6.0 / math.pi * math.pow(opening - EDGE, 2.5)


def uncertainty(opening: float) -> float:
    """The relative uncertainty of the rate due to those of both constants."""
    return math.hypot(FREE_SURE / FREE, 2.5 * EDGE_SURE / (opening - EDGE))
