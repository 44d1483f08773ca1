"""Turns an ask into what the driver inside YADE reads: plain data in YADE's own terms."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from adapters.yade.bonds import bonds, sheared
from adapters.yade.clumps import clumped
from adapters.yade.drives import driven, sines
from adapters.yade.polyhedra import laid, polyhedral, turn_of
from vv.ask import Ask, Displacement, Observable
from vv.scene import (
    Mask,
    Scene,
    Spheres,
    Vector,
    Wall,
    initial_normal_forces,
    spheres_held_by_loads,
    with_loads_for_locks,
)
from vv.standins.clump import clump
from vv.standins.soften import acceleration_of, fastest
from vv.standins.stand_in import Stood, stood_for

PLAIN, HALF_STEP, CLUMP, POLYHEDRA = "default", "half-step-mass", "clump", "polyhedra"
LEAST_GAP = 1e-12  # of a radius: less than that overlaps by rounding only
FACET = 1e3  # a wall's triangle over the scene's size and paths; its size costs no accuracy

Plan = dict[str, Any]


def plan(ask: Ask, scheme: str) -> Plan:
    """The driver's ask: numbers, lists and strings only, in SI units; `ask` in its frame, by `put`.

    The scheme half-step-mass gives YADE the mass m + eta dt/2, with which drag taken from the
    last half step, m (v+ - v-)/dt = F - eta v-, becomes drag of the mean velocity; the weight
    stays m g. Raises ValueError for an ask without dt, or one that `released` cannot release.
    """
    stood, goal, dt = stood_for(ask), ask.goal, ask.dt
    scene = with_loads_for_locks(stood.scene)
    extra = scene.eta * dt / 2 if scheme == HALF_STEP else 0.0
    touching, contacts = initial_contacts(scene)
    columns = _columns(scene, dt, extra, touching, stood.charged)
    plan = {
        "dt": dt,
        "steps": goal.steps(dt),
        "stride": goal.stride(dt),
        "kn": float(scene.contact.kn),
        "ks": float(scene.contact.ks) if scene.contact.carries_shear else 0.0,
        "mu": float(scene.contact.mu),
        "eta_n": float(scene.contact.eta_n),
        "gravity": [0.0, 0.0, 0.0] if extra else scene.gravity.tolist(),
        "drag": float(scene.eta),
        "shaking": sines(scene.shaking),
        "charged": _charges(stood),
        "bonds": bonds(scene),
        "observe": [[_quantity(seen), seen.body] for seen in watched(ask)],
        "contacts": contacts + len(scene.bonded_pairs),
        "moves": bool(scene.spheres.velocity.any()),
        "volumes": False,
        "bodies": _bodies(scene, columns, FACET * _reach(ask), dt),
    }
    if scheme == CLUMP:
        return clumped(plan, clump(ask))
    return polyhedral(plan, ask) if scheme == POLYHEDRA else plan


def put(ask: Ask, scheme: str) -> tuple[Ask, Vector]:
    """The ask in the frame in which YADE is given it, and the rows of that frame (3, 3)."""
    if scheme == POLYHEDRA:
        return laid(ask), turn_of(ask.scene)
    return ask, np.eye(3)


def _columns(
    scene: Scene, dt: float, extra: float, touching: Mask, charged: Vector | None
) -> dict[str, Vector]:
    """What each sphere gets, one row a sphere; `extra` is added to its mass [kg].

    Leapfrog velocities belong to -dt/2: v = v0 - a0 dt/2. Where a contact meets a velocity in
    YADE's first step, shear would run one step ahead: a touching sphere therefore starts at
    rest, and a push gives it in that step the momentum, and the drag, that it would have had.
    """
    spheres, eta = scene.spheres, scene.eta
    weight = spheres.mass[:, None] * scene.gravity
    force = initial_normal_forces(scene) + weight + spheres.load - eta * spheres.velocity
    force = force + spheres.mass[:, None] * acceleration_of(scene.shaking)
    force = force if charged is None else force + charged
    early = spheres.velocity - force / spheres.mass[:, None] * (dt / 2)
    early = np.where(spheres.free, early, 0.0)
    carried = scene.locked_velocity
    mass = spheres.mass + extra
    pushed = np.reshape((touching & scene.contact.carries_shear) | sheared(scene), (-1, 1))
    return {
        "position": spheres.position,
        "initial": spheres.velocity,
        "velocity": np.where(pushed, 0.0, early + carried),
        "spin": np.where(pushed, 0.0, spheres.spin),
        "radius": spheres.radius,
        "mass": mass,
        "inertia": spheres.inertia,
        "shaken": spheres.mass,
        "force": spheres.load + (weight if extra else 0.0),
        "push": np.where(pushed, (mass[:, None] / dt - eta) * early, 0.0),
        "carried": carried,
        "held": np.where(pushed, 0.0, carried),
        "twist": np.where(pushed, spheres.inertia[:, None] * spheres.spin / dt, 0.0),
    }


def _charges(stood: Stood) -> list[Plan]:
    """The friction [N] of each wall on a sphere that its shear spring holds at the start."""
    if stood.charged is None:
        return []
    wall, spheres = stood.scene.body_numbers(Wall)[0], stood.scene.body_numbers(Spheres)
    return [
        {"wall": wall, "body": sphere, "forces": [force.tolist()]}
        for sphere, force in zip(spheres, stood.charged, strict=True)
        if force.any()
    ]


def watched(ask: Ask) -> tuple[Observable, ...]:
    """The observables asked for; then displacements of spheres under a dead load for a lock."""
    more = map(Displacement, spheres_held_by_loads(stood_for(ask).scene))
    return ask.observables + tuple(d for d in more if d not in ask.observables)


def _quantity(observable: object) -> str:
    return type(observable).__name__.lower()


def initial_contacts(scene: Scene) -> tuple[Mask, int]:
    """Which spheres overlap something at the start, (n,), and how many contacts that makes.

    Contacts between bodies without any freedom do not count; bonds are none.
    """
    spheres = scene.spheres
    free: Mask = np.hstack([spheres.free, spheres.free_spin])
    moving = [bool(row.any()) for row in free]
    bonded = {(min(pair), max(pair)) for pair in scene.bonded_pairs.tolist()}
    pairs = [(i, j) for i, j in _overlapping(scene) if moving[i] or moving[j]]
    pairs = [pair for pair in pairs if pair not in bonded]
    touching = np.zeros(len(spheres), bool)
    touching[[i for pair in pairs for i in pair]] = True
    return touching, len(pairs)


def _overlapping(scene: Scene) -> Iterator[tuple[int, int]]:
    """Index pairs of overlapping spheres; a sphere in a wall is paired with itself."""
    place, radius = scene.spheres.position, scene.spheres.radius
    for wall in scene.walls:
        gap = (place - wall.point) @ wall.normal - radius
        yield from ((int(i), int(i)) for i in np.flatnonzero(gap < -LEAST_GAP * radius))
    for i in range(len(radius) - 1):
        distance = np.linalg.norm(place[i + 1 :] - place[i], axis=1)
        near = distance < (1 - LEAST_GAP) * (radius[i + 1 :] + radius[i])
        yield from ((i, int(j) + i + 1) for j in np.flatnonzero(near))


def _reach(ask: Ask) -> float:
    """A length [m] which the scene, and any path in it without collisions, does not exceed."""
    scene, time = stood_for(ask).scene, ask.goal.duration
    spheres = scene.spheres
    places = np.vstack([spheres.position, *(wall.point for wall in scene.walls)])
    speed = float(np.linalg.norm(spheres.velocity, axis=1).max())
    speed += sum(fastest(wall.motion) for wall in scene.walls)
    shaken = np.abs(scene.shaking.amplitude).sum() if scene.shaking else 0.0
    fall = float(np.linalg.norm(scene.gravity) + shaken) * time
    return float(np.ptp(places, axis=0).max() + spheres.radius.max() + (speed + fall) * time)


def _bodies(scene: Scene, columns: dict[str, Vector], size: float, dt: float) -> list[Plan]:
    """All bodies in the scene's order, which becomes the order of YADE's ids."""
    bodies: list[Plan] = []
    first = 0
    for group in scene.bodies:
        if isinstance(group, Wall):
            bodies.append(wall_body(group, size) | {"motion": driven(group.motion, dt)})
        elif isinstance(group, Spheres):
            bodies += [_sphere(group, i, first + i, columns) for i in range(len(group))]
            first += len(group)
    return bodies


def _sphere(group: Spheres, i: int, row: int, columns: dict[str, Vector]) -> Plan:
    free = [*group.free[i], *group.free_spin[i]]
    blocked = "".join(name for name, loose in zip("xyzXYZ", free, strict=True) if not loose)
    numbers = {name: column[row].tolist() for name, column in columns.items()}
    return {"kind": "sphere", **numbers, "blocked": blocked}


def wall_body(wall: Wall, size: float) -> Plan:
    """YADE's infinite wall across an axis of the frame, or a triangle of that size [m]."""
    common = {"point": wall.point.tolist(), "normal": wall.normal.tolist()}
    if np.abs(wall.normal).max() == 1.0:
        return {"kind": "wall", **common}
    return {"kind": "facet", **common, "corners": (size * wall.facet_corners).tolist()}
