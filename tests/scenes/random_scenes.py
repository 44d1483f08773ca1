"""Scenes at random, drawn by hypothesis so that what fails is made small."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
from hypothesis import strategies as st

from tests.scenes.blocks.block_scenes import box
from tests.scenes.blocks.sliding_blocks import Frame, incline
from vv.scene import Contact, Harmonic, Scene, Spheres, Vector, Wall, rotated
from vv.scene.rising import gives_way

MIRROR = np.diag([1.0, -1.0, 1.0])


def part(low: float, high: float) -> st.SearchStrategy[float]:
    """A number between, with few digits, so that a scene reads well."""
    return st.integers(0, 64).map(lambda k: low + (high - low) * k / 64)


def vectors(size: float) -> st.SearchStrategy[Vector]:
    """A vector (3,) of components up to a size."""
    return st.tuples(*3 * [part(-size, size)]).map(np.array)


def directions() -> st.SearchStrategy[Vector]:
    """A unit vector (3,), along an axis or not."""
    oblique = vectors(1.0).filter(lambda a: float(a @ a) > 0.1)
    aligned = st.sampled_from([*np.eye(3), *-np.eye(3)])
    return st.one_of(aligned, oblique.map(lambda a: a / np.linalg.norm(a)))


def frames() -> st.SearchStrategy[Vector]:
    """Three orthonormal rows, the frame's own or not."""
    turned = directions().map(lambda n: np.eye(3) - 2.0 * np.outer(n, n))
    return st.one_of(st.builds(np.eye, st.just(3)), turned)


@st.composite
def any_spheres(draw: st.DrawFn) -> Scene:
    """A valid scene of up to three spheres and two walls: held, locked, spinning, rough or not."""
    n = draw(st.integers(1, 3))
    spheres = _spheres(draw, n, lambda: draw(st.lists(st.booleans(), min_size=3, max_size=3)))
    walls = [Wall(-draw(part(0.1, 0.6)) * normal, normal)
             for normal in draw(st.lists(directions(), max_size=2))]  # fmt: skip
    law = draw(st.sampled_from([Contact(1e4), Contact(1e4, 5e3, 0.5), Contact(1e4, eta_n=5.0)]))
    drag, weight = draw(st.sampled_from([0.0, 2.0])), draw(vectors(5.0))
    bodies: list[Spheres | Wall] = [*walls]
    bodies.insert(draw(st.integers(0, len(walls))), spheres)
    return Scene(tuple(bodies), law, drag, weight * draw(st.booleans()), draw(frames()))


def _spheres(draw: st.DrawFn, n: int, free: Any) -> Spheres:
    def rows(size: float, some: bool = True) -> Vector:
        return np.array([draw(vectors(size)) for _ in range(n)]) * some

    return Spheres(
        position=rows(0.5), velocity=rows(1.0, draw(st.booleans())),
        radius=np.array([draw(part(0.05, 0.2)) for _ in range(n)]),
        mass=np.array([draw(part(0.5, 3.0)) for _ in range(n)]),
        free=np.array([free() for _ in range(n)]), free_spin=np.array([free() for _ in range(n)]),
        spin=rows(3.0, draw(st.booleans())), load=rows(1.0, draw(st.booleans())),
    )  # fmt: skip


@st.composite
def thrown(draw: st.DrawFn) -> Scene:
    """Two unlike spheres that turn, thrown at each other above a rough floor, with drag.

    They begin apart and hold less than 30 J: 6 of speed, 10 of spin, 11 of falling to the floor and
    to the side. All of it in one contact makes it sqrt(2 30/1e6) = 8 mm deep, less than a tenth of
    the smallest radius, where `dem` says that this is no contact of spheres any more.
    """
    radius, mass = draw(st.sampled_from([(0.1, 0.2), (0.2, 0.15)])), (draw(part(0.5, 3.0)), 1.5)
    across = draw(vectors(0.02)) + np.array([0.0, 0.02, 0.0])
    position = np.array([[0.0, 0.0, 0.3], np.array([sum(radius) + 0.03, 0.0, 0.3]) + across])
    velocity = np.array([draw(vectors(0.5)) + np.array([1.0, 0.0, -0.5]), draw(vectors(0.5))])
    spin = np.array([draw(vectors(10.0)), draw(vectors(10.0)) + np.array([1.0, 2.0, 3.0])])
    yes = np.ones((2, 3), bool)
    pair = Spheres(position, velocity, np.array(radius), np.array(mass), yes, spin=spin,
                   free_spin=yes, load=np.array([draw(vectors(1.0)), [0.1, 0.2, 0.3]]))  # fmt: skip
    floor = Wall(np.array([0.0, 0.0, 0.05]), np.array([0.0, 0.0, 1.0]))
    law = Contact(1e6, draw(part(2e5, 8e5)), draw(part(0.1, 0.9)))
    gravity = np.array([0.0, 0.0, -9.81]) + draw(vectors(3.0))
    return Scene((floor, pair), law, eta=draw(part(0.1, 2.0)), gravity=gravity)


