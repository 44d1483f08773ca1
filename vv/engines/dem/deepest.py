"""The deepest overlap of many spheres and walls, from where they are."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from vv.scene import Scene, Vector
from vv.scene.neighbours import overlapping


def deepest(scene: Scene, watched: Sequence[int], moved: Vector) -> float | None:
    """How deep [m] the deepest contact is after displacements moved (b, 3) [m] of some spheres.

    None if one that is free is not among these. Two that are held are no contact.
    """
    spheres = scene.spheres
    moving = np.asarray(spheres.free.any(axis=1))
    if not set(np.flatnonzero(moving)) <= set(watched):
        return None
    x = spheres.position.copy()
    x[list(watched)] = spheres.position[list(watched)] + moved
    i, j = overlapping(replace(spheres, position=x)).T
    depths = spheres.radius[i] + spheres.radius[j] - np.linalg.norm(x[i] - x[j], axis=1)
    depths = depths[moving[i] | moving[j]]
    walls = [spheres.radius - (x - wall.point) @ wall.normal for wall in scene.walls]
    deep = [depths, *(wall[moving] for wall in walls)]
    return max(0.0, *(float(one.max(initial=0.0)) for one in deep))
