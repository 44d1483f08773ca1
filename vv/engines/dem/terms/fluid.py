"""Drag of a fluid at rest, nonlinear in the velocity (Schiller and Naumann 1933)."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from vv.engines.dem.rows import Index
from vv.engines.dem.space.advance import free_part
from vv.engines.dem.space.bodies import Bodies, Motion
from vv.engines.dem.space.neighbours import Slots
from vv.engines.dem.space.placed import Placed
from vv.engines.dem.terms.drag import Drag
from vv.engines.kernels.compiled import inlined
from vv.engines.kernels.triples import NOWHERE, Triple, add_scaled, at, dot, put
from vv.scene import Term, Vector

STANDS_FOR = frozenset({Term.FLUID})
ROUNDS, DONE = 40, 1e-15  # iterations for the velocity at most; their tolerance


class FluidDrag(NamedTuple):
    """The drag -eta (1 + 0.15 Re^0.687) u' [N] on the m moving spheres.

    eta: (m,) 3 pi viscosity d [N s/m]; reynolds: (m,) Re divided by the speed [s/m]; force: (m, 3)
    the present drag [N].
    """

    eta: Vector
    reynolds: Vector
    force: Vector


def build(placed: Placed) -> FluidDrag | None:
    """The drag of a scene in a fluid; None if there is none, or if other forces are viscous.

    The new velocity then depends on all of these forces together.
    """
    scene = placed.scene
    if scene.fluid is None or scene.eta > 0.0 or scene.contact.viscous:
        return None
    across = 2.0 * scene.spheres.radius[placed.moves]
    fluid = scene.fluid
    reynolds = fluid.density * across / fluid.viscosity
    return FluidDrag(3.0 * math.pi * fluid.viscosity * across, reynolds, np.zeros((len(across), 3)))


def models(term: FluidDrag) -> frozenset[Term]:
    """The terms of the scene that this models."""
    return STANDS_FOR


@inlined
def start(term: FluidDrag, bodies: Bodies, motion: Motion, dt: float) -> None:
    """Set the velocities to those at t = 0."""
    for i in range(len(bodies.mass)):
        put(motion.v, i, at(bodies.velocity, i))


@inlined
def viscous(
    term: FluidDrag,
    bodies: Bodies,
    motion: Motion,
    dt: float,
    slots: Slots,
    many: Index,
    drag: Drag | None,
    lag: float,
) -> tuple[float, float]:
    """Add the drag at the mean of the velocities before and after; return its powers [W] there."""
    behind = ahead = 0.0
    for i in range(len(bodies.mass)):
        old = at(motion.v, i)
        kick = add_scaled(
            NOWHERE, dt / bodies.mass[i], free_part(at(motion.push, i), bodies.hold, i)
        )
        new, force = old, NOWHERE
        for _ in range(ROUNDS):
            mean = add_scaled(add_scaled(NOWHERE, lag, old), 1.0 - lag, new)
            eta = resistance_at(term, mean, i)
            rate = dt / bodies.mass[i] * eta
            last, kept = new, add_scaled(kick, 1.0 - lag * rate, old)
            new = add_scaled(NOWHERE, 1.0 / (1.0 + (1.0 - lag) * rate), kept)
            mean = add_scaled(add_scaled(NOWHERE, lag, old), 1.0 - lag, new)
            force = add_scaled(NOWHERE, -eta, mean)
            change = add_scaled(new, -1.0, last)
            if dot(change, change) <= DONE * DONE * dot(new, new):
                break
        put(term.force, i, force)
        put(motion.push, i, add_scaled(at(motion.push, i), 1.0, force))
        behind -= dot(force, old)
        ahead -= dot(force, new)
    return behind, ahead


@inlined
def resistance_at(term: FluidDrag, velocity: Triple, i: int) -> float:
    """Drag divided by speed [N s/m] of sphere i at a velocity [m/s]."""
    reynolds = term.reynolds[i] * math.sqrt(dot(velocity, velocity))
    return float(term.eta[i] * (1.0 + 0.15 * reynolds**0.687))


@inlined
def withdraw(term: FluidDrag, bodies: Bodies, motion: Motion, slots: Slots, many: Index) -> None:
    """Subtract the drag again."""
    for i in range(len(bodies.mass)):
        put(motion.push, i, add_scaled(at(motion.push, i), -1.0, at(term.force, i)))
