"""Dead loads."""

from __future__ import annotations

from typing import NamedTuple

from vv.engines.dem.space.bodies import Bodies, Motion
from vv.engines.dem.space.ledger import column
from vv.engines.dem.space.placed import Placed
from vv.engines.kernels.compiled import inlined
from vv.engines.kernels.triples import Triple, add_scaled, at, dot
from vv.scene import Form, Vector

LOAD = column(Form.LOAD)


class Load(NamedTuple):
    """Constant forces (m, 3) [N]."""

    load: Vector


def build(placed: Placed) -> Load | None:
    """The loads on spheres that move, if there are any."""
    load = placed.scene.spheres.load[placed.moves]
    return Load(load) if load.any() else None


@inlined
def field(term: Load, push: Triple, mass: float, i: int) -> Triple:
    """The load on sphere i."""
    return add_scaled(push, 1.0, at(term.load, i))


@inlined
def book(term: Load, bodies: Bodies, motion: Motion, energy: Vector, row: int) -> tuple[float]:
    """The work of the loads since t = 0."""
    work = 0.0
    for i in range(len(bodies.mass)):
        work += dot(at(term.load, i), at(motion.u, i))
    energy[row, LOAD] = work
    return (work,)
