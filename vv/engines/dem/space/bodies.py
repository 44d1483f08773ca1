"""The spheres that move in space: what the stepping loop is given of them, and their motion."""

from __future__ import annotations

from typing import NamedTuple

from vv.scene import Vector


class Bodies(NamedTuple):
    """The m spheres that move.

    velocity, spin: (m, 3) at t = 0, spin None if none turns; mass, inertia: (m,); hold, hold_spin:
    (m, 3, 3) projectors on the free directions, None if all are free;
    in a scene with bonds (0, 3, 3), so that it needs no kernel of its own. walls: how many
    have rows of their own, since they move.
    """

    velocity: Vector
    spin: Vector | None
    mass: Vector
    inertia: Vector
    hold: Vector | None
    hold_spin: Vector | None
    walls: int

    @property
    def locked(self) -> bool:
        """Whether any cannot move along some direction."""
        return self.hold is not None and len(self.hold) > 0


class Motion(NamedTuple):
    """Where bodies are and what acts on them, in rows of three.

    The rows are those of the spheres and one for the ground, which does not move; u, v and before
    have another for each moving wall.
    u: displacements [m]; v, w: mean velocities and spins of the step that ended, before, spun: of
    the one before it; push, turn: forces [N] and torques [N m]. w, spun and turn are None if no
    sphere turns.
    """

    u: Vector
    v: Vector
    before: Vector
    push: Vector
    w: Vector | None
    spun: Vector | None
    turn: Vector | None
