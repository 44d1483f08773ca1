"""Finds the directions in which spheres can move, and the contacts that they can make.

A sphere moves only in the space spanned by its velocity, the forces on it, and the normals (with
friction, also the tangents) of the contacts it can make, projected on its free directions. That
space usually has fewer dimensions than the scene has degrees of freedom.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from vv.scene import Scene, Spheres, Vector, Wall

EPS = float(np.finfo(float).eps)
DIRECTION_ROUNDING = 64 * EPS  # the sine of an angle below this is rounding of a rotation
MOST_SPHERES = 32  # matrices are dense, and every pair is a possible contact


class RefusedError(Exception):
    """The engine cannot solve a scene exactly; the message is the reason."""


@dataclass(frozen=True, eq=False)
class PossibleContact:
    """A contact that two bodies may make: sphere `second` with sphere `first`, or a wall if None.

    names: the two body numbers. normal: (3,) unit vector towards `second`. gap: at t = 0 [m], 0 if
    it is only rounding. depth: the overlap at which the centres would coincide [m]. rounding: the
    uncertainty of the normal that comes from rounded coordinates.
    """

    first: int | None
    second: int
    names: tuple[int, int]
    normal: Vector
    gap: float
    depth: float
    rounding: float

    @property
    def spheres(self) -> tuple[int, ...]:
        """The indices of its one or two spheres."""
        return (self.second,) if self.first is None else (self.first, self.second)


def possible_contacts(scene: Scene) -> Iterator[PossibleContact]:
    """All pairs of bodies as possible contacts; raises RefusedError if two centres coincide."""
    spheres = scene.spheres
    sphere_names, wall_names = scene.body_numbers(Spheres), scene.body_numbers(Wall)
    for j, (x, radius) in enumerate(zip(spheres.position, spheres.radius, strict=True)):
        for wall, name in zip(scene.walls, wall_names, strict=True):
            normal = wall.normal / math.sqrt(math.fsum(wall.normal**2))
            gap = math.fsum((*(x * normal), *(-wall.point * normal), -radius))
            size = np.abs(x).max() + np.abs(wall.point).max() + radius
            names = (name, sphere_names[j])
            yield PossibleContact(
                None,
                j,
                names,
                normal,
                _gap_without_rounding(gap, size),
                math.inf,
                DIRECTION_ROUNDING,
            )
        for i in range(j):
            offset = x - spheres.position[i]
            distance = math.sqrt(math.fsum(offset**2))
            reach = float(radius + spheres.radius[i])
            names = (sphere_names[i], sphere_names[j])
            size = np.abs(x).max() + np.abs(spheres.position[i]).max() + reach
            if distance <= DIRECTION_ROUNDING * size:
                raise RefusedError(f"the centres of bodies {names[0]} and {names[1]} coincide")
            rounding = DIRECTION_ROUNDING * (1 + float(size) / distance)
            gap = _gap_without_rounding(distance - reach, size)
            yield PossibleContact(i, j, names, offset / distance, gap, reach, rounding)


def _gap_without_rounding(gap: float, size: float) -> float:
    """The gap, or zero if it is no more than rounding of coordinates of this size [m]."""
    return 0.0 if abs(gap) <= 8 * EPS * size else gap


def reachable_directions(scene: Scene, candidates: list[PossibleContact]) -> list[Vector]:
    """Orthonormal directions (d, 3) in which each sphere can move.

    They are axes of the scene, where some of these span the same space. Tangents need not be
    added: the tangential part of a free direction is that direction less a part of the normal.
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
    spaces = [
        directions_of_motion(own, some, DIRECTION_ROUNDING)
        for own, some in zip(free, causes, strict=True)
    ]
    closing: list[PossibleContact] = []
    while new := [t for t in candidates if t not in closing and can_close(t, spaces)]:
        closing += new
        rounding = max(contact.rounding for contact in closing)
        for contact in new:
            for i in contact.spheres:
                causes[i].append(contact.normal)
        spaces = [
            directions_of_motion(own, some, rounding)
            for own, some in zip(free, causes, strict=True)
        ]
    return spaces


def can_close(contact: PossibleContact, spaces: list[Vector]) -> bool:
    """Whether the bodies overlap, or a motion in these spaces can bring them into contact."""
    if contact.gap < 0:
        return True
    space = np.concatenate([spaces[i] for i in contact.spheres])
    if contact.first is None:
        return bool((np.abs(space @ contact.normal) > contact.rounding).any())
    basis = span(space, contact.rounding)
    offset = (contact.depth + contact.gap) * contact.normal
    missed = float(np.linalg.norm(offset - basis.T @ (basis @ offset)))
    return missed < contact.depth * (1 - contact.rounding)


def tangents(contact: PossibleContact, spaces: list[Vector]) -> Vector:
    """The orthonormal directions, (d, 3), of the tangential motion in a contact."""
    space = np.concatenate([spaces[i] for i in contact.spheres])
    return span(space - np.outer(space @ contact.normal, contact.normal), contact.rounding)


def scaled(vector: Vector, size: float = 0.0) -> Vector:
    """A vector divided by its length, or by a given size; zero stays zero."""
    size = size or float(np.linalg.norm(vector))
    return vector / size if size > 0 else vector


def directions_of_motion(free: Vector, causes: list[Vector], rounding: float) -> Vector:
    """Directions (d, 3) in which unit vectors of causes move a sphere; free axes if possible."""
    space = span(np.reshape(causes, (-1, 3)) @ free.T @ free, rounding)
    inside = np.linalg.norm(free - free @ space.T @ space, axis=1) <= rounding
    return free[inside] if inside.sum() == len(space) else space


def span(vectors: Vector, rounding: float) -> Vector:
    """An orthonormal basis, (d, 3), of the span of (k, 3) vectors no longer than about 1.

    Singular values up to `rounding` count as zero, so that nearly parallel vectors of a plane span
    that plane and no more.
    """
    if not len(vectors):
        return vectors
    _, size, basis = np.linalg.svd(vectors)
    return np.asarray(basis[: int((size > rounding).sum())])
