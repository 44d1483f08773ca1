"""Gravity."""

from __future__ import annotations

from typing import NamedTuple

from vv.engines.dem.rows import triple
from vv.engines.dem.space.bodies import Bodies, Motion
from vv.engines.dem.space.ledger import column
from vv.engines.dem.space.placed import Placed
from vv.engines.kernels.compiled import inlined
from vv.engines.kernels.triples import Triple, add_scaled, at, dot
from vv.scene import Form, Vector

GRAVITY = column(Form.GRAVITY)


class Gravity(NamedTuple):
    """The acceleration of all spheres [m/s2]."""

    acceleration: tuple[float, float, float]


def build(placed: Placed) -> Gravity | None:
    """The gravity of a scene that has some."""
    gravity = placed.scene.gravity
    return Gravity(triple(gravity)) if gravity.any() else None


@inlined
def field(term: Gravity, push: Triple, mass: float, i: int) -> Triple:
    """The weight of sphere i."""
    return add_scaled(push, mass, term.acceleration)


@inlined
def book(term: Gravity, bodies: Bodies, motion: Motion, energy: Vector, row: int) -> tuple[float]:
    """The work of gravity since t = 0."""
    work = 0.0
    for i in range(len(bodies.mass)):
        work += bodies.mass[i] * dot(term.acceleration, at(motion.u, i))
    energy[row, GRAVITY] = work
    return (work,)
