"""Shaking: an acceleration that acts on all spheres."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vv.engines.dem.space.bodies import Bodies, Motion
from vv.engines.dem.space.ledger import column
from vv.engines.dem.space.placed import Placed
from vv.engines.kernels.compiled import inlined
from vv.engines.kernels.drive import NO_MOTION, Drive, drive, value
from vv.engines.kernels.triples import Triple, add_scaled, at, dot, put
from vv.scene import Form, Vector

SHAKING = column(Form.SHAKING)


class Shaking(NamedTuple):
    """drive: acceleration over time; now (1, 3): its value now [m/s2]; work (1,): its work [J]."""

    drive: Drive
    now: Vector
    work: Vector


def build(placed: Placed) -> Shaking | None:
    """The shaking of a scene; None if it has none, except where walls move: then it may be zero."""
    motion = placed.scene.wave
    if motion is None and not placed.walls_move:
        return None
    return Shaking(drive(motion or NO_MOTION), np.zeros((1, 3)), np.zeros(1))


def forms(term: Shaking) -> tuple[Form, ...]:
    """The forms of energy that this term reports."""
    return (Form.SHAKING,) if len(term.drive.omega) else ()


@inlined
def begin(term: Shaking, bodies: Bodies, motion: Motion) -> None:
    """Set the acceleration to its value at t = 0, and the work to zero."""
    put(term.now, 0, value(term.drive, 0.0))
    term.work[0] = 0.0


@inlined
def move(term: Shaking, bodies: Bodies, motion: Motion, time: float, dt: float) -> None:
    """Update the acceleration to a time [s]; add the work of the step, by the trapezoidal rule."""
    there = value(term.drive, time)
    both = add_scaled(at(term.now, 0), 1.0, there)
    work = term.work[0]
    for i in range(len(bodies.mass)):
        work += 0.5 * dt * bodies.mass[i] * dot(both, at(motion.v, i))
    put(term.now, 0, there)
    term.work[0] = work


@inlined
def field(term: Shaking, push: Triple, mass: float, i: int) -> Triple:
    """Add the force of shaking on sphere i [N]."""
    return add_scaled(push, mass, at(term.now, 0))


@inlined
def book(term: Shaking, bodies: Bodies, motion: Motion, energy: Vector, row: int) -> tuple[float]:
    """Write the work of shaking since t = 0 [J]."""
    energy[row, SHAKING] = term.work[0]
    return (term.work[0],)
