"""The term for constant forces: gravity and dead loads."""

from __future__ import annotations

from typing import NamedTuple

from vv.engines.dem.space.bodies import Bodies, Motion
from vv.engines.dem.space.ledger import column
from vv.engines.dem.space.placed import Placed
from vv.engines.kernels.compiled import inlined
from vv.engines.kernels.triples import Triple, add_scaled, at, dot
from vv.scene import Form, Vector

GRAVITY, LOAD = column(Form.GRAVITY), column(Form.LOAD)


class DeadLoads(NamedTuple):
    """Weights and loads (m, 3) [N] of the moving spheres, and their sum; (0, 3) if all are zero."""

    weight: Vector
    load: Vector
    both: Vector


def build(placed: Placed) -> DeadLoads:
    """The constant forces on moving spheres.

    Every scene has this term, so that fewer kernels are compiled.
    """
    scene, moves = placed.scene, placed.moves
    weight = scene.spheres.mass[moves][:, None] * scene.gravity
    load = scene.spheres.load[moves]
    if not (weight.any() or load.any()):
        weight, load = weight[:0], load[:0]
    return DeadLoads(weight, load, weight + load)


@inlined
def field(term: DeadLoads, push: Triple, mass: float, i: int) -> Triple:
    """Add the weight and the dead load of sphere i to its force [N]."""
    return add_scaled(push, 1.0, at(term.both, i)) if len(term.both) else push


@inlined
def book(term: DeadLoads, bodies: Bodies, motion: Motion, energy: Vector, row: int) -> tuple[float]:
    """Write the work of gravity and of dead loads since t = 0 [J]."""
    fallen, pushed = 0.0, 0.0
    for i in range(len(term.both)):
        moved = at(motion.u, i)
        fallen += dot(at(term.weight, i), moved)
        pushed += dot(at(term.load, i), moved)
    energy[row, GRAVITY], energy[row, LOAD] = fallen, pushed
    return (fallen + pushed,)
