"""Small scenes of unlike spheres that tell apart what single contacts cannot.

One sphere from another, one wall from another, a second touch from a first.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from vv.ask import Ask, Displacement, History, Knobs
from vv.scene import Contact, Scene, Spheres, Vector, Wall

STICKING = Contact(kn=2e4, ks=1.2e4, mu=1e6)
"""Whatever touches sticks until it opens, when its shear force is lost."""


def spheres(position: Sequence[Sequence[float] | Vector], **given: Any) -> Spheres:
    """Unlike spheres, at rest and free to move unless given otherwise."""
    n = len(position)
    data = {
        "velocity": np.zeros((n, 3)),
        "radius": np.array([0.3, 0.2, 0.25])[:n],
        "mass": np.array([1.0, 3.0, 2.0])[:n],
        "free": np.ones((n, 3), bool),
    }
    return Spheres(np.array(position), **{**data, **given})


def facing(*normal: float, at: Sequence[float]) -> Wall:
    n = np.array(normal)
    return Wall(np.array(at), n / np.linalg.norm(n))


def falling() -> Scene:
    """Three that touch nothing; the first and the last carry the same load."""
    load = np.array([[4.0, 0.0, 7.0], [-9.0, 2.0, 0.0], [4.0, 0.0, 7.0]])
    group = spheres([[0, 0, 0], [2, 1, 0], [-1, 3, 2]], load=load)
    return Scene((group,), STICKING, eta=2.0, gravity=np.array([1.0, -9.81, 3.0]))


def landing() -> Scene:
    """Two dropped into a corner, which meet each wall at a time of their own."""
    walls = facing(0, 1, 0, at=(0.7, -0.2, 5.0)), facing(0, 0, 1, at=(-3.0, 0.9, 0.1))
    group = spheres([[0, 0.13, 0.42], [2, 0.01, 0.34]])
    gravity = np.array([12.0, -20.0, -25.0])
    return Scene((walls[0], group, walls[1]), STICKING, 4.0, gravity)


def bouncing(on: str, speed: float = 0.5) -> Scene:
    """A ball that falls twice, on a sphere or on a wall, where it holds on as it touches.

    On a sphere and on an oblique wall it turns; on an aligned wall it moves in a plane.
    """
    n, flat = {
        "sphere": (np.array([0.0, 1.0, 0.0]), np.array([0.8, 0.0, 0.6])),
        "oblique": (
            np.array([1.0, 2.0, 0.0]) / np.sqrt(5),
            np.array([2.0, -1.0, 0.0]) / np.sqrt(5),
        ),
        "aligned": (np.array([0.0, 0.0, 1.0]), np.array([1.0, 0.0, 0.0])),
    }[on]
    turns = on != "aligned"
    foot = np.array([0.4, -0.1, 0.6])
    ball = spheres(
        [foot + 0.301 * n],
        velocity=[speed * flat - 0.6 * n],
        spin=[np.array([1.0, 0.5, -2.0]) * turns],
        free=[np.abs(flat) + np.abs(n) > 0 if on == "aligned" else [True] * 3],
        free_spin=[[turns] * 3],
        load=[-6.0 * n + 2.0 * flat],
    )
    fixed = spheres([foot - 0.3 * n], free=[[False] * 3])
    partner = fixed if on == "sphere" else Wall(foot, n)
    return Scene((partner, ball), STICKING, 0.0 if turns else 0.5, -25.0 * n)


def pressed(side: Sequence[float], first: bool) -> Scene:
    """A ball pushed against a larger fixed one, which lies on the other side of it."""
    n, free = np.array(side), np.abs([side]) > 0
    fixed = spheres([[0, 0, 0]], radius=[0.5], mass=[7.0], free=[[False] * 3])
    ball = spheres([0.81 * n], mass=[2.0], free=free, load=[-30.0 * n])
    bodies = (ball, fixed) if first else (fixed, ball)
    return Scene(bodies, STICKING, eta=3.0, gravity=5.0 * n)


def rolling(inertia: float = 0.4, lock: bool = False) -> Scene:
    """A ball in balance on a floor, 5 % of its radius deep, thrown and turning both ways.

    inertia: in m r2. lock: it cannot turn about x, and so not roll along z.
    """
    m, g, r = 1.0, 20.0, 0.02
    ball = spheres(
        [[0.3, r - m * g / STICKING.kn, -0.2]],
        radius=[r],
        velocity=[[0.5, 0, -0.3]],
        spin=[[0 if lock else 4, 0, 9]],
        inertia=[inertia * m * r**2],
        free_spin=[[not lock, True, True]],
    )
    return Scene((facing(0, 1, 0, at=(5, 0, -4)), ball), STICKING, gravity=np.array([0, -g, 0]))


def rolled(scene: Scene, times: Vector, depth: float) -> Vector:
    """The closed form (times, 1, 3) [m] of `rolling`; slip is seen `depth` overlaps deep.

    With the slip s = v + a w x n of a surface at the arm a, and m v' = q, I w' = -b n x q,
    q' = -ks s: s swings at W^2 = ks (1/m + a b/I), or ks/m where it cannot turn.
    """
    s, g = scene.spheres, scene.gravity
    m, r, ks = s.mass[0], s.radius[0], scene.contact.ks
    overlap = -m * g[1] / scene.contact.kn
    seen, arm, (vx, _, vz), (wx, _, wz) = (
        r - depth * overlap,
        r - overlap / 2,
        s.velocity[0],
        s.spin[0],
    )
    moved = np.zeros((len(times), 1, 3))
    for axis, v, w, turns in ((0, vx, wz, True), (2, vz, -wx, s.free_spin[0, 0])):
        square = ks * (1 / m + turns * seen * arm / s.inertia[0])
        swing = times - np.sin(np.sqrt(square) * times) / np.sqrt(square)
        moved[:, 0, axis] = v * times - ks / m * (v + seen * w) / square * swing
    return moved


@dataclass(frozen=True)
class Known:
    """A scene, how long it runs [s], and how far codes may be off, in parts of the largest.

    within: the in-house code, which sees a contact open within a step and drag at mid-step, and
    the others, which do neither.
    """

    scene: Scene
    duration: float
    within: tuple[float, float]
    dt: float = 5e-5

    def ask(self, scene: Scene) -> Ask:
        """All spheres' displacements, at ten times, in the scene or one that adds bodies to it."""
        goal = History(self.duration, self.duration / 10)
        kinds = [isinstance(g, Spheres) for g in self.scene.bodies for _ in range(len(g))]
        seen = tuple(Displacement(int(body)) for body in np.flatnonzero(kinds))
        return Ask(scene, goal, seen, Knobs(self.dt))


SCENES = {
    "falling": Known(falling(), 0.4, (1e-7, 1e-4), dt=1e-4),
    "landing": Known(landing(), 0.15, (5e-3, 5e-3)),
    "twice on a sphere": Known(bouncing("sphere"), 0.2, (4e-4, 4e-4)),
    "slowly on a sphere": Known(bouncing("sphere", 0.2), 0.1, (1e-3, 2e-3)),
    "twice on a wall": Known(bouncing("oblique"), 0.2, (4e-4, 4e-4)),
    "twice in a plane": Known(bouncing("aligned"), 0.2, (2e-3, 2e-3)),
    "below": Known(pressed([0, -1, 0], first=True), 0.2, (1e-5, 2e-4)),
    "left": Known(pressed([-1, 0, 0], first=False), 0.2, (1e-5, 2e-4)),
    "rolling": Known(rolling(), 0.05, (1e-5, 1e-5)),
    "rolling as given": Known(rolling(0.7), 0.05, (1e-5, 1e-5)),
    "rolling one way": Known(rolling(0.7, lock=True), 0.05, (1e-5, 1e-5)),
}
