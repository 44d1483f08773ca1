"""The forces of contacts and bonds on spheres at t = 0."""

from __future__ import annotations

import numpy as np

from vv.scene.arrays import Vector
from vv.scene.bonds import Pairs
from vv.scene.neighbours import overlapping
from vv.scene.scene import Scene


def initial_normal_forces(scene: Scene) -> Vector:
    """The (n, 3) normal forces [N] of contacts and bonds on the spheres at t = 0."""
    spheres, force = scene.spheres, _pull(scene) + initial_wall_forces(scene)
    pairs = unbonded(scene, overlapping(spheres))
    pairs = np.concatenate([pairs, pairs[:, ::-1]])
    i, j = pairs[np.argsort(pairs[:, 0], kind="stable")].T  # sums in the order of the spheres
    offset = spheres.position[j] - spheres.position[i]
    distance = np.linalg.norm(offset, axis=1)
    overlap = spheres.radius[j] + spheres.radius[i] - distance
    stiff = _stiffness(scene, overlap, 1.0 / spheres.radius[i] + 1.0 / spheres.radius[j])
    np.add.at(force, j, (stiff * (overlap / distance))[:, None] * offset)
    return force


def initial_wall_forces(scene: Scene) -> Vector:
    """The (n, 3) normal forces [N] of the walls on the spheres at t = 0."""
    spheres, force = scene.spheres, np.zeros((len(scene.spheres), 3))
    for wall in scene.walls:
        gap = (spheres.position - wall.point) @ wall.normal - spheres.radius
        overlap = np.maximum(-gap, 0.0)
        stiff = _stiffness(scene, overlap, 1.0 / spheres.radius)
        force += (stiff * overlap)[:, None] * wall.normal
    return force


def _stiffness(scene: Scene, overlap: Vector, curvature: Vector) -> Vector:
    """The secant stiffness [N/m], force over overlap, of contacts with these overlaps [m] >= 0."""
    law = scene.contact
    if law.hertz is None:
        return np.full(len(overlap), law.kn)
    return law.hertz.normal_factor(curvature) * np.sqrt(overlap)


def unbonded(scene: Scene, pairs: Pairs) -> Pairs:
    """The pairs i < j (k, 2) of spheres that are not bonded."""
    count = len(scene.spheres)
    low, high = np.sort(scene.bonded_pairs, axis=1).T
    return pairs[~np.isin(pairs[:, 0] * count + pairs[:, 1], low * count + high)]


def _pull(scene: Scene) -> Vector:
    """The (n, 3) forces [N] of bonds on the spheres at t = 0."""
    force = np.zeros((len(scene.spheres), 3))
    if scene.bonds is not None:
        i, j = scene.bonded_pairs.T
        offset = scene.spheres.position[j] - scene.spheres.position[i]
        distance = np.linalg.norm(offset, axis=1)
        pull = scene.bonds.kn * (distance - scene.bonds.length) / distance
        np.add.at(force, i, pull[:, None] * offset)
        np.add.at(force, j, -pull[:, None] * offset)
    return force
