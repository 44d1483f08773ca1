"""Walls that move; their work is done by the contacts with them (`wall_contacts.py`)."""

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
    """The motions of walls, if some can be met and one moves."""
    if not placed.walls_move:
        return None
    return MovingWalls(*drives(tuple(wall.motion for wall in placed.scene.walls)))


def forms(term: MovingWalls) -> tuple[Form, ...]:
    """What contacts with them book."""
    return (Form.WALLS,)


def models(term: MovingWalls) -> frozenset[Term]:
    """What it models of a scene."""
    return STANDS_FOR


@inlined
def start(term: MovingWalls, bodies: Bodies, motion: Motion, dt: float) -> None:
    """The mean velocities of the step that ends at t = 0, as if the walls had moved before."""
    move(term, bodies, motion, -dt, dt)
    move(term, bodies, motion, 0.0, dt)


@inlined
def move(term: MovingWalls, bodies: Bodies, motion: Motion, time: float, dt: float) -> None:
    """Move all walls, whose rows follow the ground's, by the step that ends at a time [s]."""
    ground = len(bodies.mass)
    carry(motion.u, motion.v, motion.before, ground + 1, term.drive, term.starts, time, dt)


@called
def carry(
    u: Vector,
    v: Vector,
    before: Vector,
    first: int,
    sines: Drive,
    start: Starts,
    time: float,
    dt: float,
) -> None:
    """Move the walls, from row `first` on.

    u: displacements at the end, v: mean velocities of the step, before: of the one before it, so
    that a contact meets its wall at the same levels of time as its spheres.
    """
    for k in range(len(start) - 1):
        row = first + k
        there = travel(one_of(sines, start, k), time)
        put(before, row, at(v, row))
        put(v, row, add_scaled(NOWHERE, 1.0 / dt, add_scaled(there, -1.0, at(u, row))))
        put(u, row, there)
