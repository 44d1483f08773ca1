"""All that a step of the bulk model is computed from, as its kernels pass it on."""

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
    """What is the same in all steps.

    walls (w, 4): outward normals and how far they lie along them [m]. friction: that of the law,
    viscous: eta_n of contacts [N s/m], spin: those at t = 0, each None where a scene has none.
    lag: the part of drag that the velocity before a kick makes.
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
    """The spheres, the pairs and walls that may touch, and what is made anew with these lists."""

    grains: Grains
    pairs: Near
    edges: Near
    work: Batches
    rules: Rules
