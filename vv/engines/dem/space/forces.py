"""All forces on the spheres of the general model, inlined into its kernel."""

from __future__ import annotations

from vv.engines.dem.rows import Index
from vv.engines.dem.space.bodies import Bodies, Motion
from vv.engines.dem.space.hooks import Terms, field, force, release, resistance, viscous
from vv.engines.dem.space.neighbours import Slots
from vv.engines.kernels.compiled import inlined
from vv.engines.kernels.triples import NOWHERE, put
from vv.scene import Vector


@inlined
def forces(
    terms: Terms, bodies: Bodies, motion: Motion, dt: float, slots: Slots, many: Index
) -> tuple[float, float, float, float]:
    """Set push and turn to all forces but viscous ones; return energies [J] as `hooks.force`."""
    for i in range(len(bodies.mass)):
        put(motion.push, i, field(terms, NOWHERE, bodies.mass[i], i))
    clear_torques(motion.turn)
    normal, shear, lost, work = force(terms, bodies, motion, dt, slots, many)
    normal, shear = release(terms, (normal, shear), bodies, motion, dt, slots, many)
    return normal, shear, lost, work


@inlined
def add_viscous(
    terms: Terms, bodies: Bodies, motion: Motion, dt: float, slots: Slots, many: Index, lag: float
) -> tuple[float, float]:
    """Add the viscous forces to push; return their powers [W] as `hooks.viscous`."""
    return viscous(terms, bodies, motion, dt, slots, many, resistance(terms), lag)


@inlined
def clear_torques(turn: Vector | None) -> None:
    """Set the torques on spheres to zero, if any rotates; the last row is that of the ground."""
    if turn is not None:
        for i in range(len(turn) - 1):
            put(turn, i, NOWHERE)
