"""The spheres that move in space: what the stepping loop is given of them, and their motion."""

from __future__ import annotations

from typing import NamedTuple

from vv.scene import Vector


class Bodies(NamedTuple):
    """The m spheres that move.

    velocity, spin: (m, 3) at t = 0; mass, inertia: (m,); hold, hold_spin: (m, 3, 3) projectors on
    the free directions, (0, 3, 3) if all are free. If none turns, spin is None, or (0, 3) where
    each step asks (`placed.py`), and inertia (0,). walls: how many have rows of their own, since
    they move.
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
        """Whether any cannot move along some direction."""
        return len(self.hold) > 0

    @property
    def turns(self) -> bool:
        """Whether any turns."""
        return self.spin is not None and len(self.spin) > 0


class Motion(NamedTuple):
    """Where bodies are and what acts on them, in rows of three.

    The rows are those of the spheres and one for the ground, which does not move; u, v and before
    have another for each moving wall.
    u: displacements [m]; v, w: mean velocities and spins of the step that ended, before, spun: of
    the one before it; push, turn: forces [N] and torques [N m]. w, spun and turn are None if no
    sphere turns, or have no rows where each step asks.
    """

    u: Vector
    v: Vector
    before: Vector
    push: Vector
    w: Vector | None
    spun: Vector | None
    turn: Vector | None
