"""A step that stays stable when contacts close that were open: a part of the largest stable one."""

from __future__ import annotations

from vv.engines.dem.critical_step import critical_step
from vv.engines.dem.leapfrog import Leapfrog
from vv.scene import Scene

PACKED = 0.35
"""Of the limit of the fastest contact alone: contacts that close together are faster.

Two equal spheres on one contact have m w^2/kn = 2. In a close packing of such spheres, where all
twelve contacts of each are closed, it is 8 without shear springs, 8.98 at ks/kn = 5/29 and 16 at
ks = kn, so that the limit falls to sqrt(2/16) = 0.354 of that of one contact at most.
"""


def safe_step(scene: Scene, leapfrog: Leapfrog) -> float:
    """A step [s] for a scene of like spheres however they come to touch; inf if nothing can.

    Where the contacts that matter are closed from the start, `critical_step` knows them all, and
    steps up to it are stable. Spheres of very unequal size may touch more than twelve others.
    """
    return PACKED * critical_step(scene, leapfrog)
