"""The data of the bulk model that its kernels pass on, in two bundles."""

from __future__ import annotations

from typing import NamedTuple

from vv.engines.dem.bulk.batches import Batches
from vv.engines.dem.bulk.grains import Grains
from vv.engines.dem.bulk.near import Near
from vv.engines.dem.contact.law import Law
from vv.engines.dem.terms.drag import Drag
from vv.engines.kernels.bundles import bundle
from vv.engines.kernels.triples import Triple
from vv.scene import Vector


@bundle
class Rules(NamedTuple):
    """The data that are the same in all steps.

    walls (w, 4): outward normals, and their distances from the origin [m]. friction: of the law;
    viscous: eta_n of contacts [N s/m]; spin: at t = 0; each of these is None if the scene lacks it.
    lag: the weight of the velocity before the kick in the drag.
    """

    walls: Vector
    law: Law
    friction: tuple[float, float] | None
    viscous: float | None
    spin: Vector | None
    dt: float
    drag: Drag
    lag: float
    gravity: Triple


@bundle
class Crowd(NamedTuple):
    """The spheres, the pairs and walls near them, and the batches, made anew by every search."""

    grains: Grains
    pairs: Near
    edges: Near
    work: Batches
    rules: Rules
