"""Drag that slows spheres in proportion to their velocity."""

from __future__ import annotations

from typing import NamedTuple

from vv.engines.dem.space.placed import Placed
from vv.engines.kernels.compiled import inlined
from vv.engines.kernels.triples import Triple, add_scaled, at
from vv.scene import Vector


class Drag(NamedTuple):
    """-eta u' [N] with eta [N s/m], on the part of each velocity that is not steady.

    steady: (m, 3), or None or (0, 3) if none is. An eta of 0 is no drag.
    """

    eta: float
    steady: Vector | None


def build(placed: Placed) -> Drag | None:
    """The drag of a scene that has some; where that costs next to nothing, it may be nil."""
    scene, steady = placed.scene, placed.carried
    rubs_locked = placed.law.friction is not None and not scene.spheres.free_spin.any()
    if scene.eta == 0.0 and scene.bonds is None and not placed.asks and not rubs_locked:
        return None
    return Drag(scene.eta, steady if steady.any() else steady[:0])


def resistance(term: Drag) -> Drag:
    """What the leapfrog itself takes into account (`vv.engines.dem.space.advance`)."""
    return term


@inlined
def drawn(a: Triple, scale: float, steady: Vector | None, i: int) -> Triple:
    """a + scale times the steady velocity of body i."""
    if steady is None:
        return a
    if len(steady) == 0:
        return a
    return add_scaled(a, scale, at(steady, i))
