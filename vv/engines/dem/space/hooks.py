"""What terms may do in a step, each in a function of this name and these arguments in its file.

There, `term` takes the place of `terms`. Bodies and their motion: `vv.engines.dem.space.bodies`;
pairs that are near each other: `slots`, the first many[0] of which are in use (`neighbours.py`).
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
    """Set what the term keeps from step to step to what it is at t = 0."""


@composed(call)
def start(terms: Terms, bodies: Bodies, motion: Motion, dt: float) -> None:
    """Set in motion what is so at t = 0, once the forces there but for viscous ones are known."""


@composed(call)
def move(terms: Terms, bodies: Bodies, motion: Motion, time: float, dt: float) -> None:
    """Go on to a time [s], for which the spheres have been displaced."""


@composed(chain)
def field(terms: Terms, push: Triple, mass: float, i: int) -> Triple:
    """The force [N] on sphere i, added to push."""
    return push


@composed(total(4))
def force(
    terms: Terms, bodies: Bodies, motion: Motion, dt: float, slots: Slots, many: Index
) -> tuple[float, float, float, float]:
    """Add forces to motion.push and torques to motion.turn; return energies [J].

    They are what normal and shear springs hold, what friction took in the step, and the work of
    moving walls.
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
    """Let go what breaks under these forces; add what its springs hold [J], normal and shear."""
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
    """Add forces that depend on the velocities before and after, once all others are known.

    lag: the share of the velocity before. Returns the powers [W] they take before and after now.
    """
    return 0.0, 0.0


@composed(call)
def withdraw(terms: Terms, bodies: Bodies, motion: Motion, slots: Slots, many: Index) -> None:
    """Take the forces of `viscous` away again."""


@composed(call)
def after(terms: Terms, bodies: Bodies, motion: Motion, dt: float) -> None:
    """See all forces that act at the end of a step of length dt [s], which is 0 at t = 0."""


@composed(total(1))
def book(terms: Terms, bodies: Bodies, motion: Motion, energy: Vector, row: int) -> tuple[float]:
    """Fill the term's own columns of a row of energy [J]; return the work that it has done."""
    return (0.0,)


@composed(first)
def resistance(terms: Terms) -> Drag | None:
    """The term that slows spheres in proportion to their velocity (`terms/drag.py`), or None.

    It holds arrays, and so can only be asked for by what is `lent` them.
    """
    return None
