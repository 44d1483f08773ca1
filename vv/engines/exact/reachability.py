"""Finds what can move and touch in a scene, and refuses scenes whose normals turn.

A body can only move in the space spanned by its velocity, the forces on it and the normals (with
friction, the tangents) of the contacts it can make, all projected on its free directions. That
space is usually smaller than the freedoms a scene leaves, and its dimension is what is solved.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from vv.scene import Scene, Spheres, Vector, Wall

EPS = float(np.finfo(float).eps)
BLUR = 64 * EPS  # directions closer than this are the same: rounding of a rotation, with room
LARGEST = 32  # spheres; matrices are dense and every pair is a candidate


class RefusedError(Exception):
    """A scene outside the engine's class; the message is the reason."""


@dataclass(frozen=True, eq=False)
class Touch:
    """A contact that may be made: sphere `second` against sphere `first`, or a wall if None.

    names: their body numbers. normal: (3,) unit, towards `second`. gap: at t = 0 [m], 0 when
    within rounding of it. depth: the overlap at which the centres would meet [m]. blur: how
    uncertain the normal is, from the rounding of the coordinates.
    """

    first: int | None
    second: int
    names: tuple[int, int]
    normal: Vector
    gap: float
    depth: float
    blur: float

    @property
    def spheres(self) -> tuple[int, ...]:
        """The indices of the spheres in it."""
        return (self.second,) if self.first is None else (self.first, self.second)


def touches(scene: Scene) -> Iterator[Touch]:
    """Every pair of bodies; gaps within rounding of zero are zero. Raises RefusedError."""
    spheres = scene.spheres
    sphere_names, wall_names = scene.numbers(Spheres), scene.numbers(Wall)
    for j, (x, radius) in enumerate(zip(spheres.position, spheres.radius, strict=True)):
        for wall, name in zip(scene.walls, wall_names, strict=True):
            normal = wall.normal / math.sqrt(math.fsum(wall.normal**2))
            gap = math.fsum((*(x * normal), *(-wall.point * normal), -radius))
            size = np.abs(x).max() + np.abs(wall.point).max() + radius
            names = (name, sphere_names[j])
            yield Touch(None, j, names, normal, _snapped(gap, size), math.inf, BLUR)
        for i in range(j):
            offset = x - spheres.position[i]
            distance = math.sqrt(math.fsum(offset**2))
            reach = float(radius + spheres.radius[i])
            names = (sphere_names[i], sphere_names[j])
            size = np.abs(x).max() + np.abs(spheres.position[i]).max() + reach
            if distance <= BLUR * size:
                raise RefusedError(f"the centres of bodies {names[0]} and {names[1]} coincide")
            blur = BLUR * (1 + float(size) / distance)
            gap = _snapped(distance - reach, size)
            yield Touch(i, j, names, offset / distance, gap, reach, blur)


def _snapped(gap: float, size: float) -> float:
    """Zero if the gap is within a few roundings of coordinates of this size [m]."""
    return 0.0 if abs(gap) <= 8 * EPS * size else gap


def reachable(scene: Scene, candidates: list[Touch]) -> list[Vector]:
    """The orthonormal directions, (d, 3) for each sphere, in which it can come to move.

    Where some of the scene's axes span them, it is these. Tangents add nothing: the tangential
    part of a free direction is that direction less a part of the normal.
    """
    spheres = scene.spheres
    free = [scene.axes[mask] for mask in spheres.free]
    weight = spheres.mass[:, None] * scene.gravity
    sizes = np.linalg.norm(weight, axis=1) + np.linalg.norm(spheres.load, axis=1)
    causes = [
        [scaled(velocity), scaled(force, size)]
        for velocity, force, size in zip(
            spheres.velocity, weight + spheres.load, sizes, strict=True
        )
    ]
    spaces = [moved(own, some, BLUR) for own, some in zip(free, causes, strict=True)]
    closing: list[Touch] = []
    while new := [t for t in candidates if t not in closing and can_close(t, spaces)]:
        closing += new
        blur = max(touch.blur for touch in closing)
        for touch in new:
            for i in touch.spheres:
                causes[i].append(touch.normal)
        spaces = [moved(own, some, blur) for own, some in zip(free, causes, strict=True)]
    return spaces


def can_close(touch: Touch, spaces: list[Vector]) -> bool:
    """Whether some motion in these spaces leaves, or brings, the bodies in contact."""
    if touch.gap < 0:
        return True
    space = np.concatenate([spaces[i] for i in touch.spheres])
    if touch.first is None:
        return bool((np.abs(space @ touch.normal) > touch.blur).any())
    basis = span(space, touch.blur)
    offset = (touch.depth + touch.gap) * touch.normal
    missed = float(np.linalg.norm(offset - basis.T @ (basis @ offset)))
    return missed < touch.depth * (1 - touch.blur)


def tangents(touch: Touch, spaces: list[Vector]) -> Vector:
    """The orthonormal directions, (d, 3), of the tangential motion in a contact."""
    space = np.concatenate([spaces[i] for i in touch.spheres])
    return span(space - np.outer(space @ touch.normal, touch.normal), touch.blur)


def scaled(vector: Vector, size: float = 0.0) -> Vector:
    """A vector over its length, or over a given size; zero stays zero."""
    size = size or float(np.linalg.norm(vector))
    return vector / size if size > 0 else vector


def moved(free: Vector, causes: list[Vector], blur: float) -> Vector:
    """The directions in which unit causes move a sphere: free axes, if those span them."""
    space = span(np.array(causes) @ free.T @ free, blur)
    inside = np.linalg.norm(free - free @ space.T @ space, axis=1) <= blur
    return free[inside] if inside.sum() == len(space) else space


def span(vectors: Vector, blur: float) -> Vector:
    """An orthonormal basis, (d, 3), of the span of (k, 3) vectors no longer than about 1.

    Singular values within blur of zero are rounding; so even nearly parallel vectors of a plane
    span that plane and no more.
    """
    if not len(vectors):
        return vectors
    _, size, basis = np.linalg.svd(vectors)
    return np.asarray(basis[: int((size > blur).sum())])
