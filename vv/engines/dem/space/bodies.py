"""Data of the moving spheres, and the arrays of their motion."""

from __future__ import annotations

from typing import NamedTuple

from vv.scene import Vector


class Bodies(NamedTuple):
    """The m spheres that move.

    velocity, spin: (m, 3) at t = 0; mass, inertia: (m,); hold, hold_spin: (m, 3, 3) projectors on
    the free directions, (0, 3, 3) if all are free; walls: how many walls have rows of their own
    because they move. If no sphere rotates, inertia is (0,), and spin is None, or (0, 3) where this
    is decided at run time (`Placed.decides_at_run_time`).
    """

    velocity: Vector
    spin: Vector | None
    mass: Vector
    inertia: Vector
    hold: Vector
    hold_spin: Vector
    walls: int

    @property
    def locked(self) -> bool:
        """Whether any sphere is locked in some direction."""
        return len(self.hold) > 0

    @property
    def turns(self) -> bool:
        """Whether any sphere rotates."""
        return self.spin is not None and len(self.spin) > 0


class Motion(NamedTuple):
    """Displacements, velocities and forces, one row of three numbers for each body.

    The rows are those of the moving spheres and one for the ground, which is at rest; u, v and
    before have one more for each moving wall.

    u: displacements [m]; v, w: mean velocities [m/s] and spins [1/s] of the last step; before,
    spun: those of the step before it; push, turn: forces [N] and torques [N m]. w, spun and turn
    are None if no sphere rotates, or have no rows where this is decided at run time
    (`Placed.decides_at_run_time`).
    """

    u: Vector
    v: Vector
    before: Vector
    push: Vector
    w: Vector | None
    spun: Vector | None
    turn: Vector | None
