"""Blocks that slide, with their exact paths, and the asks that put them to external codes."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from reference_solutions.blocks import incline, responding_block
from tests.scenes.blocks.driven_blocks import THREE, UP, G, carried, off, sines, slope
from vv.ask import Ask, Displacement, History, Knobs, Run
from vv.scene import (
    Block,
    Contact,
    Harmonic,
    Scene,
    Spheres,
    Vector,
    Wall,
    box_geometry,
    polyhedron_inertia,
    rotated,
    rotation_about_z,
)

TILT = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
TURN = rotation_about_z(0.7) @ TILT
BLOCK = Displacement(1)
Path = Callable[[Vector], Vector]


@dataclass(frozen=True)
class Known:
    """A block, its exact path along some axes of the frame, and how far a code may be off it.

    turned: the code is given the scene turned as a whole.
    """

    scene: Scene
    along: Vector
    path: Path
    within: float
    duration: float = 2.0
    turned: bool = False

    def ask(self, dt: float = 5e-5, kn: float = 1e10) -> Ask:
        scene = rotated(self.scene, TURN) if self.turned else self.scene
        return Ask(scene, History(self.duration, 0.02), (BLOCK,), Knobs(dt, kn))

    def error(self, run: Run) -> float:
        along = self.along @ TURN.T if self.turned else self.along
        return off(run.values[BLOCK] @ along.T, self.path(run.times))


def falling(phi: float, v0: float) -> Known:
    scene = slope(28.0, phi, v0=v0)
    path = functools.partial(incline.gravity, alpha=28.0, phi=phi, g=G, v0=v0)
    return Known(scene, scene.axes[:1], lambda t: path(t)[:, None], 1e-12, 1.0)


def newmark(phi: float, A: float, turned: bool = False) -> Known:
    scene = slope(20.0, phi, sines((A, 1.0)))
    path = functools.partial(incline.newmark, alpha=20.0, phi=phi, A=A, f=1.0, g=G, v0=0.0)
    return Known(scene, scene.axes[:1], lambda t: path(t)[:, None], 1e-4, turned=turned)


def two_ways() -> Known:
    scene = slope(45.0, 50.0, sines((2.0, 1.0), (1.0, 2.0)), free=THREE)
    drive = {"alpha": 45.0, "phi": 50.0, "ax": 2.0, "fx": 1.0, "ay": 1.0, "fy": 2.0, "g": G}
    return Known(scene, scene.axes[:2], functools.partial(incline.two_directions, **drive), 1e-3)


def dragged(turned: bool = False) -> Known:
    path = functools.partial(responding_block.one_direction, D=0.2, f=2.0, mu=0.6, g=G)
    return Known(
        carried((0.2, 2.0)), np.eye(3)[:1], lambda t: path(t)[:, None], 2e-3, turned=turned
    )


def lifted(turned: bool = False) -> Known:
    scene = carried((0.1, 2.0), (0.1, 4.0), (0.1, 1.0), free=THREE)
    shape = {"Dx": 0.1, "fx": 2.0, "Dy": 0.1, "fy": 4.0, "Dz": 0.1, "fz": 1.0, "mu": 0.6, "g": G}
    path = functools.partial(responding_block.three_directions, **shape)
    return Known(scene, np.eye(3), path, 2e-3, turned=turned)


SCENES = {
    "falling": falling(15.0, 0.0),
    "thrown": falling(25.0, 0.1),
    "newmark": newmark(30.0, 5.0),
    "newmark, turned": newmark(35.0, 5.0, turned=True),
    "uphill too": newmark(30.0, 20.0),
    "two ways": two_ways(),
    "dragged": dragged(),
    "dragged, turned": dragged(turned=True),
    "lifted": lifted(),
    "lifted, turned": lifted(turned=True),
}


def bounced() -> Scene:
    """Unlike spheres that a shaken field and an oblique wall, which swings, throw about."""
    n = np.array([0.2, -0.4, 1.0]) / np.linalg.norm([0.2, -0.4, 1.0])
    swing = Harmonic(np.array([0.02, 0.03, 0.01]), np.array([3.0, 5.0, 4.0]), np.array([0.3, 1, 2]))
    shaking = Harmonic(np.array([4.0, 0.0, 3.0]), np.array([2.0, 1.0, 6.0]), np.full(3, 0.5))
    radius, mass = np.array([0.3, 0.2]), np.array([1.0, 3.0])
    place = np.array([[0.0, 0.0, 0.0], [2.0, 1.0, 0.0]])
    place += np.outer(radius + np.array([0.01, 0.05]) - place @ n, n)
    balls = Spheres(place, np.zeros((2, 3)), radius, mass, np.ones((2, 3), bool))
    springs = Contact(2e4, 1.2e4, 0.4)
    return Scene((Wall(np.zeros(3), n, swing), balls), springs, gravity=-G * UP, shaking=shaking)


BOUNCED = Ask(bounced(), History(0.3, 0.01), (Displacement(1), Displacement(2)), Knobs(2e-5))
STILL = Ask(slope(28.0, 40.0), History(1.0, 0.02), (BLOCK,), Knobs(5e-5, 1e10))
ASKS = {**{name: known.ask() for name, known in SCENES.items()}, "bounced": BOUNCED, "held": STILL}


def loose() -> Ask:
    """Newmark's block, flat and free to turn, which the shaking makes rock on its springs."""
    scene = slope(20.0, 30.0, sines((5.0, 1.0)))
    half, axes = np.array([0.5, 0.5, 0.25]), scene.axes
    vertices, faces = box_geometry(half[2] * axes[2], half, axes)
    mass, inertia = polyhedron_inertia(vertices, faces, 2500.0)
    free = np.ones(3, bool)
    block = Block("flat", vertices, faces, mass, inertia, np.zeros(3), free, free)
    scene = dataclasses.replace(scene, bodies=(*scene.walls, block))
    return Ask(scene, History(2.0, 0.02), (BLOCK,), Knobs(5e-5, 1e10))


