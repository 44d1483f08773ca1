"""Small scenes whose contact normals do not turn: random ones in the x-y plane, and a few more."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable

import numpy as np

from vv.scene import Contact, Scene, Spheres, Vector, Wall

Random = np.random.Generator
UP, ALONG = np.array([0.0, 1.0, 0.0]), np.array([1.0, 0.0, 0.0])


def plane(x: float, y: float) -> Vector:
    return np.array([x, y, 0.0])


def law(r: Random, rough: bool) -> Contact:
    kn = 10 ** r.uniform(2.5, 3.5)
    return Contact(kn, kn * r.uniform(0.3, 1.2), r.uniform(0.1, 0.8)) if rough else Contact(kn)


def balls(r: Random, position: Vector, velocity: Vector, radius: Vector, free: Vector) -> Spheres:
    n = len(radius)
    load = r.uniform(-2, 2, (n, 3)) * [1, 1, 0] * r.integers(0, 2)
    mass = r.uniform(0.5, 2.0, n)
    return Spheres(position, velocity, radius, mass, np.tile(free.astype(bool), (n, 1)), load=load)


def drag(r: Random) -> float:
    return float(r.uniform(0.2, 3.0) * r.integers(0, 2))


def chain(r: Random) -> Scene:
    """Balls in a row between two walls, free along the row, some overlapping at first."""
    n = int(r.integers(1, 4))
    radius = r.uniform(0.2, 0.5, n)
    gaps = r.uniform(-0.02, 0.05, n + 1)
    x = np.cumsum(gaps[:-1]) + np.cumsum(2 * radius) - radius
    velocity = np.outer(r.uniform(-1, 1, n), ALONG)
    spheres = balls(r, np.outer(x, ALONG), velocity, radius, ALONG)
    end = plane(x[-1] + radius[-1] + gaps[-1], 0.0)
    walls = (Wall(np.zeros(3), ALONG), Wall(end, -ALONG))
    gravity = plane(r.uniform(-5, 5), -9.81) * r.integers(0, 2)
    return Scene((walls[0], spheres, walls[1]), law(r, False), drag(r), gravity)


def viscous(r: Random) -> Scene:
    """The same, without gravity at times, where contact is viscous."""
    scene = chain(r)
    critical = 2 * (scene.contact.kn * float(scene.spheres.mass.min())) ** 0.5
    law = dataclasses.replace(scene.contact, eta_n=r.uniform(0.01, 0.7) * critical)
    return dataclasses.replace(scene, contact=law)


def thrown(r: Random) -> Scene:
    """A ball thrown on a rough plane under oblique gravity."""
    radius = r.uniform(0.2, 0.5, 1)
    position = plane(0.0, radius[0] + r.uniform(-0.02, 0.1))[None]
    velocity = plane(r.uniform(-2, 2), r.uniform(-1, 1))[None]
    gravity = plane(r.uniform(-6, 6), -9.81)
    spheres = balls(r, position, velocity, radius, np.ones(3))
    return Scene((Wall(np.zeros(3), UP), spheres), law(r, True), drag(r), gravity)


def squeezed(r: Random) -> Scene:
    """A ball between two rough planes that are closer, or hardly wider, than it is."""
    radius = r.uniform(0.2, 0.5, 1)
    position = plane(0.0, radius[0] - r.uniform(0.0, 0.03))[None]
    top = Wall(plane(0.0, 2 * radius[0] + r.uniform(-0.05, 0.02)), -UP)
    velocity = plane(r.uniform(-2, 2), r.uniform(-1, 1))[None]
    spheres = balls(r, position, velocity, radius, np.ones(3))
    return Scene((Wall(np.zeros(3), UP), spheres, top), law(r, True), drag(r))


def cornered(r: Random) -> Scene:
    """A ball in the corner of two rough planes, each sliding where the other presses."""
    radius = r.uniform(0.2, 0.5, 1)
    position = (radius[0] + r.uniform(-0.02, 0.05, 3))[None] * [1, 1, 0]
    velocity = plane(r.uniform(-2, 1), r.uniform(-2, 1))[None]
    gravity = plane(r.uniform(-9, 0), -9.81)
    spheres = balls(r, position, velocity, radius, np.ones(3))
    walls = (Wall(np.zeros(3), UP), Wall(np.zeros(3), ALONG))
    return Scene((walls[0], spheres, walls[1]), law(r, True), drag(r), gravity)


def dragged(r: Random) -> Scene:
    """Balls in a row, pressed into a rough floor by fixed amounts and pushing each other along."""
    n = int(r.integers(2, 4))
    radius = np.full(n, r.uniform(0.2, 0.5))
    x = np.cumsum(2 * radius + r.uniform(-0.01, 0.05, n))
    position = np.stack([x, radius - r.uniform(0.005, 0.05), 0 * x], axis=1)
    position[:, 1] = position[0, 1]
    velocity = np.outer(r.uniform(-1.5, 1.5, n), ALONG)
    spheres = balls(r, position, velocity, radius, ALONG)
    return Scene((Wall(np.zeros(3), UP), spheres), law(r, True), drag(r))


KINDS: tuple[Callable[[Random], Scene], ...] = (
    chain, thrown, squeezed, cornered, dragged, viscous,
)  # fmt: skip


def small_scene(seed: int) -> Scene:
    """A scene of the kinds above, in turn."""
    return KINDS[seed % len(KINDS)](np.random.default_rng(seed))


def crowded(ratio: float) -> Scene:
    """A light ball at rest before a wall, and a heavy one that comes for it."""
    spheres = Spheres(
        position=np.array([[0.7, 0.0, 0.0], [2.0, 0.0, 0.0]]),
        velocity=np.array([[0.0, 0.0, 0.0], [-1.0, 0.0, 0.0]]),
        radius=np.full(2, 0.5),
        mass=np.array([1.0, ratio]),
        free=np.ones((2, 3), bool),
    )
    return Scene((Wall(np.zeros(3), np.array([1.0, 0.0, 0.0])), spheres), Contact(1e10 * ratio))


FLOOR = Wall(np.zeros(3), np.array([0.0, 0.0, 1.0]))
DOWN = np.array([0.0, 0.0, -9.81])


def ball(position: Vector, velocity: Vector, **changed: object) -> Spheres:
    """One sphere of 1 m and 1 kg, free unless changed."""
    one = np.ones(1)
    place = {"position": [position], "velocity": [velocity]}
    data = {**place, "radius": one, "mass": one, "free": np.ones((1, 3)), **changed}
    return Spheres(**data)  # type: ignore[arg-type]
