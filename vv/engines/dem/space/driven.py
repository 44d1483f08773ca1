"""Moves the walls of a scene in step with its spheres, for kernels."""

from __future__ import annotations

from vv.engines.kernels.compiled import called
from vv.engines.kernels.drive import Drive, Starts, one_of, travel
from vv.engines.kernels.triples import NOWHERE, at, plus, put
from vv.scene import Vector

Base = tuple[Drive, Starts]  # how all walls move: see `vv.engines.kernels.drive.drives`


@called
def carry(
    u: Vector, v: Vector, before: Vector, first: int, base: Base, time: float, dt: float
) -> None:
    """Move the walls, from row `first` on, by the step that ends at a time [s].

    u: displacements at the end, v: mean velocities of the step, before: of the one before it, so
    that a contact meets its wall at the same levels of time as its spheres.
    """
    sines, start = base
    for k in range(len(start) - 1):
        row = first + k
        there = travel(one_of(sines, start, k), time)
        put(before, row, at(v, row))
        put(v, row, plus(NOWHERE, 1.0 / dt, plus(there, -1.0, at(u, row))))
        put(u, row, there)