def loaded() -> Ask:
    """Newmark's block, turned, under a dead load that pushes it on and lifts it."""
    ask = newmark(30.0, 5.0, turned=True).ask(1e-4, 1e9)
    load = TURN @ np.array([3000.0, 0.0, 2000.0])
    block = dataclasses.replace(ask.scene.blocks[0], load=load)
    scene = dataclasses.replace(ask.scene, bodies=(*ask.scene.walls, block))
    return dataclasses.replace(ask, scene=scene)


LADDER = [1e-4, 2.5e-5, 1e-5]
FADING = {
    name: [Ask(known.scene, History(0.7, 0.02), (BLOCK,), Knobs(dt, 1e9)) for dt in (*LADDER, 2e-6)]
    for name, known in (("dragged", dragged()), ("lifted", lifted()))
}
CLUMPED = {
    **{name: SCENES[name].ask(1e-4, 1e9) for name in ("thrown", "newmark, turned", "dragged")},
    "lifted": lifted(turned=True).ask(1e-4, 1e9),
    "loaded": loaded(),
    "loose": loose(),
}
SAME = [name for name in CLUMPED if name != "loose"]
COARSE = {name: SCENES[name].ask(1e-3, 1e8) for name in ("thrown", "newmark, turned", "dragged")}


def odd() -> dict[str, Ask]:
    """Blocks without friction, thrown uphill, and pulled off their slope."""
    slick, thrown = slope(28.0, 0.0, sines((5.0, 1.0))), slope(28.0, 15.0, v0=-1.0)
    load = 40e3 * thrown.walls[0].normal
    pulled = dataclasses.replace(slope(28.0, 15.0).blocks[0], load=load)
    scenes = {
        "slick": slick,
        "thrown uphill": thrown,
        "pulled off": dataclasses.replace(thrown, bodies=(*thrown.walls, pulled)),
    }
    return {
        name: Ask(scene, History(0.2, 0.02), (BLOCK,), Knobs(1e-4, 1e8))
        for name, scene in scenes.items()
    }


ODD = odd()
