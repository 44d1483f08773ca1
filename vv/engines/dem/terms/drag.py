"""Linear drag: a force on each sphere in proportion to its velocity."""

from __future__ import annotations

from typing import NamedTuple

from vv.engines.dem.space.placed import Placed
from vv.engines.kernels.compiled import inlined
from vv.engines.kernels.triples import Triple, add_scaled, at
from vv.scene import Vector


class Drag(NamedTuple):
    """The drag -eta u' [N], eta in N s/m, on the part of each velocity that is not steady.

    steady: (m, 3) steady velocities [m/s]; None or (0, 3) if there are none. eta may be zero.
    """

    eta: float
    steady: Vector | None


def build(placed: Placed) -> Drag | None:
    """The drag of a scene; None if it has none, except where a drag of zero costs nothing.

    Such scenes then share a compiled kernel with those that have drag.
    """
    scene, steady = placed.scene, placed.carried
    rubs_locked = placed.law.friction is not None and not scene.spheres.free_spin.any()
    if (
        scene.eta == 0.0
        and scene.bonds is None
        and not placed.decides_at_run_time
        and not rubs_locked
    ):
        return None
    return Drag(scene.eta, steady if steady.any() else steady[:0])


def resistance(term: Drag) -> Drag:
    """The drag, which the leapfrog itself includes (`vv.engines.dem.space.advance`)."""
    return term


@inlined
def add_steady(a: Triple, scale: float, steady: Vector | None, i: int) -> Triple:
    """The vector a plus `scale` times the steady velocity of body i."""
    if steady is None:
        return a
    if len(steady) == 0:
        return a
    return add_scaled(a, scale, at(steady, i))
