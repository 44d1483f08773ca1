"""The deepest overlap in a scene of many spheres and walls, computed from their positions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from vv.scene import Scene, Vector
from vv.scene.neighbours import overlapping


def deepest(scene: Scene, watched: Sequence[int], moved: Vector) -> float | None:
    """The deepest overlap [m] when the spheres `watched` are displaced by moved (b, 3) [m].

    None if some free sphere is not among them. Pairs of fixed spheres are not counted.
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
