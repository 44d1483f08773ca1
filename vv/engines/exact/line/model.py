"""Which systems have closed forms from event to event, and what their kernel is given."""

from __future__ import annotations

import math
from typing import NamedTuple

from vv.engines.exact.system import System

UNDAMPED = 0.999  # of critical damping: closer to it the swing's own rate loses its digits


class Line(NamedTuple):
    """One unknown on one contact, which it either closes and opens or slides on, as `follow_one`.

    slides: whether x [m] is the stretch of a shear spring, and no gap. x, v [m/s]: at t = 0.
    n, k [1/s], a [m/s2]: x'' + 2n x' + k^2 x = a while the contact holds. limit [m].
    """

    slides: bool
    x: float
    v: float
    n: float
    k: float
    a: float
    limit: float


def line_of(system: System) -> Line | None:
    """The line of a system, or None if it needs more than one."""
    contacts, springs = len(system.gap), len(system.springs)
    plain = not system.bond_springs.names and not system.eta_n > 0
    if len(system.mass) != 1 or contacts != 1 or springs > 1 or not plain:
        return None
    gap, normal = float(system.gap[0]), float(system.normal[0, 0])
    if springs and (normal != 0 or not gap < 0):
        return None
    row = float(system.tangent[0, 0]) if springs else normal
    stiffness = system.ks if springs else system.kn
    mass, load = float(system.mass[0]), float(system.weight[0] + system.load[0])
    n, k = system.eta / mass / 2, abs(row) * math.sqrt(stiffness / mass)
    if not n < UNDAMPED * k < math.inf:
        return None
    limit = -system.ratio * gap if springs else float(system.depth[0])
    start = 0.0 if springs else gap
    velocity = row * float(system.velocity[0])
    return Line(springs > 0, start, velocity, n, k, row * load / mass, limit)
