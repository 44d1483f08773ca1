"""The hooks of terms: what a term may do in a step, by a function of that name in its file.

The functions there take `term` in place of `terms`, and otherwise the arguments given here. bodies,
motion: see `bodies.py`; slots: pairs found by the neighbour search (`neighbours.py`), of which the
first many[0] are in use.
"""

from __future__ import annotations

from typing import Any

from vv.engines.dem.rows import Index
from vv.engines.dem.space.bodies import Bodies, Motion
from vv.engines.dem.space.compose import added, call, chain, composed, first, total
from vv.engines.dem.space.neighbours import Slots
from vv.engines.dem.terms.drag import Drag
from vv.engines.kernels.triples import Triple
from vv.scene import Vector

Terms = tuple[Any, ...]


@composed(call)
def begin(terms: Terms, bodies: Bodies, motion: Motion) -> None:
    """Set the numbers that the term stores from step to step to their values at t = 0."""


@composed(call)
def start(terms: Terms, bodies: Bodies, motion: Motion, dt: float) -> None:
    """Set motions to those at t = 0, when all forces then are known except viscous ones."""


@composed(call)
def move(terms: Terms, bodies: Bodies, motion: Motion, time: float, dt: float) -> None:
    """Move what the term prescribes to a time [s]; the spheres are already displaced to it."""


@composed(chain)
def field(terms: Terms, push: Triple, mass: float, i: int) -> Triple:
    """Add the force [N] on sphere i to push."""
    return push


@composed(total(4))
def force(
    terms: Terms, bodies: Bodies, motion: Motion, dt: float, slots: Slots, many: Index
) -> tuple[float, float, float, float]:
    """Add forces to motion.push and torques to motion.turn; return energies [J].

    They are the energies of normal and of tangential springs, the energy that friction dissipated
    in the step, and the work of moving walls.
    """
    return 0.0, 0.0, 0.0, 0.0


@composed(added)
def release(
    terms: Terms,
    held: tuple[float, float],
    bodies: Bodies,
    motion: Motion,
    dt: float,
    slots: Slots,
    many: Index,
) -> tuple[float, float]:
    """Remove what breaks under these forces; add to `held` the spring energies [J] that remain.

    The energies are those of normal and of tangential springs.
    """
    return held


@composed(total(2))
def viscous(
    terms: Terms,
    bodies: Bodies,
    motion: Motion,
    dt: float,
    slots: Slots,
    many: Index,
    drag: Drag | None,
    lag: float,
) -> tuple[float, float]:
    """Add forces that depend on the velocities before and after the kick, once others are known.

    lag: the weight of the velocity before. Returns the powers [W] dissipated before and after.
    """
    return 0.0, 0.0


@composed(call)
def withdraw(terms: Terms, bodies: Bodies, motion: Motion, slots: Slots, many: Index) -> None:
    """Subtract the forces of `viscous` again."""


@composed(call)
def after(terms: Terms, bodies: Bodies, motion: Motion, dt: float) -> None:
    """Use all forces at the end of a step of length dt [s], which is 0 at t = 0."""


@composed(total(1))
def book(terms: Terms, bodies: Bodies, motion: Motion, energy: Vector, row: int) -> tuple[float]:
    """Fill the term's own columns of a row of energy [J]; return its work since t = 0 [J]."""
    return (0.0,)


@composed(first)
def resistance(terms: Terms) -> Drag | None:
    """The term of drag that is linear in the velocity (`terms/drag.py`), or None.

    It holds arrays, so only functions compiled as `lent` may ask for it.
    """
    return None
