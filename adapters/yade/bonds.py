"""Puts bonds to YADE, each as a contact that holds, and says what bonds it cannot be given."""

from __future__ import annotations

from typing import Any

import numpy as np

from vv.scene import Mask, Scene


def bonds(scene: Scene) -> list[dict[str, Any]]:
    """The bonds of a scene as the program in YADE takes them: see its `driver`.

    A bond of another length than the sum of the radii pulls from another overlap than none.
    """
    if scene.bonds is None:
        return []
    reach = scene.spheres.radius[scene.bonded].sum(axis=1)
    columns = (scene.bonds.pairs, scene.bonds.kn, scene.bonds.ks, reach - scene.bonds.length)
    rows = zip(*(column.tolist() for column in columns), strict=True)
    return [dict(zip(("pair", "kn", "ks", "overlap"), row, strict=True)) for row in rows]


def sheared(scene: Scene) -> Mask:
    """Which spheres, (n,), are on a bond that resists shear."""
    on = np.zeros(len(scene.spheres), bool)
    if scene.bonds is not None:
        on[scene.bonded[scene.bonds.ks > 0]] = True
    return on


def why_no_bonds(scene: Scene) -> str | None:
    """Why YADE cannot be given the bonds of a scene; None if it can, or there are none."""
    if scene.bonds is not None and scene.walls:
        return "walls beside bonds; YADE's law of bonds acts between spheres only"
    return None
