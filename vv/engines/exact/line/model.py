"""Recognises systems with closed forms between events, and makes the arguments of their kernel."""

from __future__ import annotations

import math
from typing import NamedTuple

from vv.engines.exact.system import System

UNDAMPED = 0.999  # of critical damping: closer to it, sqrt(k^2 - n^2) loses its digits


class Line(NamedTuple):
    """One unknown on one contact, which either opens and closes or is closed and may slip.

    slides: whether x [m] is the stretch of a shear spring and not a gap. x [m], v [m/s]: at t = 0.
    n, k [1/s], a [m/s2]: coefficients of x'' + 2n x' + k^2 x = a, which holds while the contact is
    closed and sticks. limit [m]: see `follow_one`.
    """

    slides: bool
    x: float
    v: float
    n: float
    k: float
    a: float
    limit: float


def line_of(system: System) -> Line | None:
    """The line of a system, or None if it is no single unknown on one contact."""
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
