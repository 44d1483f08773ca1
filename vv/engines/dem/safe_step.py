"""A step that stays stable whatever contacts close: a fraction of the largest stable step."""

from __future__ import annotations

from vv.engines.dem.critical_step import critical_step
from vv.engines.dem.leapfrog import Leapfrog
from vv.scene import Scene

PACKED = 0.35
"""The fraction of the stable step of one contact that is safe: several contacts are stiffer.

Two equal spheres with one contact have m w^2/kn = 2. In a close packing, in which each sphere has
twelve closed contacts, it is 8 without tangential springs, 8.98 at ks/kn = 5/29 and 16 at ks = kn.
The stable step then falls to at least sqrt(2/16) = 0.354 of that of one contact.
"""


def safe_step(scene: Scene, leapfrog: Leapfrog) -> float:
    """A stable step [s] for like spheres, whichever of them touch; inf if nothing can touch.

    If all relevant contacts are closed at t = 0, `critical_step` takes them into account, and any
    step up to it is stable. Spheres of very unequal size may touch more than twelve others, which
    this does not cover.
    """
    return PACKED * critical_step(scene, leapfrog)
