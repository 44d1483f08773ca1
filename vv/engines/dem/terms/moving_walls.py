"""The motion of walls; their work is computed with the contacts (`wall_contacts.py`)."""

from __future__ import annotations

from typing import NamedTuple

from vv.engines.dem.space.bodies import Bodies, Motion
from vv.engines.dem.space.placed import Placed
from vv.engines.kernels.compiled import called, inlined
from vv.engines.kernels.drive import Drive, Starts, drives, one_of, travel
from vv.engines.kernels.triples import NOWHERE, add_scaled, at, put
from vv.scene import Form, Term, Vector

STANDS_FOR = frozenset({Term.BASE_MOTION})


class MovingWalls(NamedTuple):
    """The motions of all walls, and where each begins (`vv.engines.kernels.drive.drives`)."""

    drive: Drive
    starts: Starts


def build(placed: Placed) -> MovingWalls | None:
    """The motions of walls; None if no wall moves or no sphere can touch one."""
    if not placed.walls_move:
        return None
    return MovingWalls(*drives(tuple(wall.motion for wall in placed.scene.walls)))


def forms(term: MovingWalls) -> tuple[Form, ...]:
    """The form of energy that contacts with moving walls report."""
    return (Form.WALLS,)


def models(term: MovingWalls) -> frozenset[Term]:
    """The terms of the scene that this models."""
    return STANDS_FOR


@inlined
def start(term: MovingWalls, bodies: Bodies, motion: Motion, dt: float) -> None:
    """Set the mean velocities of the step that ends at t = 0, as if the walls had moved before."""
    move(term, bodies, motion, -dt, dt)
    move(term, bodies, motion, 0.0, dt)


@inlined
def move(term: MovingWalls, bodies: Bodies, motion: Motion, time: float, dt: float) -> None:
    """Move all walls by the step that ends at a time [s]; their rows follow that of the ground."""
    ground = len(bodies.mass)
    move_walls(motion.u, motion.v, motion.before, ground + 1, term.drive, term.starts, time, dt)


@called
def move_walls(
    u: Vector,
    v: Vector,
    before: Vector,
    first: int,
    sines: Drive,
    start: Starts,
    time: float,
    dt: float,
) -> None:
    """Move the walls, whose rows begin with `first`.

    u: displacements at the end of the step; v: mean velocities of the step; before: those of the
    previous step. A contact thus finds its wall at the same time levels as its spheres.
    """
    for k in range(len(start) - 1):
        row = first + k
        there = travel(one_of(sines, start, k), time)
        put(before, row, at(v, row))
        put(v, row, add_scaled(NOWHERE, 1.0 / dt, add_scaled(there, -1.0, at(u, row))))
        put(u, row, there)
