"""Turns an ask into what LIGGGHTS can hold: masses, dead loads, groups, a box, flat walls."""

from __future__ import annotations

import functools
from dataclasses import dataclass, replace

import numpy as np

from adapters.liggghts.bonds import overlapped
from adapters.liggghts.clumps import as_atoms
from adapters.liggghts.walls import is_mesh, travel, triangle
from vv.ask import Ask, Displacement, Observable
from vv.scene import (
    Mask,
    Scene,
    Spheres,
    Vector,
    initial_normal_forces,
    spheres_held_by_loads,
    with_loads_for_locks,
)
from vv.standins.clump import clump
from vv.standins.soften import fastest
from vv.standins.stand_in import stood_for

PLAIN, HALF_STEP, CLUMP, OVERLAPPED = "default", "half-step-mass", "clump", "pre-overlapped"


@functools.lru_cache(maxsize=32)  # it is wanted several times for each of a ladder's rungs
def represented(ask: Ask, scheme: str) -> Scene:
    """The scene that LIGGGHTS is given: locks along the frame only, masses of the scheme.

    Raises ValueError for an ask without dt, or one that `released` cannot release.
    """
    scene = with_loads_for_locks(stood_for(ask).scene)
    if scheme == OVERLAPPED:
        return overlapped(scene)
    if scheme == CLUMP:
        return as_atoms(scene, clump(ask))
    return heavier(scene, scene.eta * ask.dt / 2) if scheme == HALF_STEP else scene


def heavier(scene: Scene, extra: float) -> Scene:
    """The scene with `extra` [kg] on every mass, and the weight kept as a dead load.

    With extra = eta dt/2 the drag of LIGGGHTS, M (v+ - v-)/dt = F - eta v-, becomes that of the
    mean velocity, m (v+ - v-)/dt = F - eta (v+ + v-)/2, which is second order.
    """
    if extra == 0.0:
        return scene
    bodies = tuple(
        replace(g, mass=g.mass + extra, load=g.load + g.mass[:, None] * scene.gravity)
        if isinstance(g, Spheres)
        else g
        for g in scene.bodies
    )
    return replace(scene, bodies=bodies, gravity=np.zeros(3))


def spinning(spheres: Spheres) -> Mask:
    """Which spheres are integrated with their rotations, (n,)."""
    return np.asarray(spheres.free_spin.any(axis=1))


def moving(spheres: Spheres) -> Mask:
    """Which spheres are integrated at all, (n,)."""
    return np.asarray(spheres.free.any(axis=1)) | spinning(spheres)


def loads(spheres: Spheres) -> dict[tuple[float, ...], list[int]]:
    """The dead loads [N] on spheres that move, each with the indices that carry it."""
    carried: dict[tuple[float, ...], list[int]] = {}
    for i in np.flatnonzero(moving(spheres) & spheres.load.any(axis=1)):
        carried.setdefault(tuple(spheres.load[i].tolist()), []).append(int(i))
    return carried


def locks(spheres: Spheres) -> dict[tuple[bool, ...], list[int]]:
    """The patterns of locked axes of spheres that move, each with the indices that have it."""
    locked: dict[tuple[bool, ...], list[int]] = {}
    for i in np.flatnonzero(moving(spheres) & ~spheres.free.all(axis=1)):
        locked.setdefault(tuple((~spheres.free[i]).tolist()), []).append(int(i))
    return locked


def shaken(ask: Ask, scheme: str) -> dict[float, list[int]]:
    """The masses [kg] that a body acceleration acts on, each with the spheres that have it.

    They are those of the scene, where a scheme integrates raised ones.
    """
    scene = represented(ask, PLAIN if scheme == HALF_STEP else scheme)
    carried: dict[float, list[int]] = {}
    for i in np.flatnonzero(moving(scene.spheres)) if scene.shaking else ():
        carried.setdefault(float(scene.spheres.mass[i]), []).append(int(i))
    return carried


def charges(ask: Ask, scheme: str) -> dict[int, Vector]:
    """How far (3,) [m] each sphere must slide to charge its shear spring as it starts."""
    stood = stood_for(ask)
    if stood.charged is None or not stood.charged.any():
        return {}
    ks = stood.scene.contact.ks
    if scheme != CLUMP:
        return {i: -row / ks for i, row in enumerate(stood.charged) if row.any()}
    friction = clump(ask).friction
    return {1 + i: -row * len(friction) / ks for i, row in enumerate(friction)}


def watched(ask: Ask) -> list[tuple[Observable, int]]:
    """What is written, with the index of the sphere: first what was asked, then what may drift.

    The displacements of spheres whose oblique locks became dead loads are watched as well.
    """
    scene = stood_for(ask).scene
    more = [d for d in map(Displacement, spheres_held_by_loads(scene)) if d not in ask.observables]
    return [(o, scene.sphere_index(o.body)) for o in (*ask.observables, *more)]


@dataclass(frozen=True, eq=False)
class Space:
    """Where things are: low, high (3,) [m] bound what spheres may reach and walls span.

    triangles: wall number -> (3, 3) corners [m] of the walls that are meshes; outer: low and high
    of the simulation box, which holds the region and all corners, wherever walls move to.
    """

    low: Vector
    high: Vector
    triangles: dict[int, Vector]
    outer: tuple[Vector, Vector]


def space(ask: Ask, scheme: str) -> Space:
    """The space for an ask: ten radii and twice the longest free path on all sides.

    A wall that moves may carry what lies on it for as long at its highest speed. A rigid body
    needs as much as the sphere in its place.
    """
    scene = represented(ask, PLAIN if scheme == CLUMP else scheme)
    spheres, time = scene.spheres, ask.goal.duration
    forces = initial_normal_forces(scene) / spheres.mass[:, None] + scene.gravity
    pulls = np.linalg.norm(forces, axis=1) + np.linalg.norm(spheres.load, axis=1) / spheres.mass
    pulls += np.abs(scene.shaking.amplitude).sum() if scene.shaking else 0.0
    speeds = np.linalg.norm(spheres.velocity, axis=1)
    speeds += sum(fastest(wall.motion) for wall in scene.walls)
    paths = speeds * time + pulls * time**2 / 2
    reach = 10 * spheres.radius.max() + 2 * np.where(moving(spheres), paths, 0.0).max()
    low, high = spheres.position.min(axis=0) - reach, spheres.position.max(axis=0) + reach
    triangles = {n: triangle(w, low, high) for n, w in enumerate(scene.walls) if is_mesh(w)}
    points = np.vstack([low, high, *triangles.values()])
    margin = 0.01 * reach + max((travel(wall) for wall in scene.walls), default=0.0)
    return Space(low, high, triangles, (points.min(axis=0) - margin, points.max(axis=0) + margin))
