"""Spheres without friction settle in a box: whatever their ways, their rest obeys exact laws."""

from __future__ import annotations

import numpy as np

from reference_solutions.bulk import packing
from vv.ask import Displacement, History, Knobs, Method, Run
from vv.case import (
    Case,
    Exact,
    Ladder,
    Level,
    Parameter,
    Parameters,
    Scalar,
    Source,
    Tolerance,
    Trial,
    Variant,
)
from vv.scene import Contact, Scene, Spheres, Vector, Wall
from vv.scene.neighbours import overlapping

COUNT, ACROSS = 100, 4  # spheres, and how many lie along each side of the box
LARGEST, SIZES = 0.01, (0.8, 0.85, 0.9, 0.95, 1.0)  # radius [m], and radii over it
SIDE = 1.1 * 2 * LARGEST * ACROSS  # m
SEEN = tuple(Displacement(i) for i in range(COUNT))  # walls are bodies after the spheres
GOAL = History(2.4, 0.15)
SEEDS = (1, 2, 3)
FINE, COARSE = 1e-4, 0.2  # to which parts of the weight and the radius, and contacts, are told


def _told(value: float, unit: float) -> float:
    """The nearest multiple of a unit: what lies below it is chance, and differs by platform."""
    return round(value / unit) * unit


def _spheres(seed: int, p: Parameters) -> Spheres:
    """Layers of spheres of random size and velocity."""
    random = np.random.default_rng(seed)
    layers = [np.arange(-(-COUNT // ACROSS**2)), np.arange(ACROSS), np.arange(ACROSS)]
    grid = np.stack(np.meshgrid(*layers, indexing="ij"), 3).reshape(-1, 3)[:COUNT, ::-1]
    size = random.choice(SIZES, COUNT)
    aside = 0.5 * LARGEST * (1 - size)[:, None] * random.uniform(-1, 1, (COUNT, 3))
    return Spheres(
        np.asarray(2 * LARGEST * (grid + 0.5) + aside, float),
        0.3 * random.normal(size=(COUNT, 3)),
        LARGEST * size,
        p["m"] * size**3,
        np.ones((COUNT, 3), bool),
    )


def _walls() -> tuple[Wall, ...]:
    """A floor and four sides."""
    near = [Wall(np.zeros(3), n) for n in np.eye(3)]
    return (*near, *(Wall(SIDE * np.ones(3), -n) for n in np.eye(3)[:2]))


def _at_rest(scene: Scene, run: Run) -> Spheres:
    """The spheres where the run ends."""
    s = scene.spheres
    moved = np.stack([run.values[what][-1] for what in SEEN])
    return Spheres(s.position + moved, s.velocity, s.radius, s.mass, s.free)


def _pressed(scene: Scene, run: Run) -> Vector:
    """How far (n, 5) [m] spheres have sunk into each wall."""
    s = _at_rest(scene, run)
    gaps = [(s.position - wall.point) @ wall.normal - s.radius for wall in scene.walls]
    return np.maximum(-np.stack(gaps, axis=1), 0.0)


def _contacts(scene: Scene, run: Run) -> float:
    """Contacts for each sphere, those with walls included."""
    touching = len(overlapping(_at_rest(scene, run))) + np.count_nonzero(_pressed(scene, run))
    return touching / COUNT


def _sideways(kn: float, scene: Scene, run: Run) -> float:
    """The larger part of the push of opposite sides that does not cancel [N]."""
    x, y, _, far_x, far_y = kn * _pressed(scene, run).sum(axis=0)
    return float(max(abs(x - far_x), abs(y - far_y)))


def _still(run: Run) -> float:
    """The farthest way of a sphere since the output before the last [m]."""
    ways = [run.values[what][-1] - run.values[what][-2] for what in SEEN]
    return float(np.linalg.norm(ways, axis=1).max())


def _declare(variant: str, p: Parameters) -> Trial:
    spheres = _spheres(int(variant.removeprefix("seed-")), p)
    down = np.array([0.0, 0.0, -p["g"]])
    scene = Scene((spheres, *_walls()), Contact(p["kn"]), p["eta"], down)
    weight = packing.weight(spheres.mass, p["g"])
    floor = Scalar(
        "floor", "F", "N", "push of the floor at the end, from overlaps",
        lambda run: _told(p["kn"] * float(_pressed(scene, run)[:, 2].sum()), FINE * weight),
        weight, weight, Exact(REST),
    )  # fmt: skip
    sides = Scalar(
        "sides", "S", "N", "push of opposite sides that does not cancel at the end",
        lambda run: _told(_sideways(p["kn"], scene, run), FINE * weight), 0.0, weight, Exact(REST),
    )  # fmt: skip
    contacts = Scalar(
        "coordination", "c", "", "contacts for each sphere at the end, those with walls included",
        lambda run: _told(_contacts(scene, run), COARSE), packing.CONTACTS, packing.CONTACTS,
        Exact(COUNTED),
    )  # fmt: skip
    still = Scalar(
        "still", "d", "m", "farthest way of a sphere in the last 0.15 s",
        lambda run: _told(_still(run), FINE * LARGEST), 0.0, LARGEST, Exact(REST),
    )  # fmt: skip
    ladder = Ladder(scene, GOAL, SEEN, dict.fromkeys(Level, (Knobs(dt=5e-5),)))
    return Trial(ladder, (floor, sides, contacts, still))


SLOWEST = "half of all packs leave less than 4e-9, but how long a pack takes to rest is chance"
REST = {
    method: Tolerance(
        0.5 * FINE,
        "what still moves: the slowest of 40 packs leaves 4e-6 after 2.1 s",
        slack=SLOWEST,
    )
    for method in (Method.SECOND_ORDER, Method.FIRST_ORDER)
}
COUNTED = {
    method: Tolerance(
        0.025,
        "springs that yield close a few contacts more: in 40 packs the mean is "
        "3.012 +- 0.006 (95 %), and each lies between 2.97 and 3.05",
    )
    for method in (Method.SECOND_ORDER, Method.FIRST_ORDER)
}
CASE = Case(
    name="packing",
    title="A packing at rest",
    source=Source(
        "Moukarzel (1998), Isostatic phase transition and instability in stiff granular "
        "materials, Physical Review Letters 81(8), 1634-1637",
        "10.1103/PhysRevLett.81.1634",
        "The ways of the spheres differ from code to code after some collisions, and are not "
        "compared; laws of their rest are, over several seeds.",
    ),
    parameters=(
        Parameter("m", 0.01, "kg", "mass of the largest sphere"),
        Parameter("kn", 1e5, "N/m", "contact stiffness"),
        Parameter("eta", 0.2, "N s/m", "drag that brings all to rest"),
        Parameter("g", 9.81, "m/s2", "gravity"),
    ),
    variants=tuple(
        Variant(
            f"seed-{seed}",
            f"{COUNT} spheres, random start {seed}",
            "F = sum m g; opposite sides push alike; 3 contacts for each sphere",
            inert=frozenset({"kn", "eta"}),
            level=Level.QUICK if seed == 1 else Level.DEFAULT,
        )
        for seed in SEEDS
    ),
    declare=_declare,
)  # fmt: skip
