"""How far beyond contact neighbours are listed: as far as costs least."""

from __future__ import annotations

import math

from vv.engines.dem.bulk.grains import RADIUS, Grains
from vv.engines.kernels.compiled import lent

FIRST, LEAST, MOST = 0.1, 0.02, 0.6  # of the smallest radius
SOUGHT = 25.0
"""What seeking neighbours costs, over what listing all within one more radius costs a step.

A skin s [radii] that lasts k steps costs s a step for what is listed in vain, and SOUGHT/k for
seeking, which is in proportion to 1/s. The sum is least where both are the same.
"""
CHANGE = 1.5  # times, at most


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
    """The skin [m] that costs least, after one that lasted so many steps; radius: the smallest."""
    wanted = math.sqrt(SOUGHT * radius / (skin * max(lasted, 1)))
    changed = skin * min(max(wanted, 1.0 / CHANGE), CHANGE)
    return min(max(changed, LEAST * radius), MOST * radius)