@st.composite
def in_a_row(draw: st.DrawFn) -> Scene:
    """Unlike spheres between two walls, free along the row, with weight, drag and loads."""
    n = draw(st.integers(1, 3))
    radius = np.array([draw(part(0.2, 0.5)) for _ in range(n)])
    gaps = np.array([draw(part(0.005, 0.05)) for _ in range(n + 1)])
    x = np.cumsum(gaps[:-1]) + np.cumsum(2 * radius) - radius
    along = np.array([1.0, 0.0, 0.0])
    velocity = np.array([draw(part(-1.0, 1.0)) + 1 / 128 for _ in range(n)])
    spheres = Spheres(
        np.outer(x, along), np.outer(velocity, along), radius,
        np.array([draw(part(0.5, 2.0)) for _ in range(n)]), np.tile(along > 0, (n, 1)),
        load=np.array([[draw(part(0.1, 1.0)), 0.0, 0.0] for _ in range(n)]),
    )  # fmt: skip
    ends = Wall(np.zeros(3), along), Wall((x[-1] + radius[-1] + gaps[-1]) * along, -along)
    gravity = np.array([draw(part(-5.0, 5.0)) + 1 / 128, -9.81, 0.0])
    return Scene((ends[0], spheres, ends[1]), Contact(1e4), draw(part(0.1, 2.0)), gravity)


@st.composite
def slopes(draw: st.DrawFn) -> Scene:
    """A block that slides on a slope, up or down, shaken or not, in some frame; it may stop."""
    frame = Frame(draw(part(5.0, 40.0)), draw(part(0.0, 3.0)), draw(st.booleans()))
    return incline(frame, draw(part(8.0, 45.0)), A=draw(st.sampled_from([0.0, 2.0])),
                   f=draw(part(1.0, 3.0)), v0=draw(part(-1.0, 1.0)) + 1 / 128)  # fmt: skip


@st.composite
def any_blocks(draw: st.DrawFn) -> Scene:
    """One or two boxes on a floor, over it or in the open: locked or not, thrown, spinning, pulled.

    A floor rises only where every block can give way: else a scene is refused.
    """
    blocks, top = [], 0.0
    for name in draw(st.sampled_from(["a", "ab"])):
        half, axes = np.array([draw(part(0.1, 0.6)) for _ in range(3)]), draw(frames())
        axes[0] *= np.linalg.det(axes)  # no mirror
        reach = np.linalg.norm(half) if draw(st.booleans()) else float(half @ np.abs(axes[:, 2]))
        top += float(reach)
        free, spins = (np.array(draw(st.tuples(*3 * [st.booleans()]))) for _ in range(2))
        blocks.append(
            box(name, [draw(part(-0.1, 0.1)), draw(part(-0.1, 0.1)), top], half, axes, free=free,
                free_spin=spins, velocity=draw(vectors(1.0)) * draw(st.booleans()) * free,
                spin=draw(vectors(2.0)) * draw(st.booleans()) * spins,
                load=draw(vectors(300.0)) * draw(st.booleans()))
        )  # fmt: skip
        top += float(reach)
    up = np.array([0.0, 0.0, 1.0])
    rises = all(gives_way(block, up, np.eye(3)) for block in blocks)
    moves = Harmonic(draw(vectors(0.05)) * [1.0, 1.0, float(rises)], np.ones(3))
    floor = Wall(np.zeros(3), up, draw(st.sampled_from([None, None, moves])))
    weight = np.array([draw(part(-3.0, 3.0)), draw(part(-3.0, 3.0)), -9.81])
    gravity = weight * draw(st.sampled_from([1.0, 1e-3, 0.0]))
    law = Contact(np.inf, mu=draw(st.sampled_from([0.0, 0.2, 0.6, 1.5])))
    return Scene((*[floor] * draw(st.booleans()), *blocks), law, gravity=gravity)


def mirrored(scene: Scene) -> Scene:
    """The scene in a mirror: spins, which are no arrows, are turned by the mirror's opposite."""
    turned = rotated(scene, MIRROR)
    bodies = tuple(
        dataclasses.replace(one, spin=-one.spin) if isinstance(one, Spheres) else one
        for one in turned.bodies
    )
    return dataclasses.replace(turned, bodies=bodies)


def moving(scene: Scene, by: Vector) -> Scene:
    """The scene of spheres alone and without drag, seen from a frame that moves by -by [m/s]."""
    bodies = tuple(
        dataclasses.replace(one, velocity=one.velocity + by)
        for one in scene.bodies
        if isinstance(one, Spheres)
    )
    return dataclasses.replace(scene, bodies=bodies, eta=0.0)
