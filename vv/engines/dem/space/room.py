"""Allocates the arrays of the stepping loop, with widths that the compiler knows."""

from __future__ import annotations

from typing import Any

import numpy as np
from numba.core import types
from numba.extending import overload

from vv.engines.dem.space.bodies import Bodies, Motion
from vv.engines.dem.space.compose import OPTIONS
from vv.engines.kernels.compiled import COUNTED, inlined_called
from vv.engines.kernels.triples import NOWHERE, put
from vv.scene import Vector


@inlined_called
def allocate(given: Bodies) -> tuple[Bodies, Motion]:
    """The bodies with copied projectors, and arrays for their motion, all zero."""
    m = len(given.mass)
    hold, hold_spin = copied(given.hold), copied(given.hold_spin)
    bodies = Bodies(
        given.velocity, given.spin, given.mass, given.inertia, hold, hold_spin, given.walls
    )
    rows = m + 1 + given.walls
    w, spun, turn = allocate_spins(given.spin, m + 1)
    return bodies, Motion(
        zero_rows(rows), zero_rows(rows), zero_rows(rows), zero_rows(m + 1), w, spun, turn
    )


@inlined_called
def zero_rows(rows: int) -> Vector:
    """An array of zeros (rows, 3)."""
    made = np.empty((rows, 3))
    for i in range(rows):
        put(made, i, NOWHERE)
    return made


@inlined_called
def copied(hold: Vector) -> Vector:
    """A copy of the projectors (m, 3, 3)."""
    made = np.empty((len(hold), 3, 3))
    for i in range(len(hold)):
        for a in range(3):
            for b in range(3):
                made[i, a, b] = hold[i, a, b]
    return made


def allocate_spins(spin: Any, rows: int) -> Any:
    """Arrays (rows, 3) for spins, the previous spins and torques, as in `Motion`."""


@overload(allocate_spins, jit_options=OPTIONS | COUNTED, strict=False)
def typed_spins(spin: Any, rows: Any) -> Any:
    """The implementation of `allocate_spins` that numba compiles."""
    if isinstance(spin, types.NoneType):
        return lambda spin, rows: (None, None, None)

    def made(spin: Any, rows: Any) -> Any:
        turning = rows if len(spin) else 0
        return zero_rows(turning), zero_rows(turning), zero_rows(turning)

    return made
