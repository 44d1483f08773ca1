"""The drives of a scene at a time, for kernels."""

from __future__ import annotations

import math

from vv.compiled import called, inlined
from vv.dem.drive import Drive
from vv.scene import Vector
from vv.triples import NOWHERE, Triple, at, plus, put


@inlined
def value(drive: Drive, time: float) -> Triple:
    """The sum of the sines at a time [s]."""
    total = NOWHERE
    for k in range(len(drive.omega)):
        angle = drive.omega[k] * time + drive.phase[k]
        total = plus(total, math.sin(angle), at(drive.direction, k))
    return total


@inlined
def travel(drive: Drive, time: float) -> Triple:
    """How far the sum of the sines is at a time [s] from where it was at t = 0."""
    total = NOWHERE
    for k in range(len(drive.omega)):
        angle = drive.omega[k] * time + drive.phase[k]
        total = plus(total, math.sin(angle) - drive.start[k], at(drive.direction, k))
    return total


@called
def carry(
    u: Vector, v: Vector, before: Vector, first: int, base: Drive, time: float, dt: float
) -> None:
    """Move the walls, from row `first` on, by the step that ends at a time [s].

    u: displacements at the end, v: mean velocities of the step, before: of the one before it, so
    that a contact meets its wall at the same levels of time as its spheres.
    """
    for k in range(first, len(u)):
        put(before, k, at(v, k))
        put(v, k, plus(NOWHERE, -1.0 / dt, at(u, k)))
        put(u, k, NOWHERE)
    for k in range(len(base.omega)):
        row = first + base.owner[k]
        since = math.sin(base.omega[k] * time + base.phase[k]) - base.start[k]
        put(u, row, plus(at(u, row), since, at(base.direction, k)))
    for k in range(first, len(u)):
        put(v, k, plus(at(v, k), 1.0 / dt, at(u, k)))
