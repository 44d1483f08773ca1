"""The skin: the gap up to which neighbours are listed, chosen so that a step costs least."""

from __future__ import annotations

import math

from vv.engines.dem.bulk.grains import RADIUS, Grains
from vv.engines.kernels.compiled import lent

FIRST, LEAST, MOST = 0.1, 0.02, 0.6  # relative to the smallest radius
SOUGHT = 25.0
"""The cost of a search, relative to that of a step with a skin of one radius.

A skin of s radii that lasts for k steps costs s per step for pairs listed in vain, and SOUGHT/k per
step for the search; k is proportional to s. The sum is smallest where both are equal.
"""
CHANGE = 1.5  # largest factor between one skin and the next


@lent
def widest(grains: Grains) -> float:
    """The largest radius [m]."""
    radius = 0.0
    for i in range(len(grains.mass)):
        radius = max(radius, grains.row[i, RADIUS])
    return radius


@lent
def narrowest(grains: Grains) -> float:
    """The smallest radius [m]."""
    radius = grains.row[0, RADIUS]
    for i in range(len(grains.mass)):
        radius = min(radius, grains.row[i, RADIUS])
    return float(radius)


@lent
def adapted(skin: float, radius: float, lasted: int) -> float:
    """The skin [m] of least cost, after one that lasted `lasted` steps; radius: the smallest."""
    wanted = math.sqrt(SOUGHT * radius / (skin * max(lasted, 1)))
    changed = skin * min(max(wanted, 1.0 / CHANGE), CHANGE)
    return min(max(changed, LEAST * radius), MOST * radius)
