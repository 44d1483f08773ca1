"""The simulation space of LIGGGHTS: the reach of spheres, meshes of walls, the box around."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from vv.scene import Scene, Vector, Wall, initial_normal_forces
from vv.standins.penalty_springs import fastest

CROWD = 400  # spheres; from here on the neighbour search in a large box would dominate


@dataclass(frozen=True, eq=False)
class Space:
    """The simulation space: low, high (3,) [m] bound what spheres may reach and walls span.

    triangles: the (3, 3) corners [m] of walls that are meshes, by wall number; outer: low and high
    of the simulation box, which contains the region and all corners, wherever walls move to.
    """

    low: Vector
    high: Vector
    triangles: dict[int, Vector]
    outer: tuple[Vector, Vector]


def space(scene: Scene, time: float) -> Space:
    """The space for a run of `time` [s]: ten radii and twice the longest free path on all sides.

    A moving wall may carry a body for as long, at its highest speed. With many spheres the space
    ends ten radii behind a wall, since the neighbour search would be slow in a box far larger than
    the volume of the spheres.
    """
    spheres = scene.spheres
    forces = initial_normal_forces(scene) / spheres.mass[:, None] + scene.gravity
    pulls = np.linalg.norm(forces, axis=1) + np.linalg.norm(spheres.load, axis=1) / spheres.mass
    pulls += np.abs(scene.wave.amplitude).sum() if scene.wave else 0.0
    speeds = np.linalg.norm(spheres.velocity, axis=1)
    speeds += sum(fastest(wall.motion) for wall in scene.walls)
    paths = speeds * time + pulls * time**2 / 2
    moving = spheres.free.any(axis=1) | spheres.free_spin.any(axis=1)
    about = 10 * spheres.radius.max()
    reach = about + 2 * np.where(moving, paths, 0.0).max()
    low, high = spheres.position.min(axis=0) - reach, spheres.position.max(axis=0) + reach
    if len(spheres) >= CROWD:
        low, high = _between_walls(scene.walls, low, high, about)
    triangles = {n: triangle(w, low, high) for n, w in enumerate(scene.walls) if is_mesh(w)}
    points = np.vstack([low, high, *triangles.values()])
    margin = 0.01 * reach + max((travel(wall) for wall in scene.walls), default=0.0)
    return Space(low, high, triangles, (points.min(axis=0) - margin, points.max(axis=0) + margin))


def _between_walls(
    walls: tuple[Wall, ...], low: Vector, high: Vector, about: float
) -> tuple[Vector, Vector]:
    """low and high, limited to the distance [m] behind walls that are normal to an axis."""
    low, high = low.copy(), high.copy()
    for wall in walls:
        if not is_mesh(wall):
            axis = int(np.abs(wall.normal).argmax())
            if wall.normal[axis] > 0:
                low[axis] = max(low[axis], wall.point[axis] - about)
            else:
                high[axis] = min(high[axis], wall.point[axis] + about)
    return low, high


def oblique(wall: Wall) -> bool:
    """Whether a wall is not normal to an axis of the frame, and needs a mesh."""
    return int((np.abs(wall.normal) > 1e-15).sum()) > 1


def is_mesh(wall: Wall) -> bool:
    """Whether a wall becomes a mesh: LIGGGHTS' planes are normal to axes, and do not move."""
    return oblique(wall) or wall.motion is not None


def travel(wall: Wall) -> float:
    """An upper bound of the distance [m] of a wall from its position at t = 0."""
    return 0.0 if wall.motion is None else 2 * float(np.abs(wall.motion.amplitude).sum())


def triangle(wall: Wall, low: Vector, high: Vector) -> Vector:
    """The (3, 3) corners [m] of a triangle in the wall's plane, larger than its cut with a box.

    One triangle has no inner edges, at which a mesh may hand contacts over. The corners run
    round the outward normal. The inscribed circle reaches beyond the farthest corner of the box.
    """
    centre, half = (low + high) / 2, (high - low) / 2
    foot = centre - ((centre - wall.point) @ wall.normal) * wall.normal
    inscribed = float(np.linalg.norm(half) + np.linalg.norm(foot - centre))
    return np.asarray(foot + 2 * inscribed * wall.facet_corners)
