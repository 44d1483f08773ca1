"""A sheet of spheres with friction, at rest in a box, left alone and knocked."""

from __future__ import annotations

import functools

import numpy as np

from cases._papers import LI_2018
from reference_solutions import resting_lattice
from vv.ask import Displacement, History, Knobs, Method, Run, Velocity
from vv.case import (
    Case,
    Exact,
    Ladder,
    Level,
    Parameter,
    Parameters,
    Quantity,
    Scalar,
    Shown,
    Source,
    Tolerance,
    Trial,
    Variant,
)
from vv.scene import Contact, Form, Scene, Spheres, Vector, Wall

RADIUS = 0.05  # m; with m, it decides how spheres roll
X, Z = np.eye(3)[[0, 2]]
FIRST = 3  # walls stand before the spheres
GOAL, EVERY = History(0.1, 1e-3), History(0.1, 2e-4)  # the second at each of the longest steps


def _scene(p: Parameters) -> Scene:
    """The sheet in the plane of x and z, which no sphere leaves; all may turn."""
    place, width = resting_lattice.at_rest(
        n=int(p["n"]), rows=int(p["rows"]), r=RADIUS,
        m=p["m"], kn=p["kn"], g=p["g"], squeeze=p["squeeze"],
    )  # fmt: skip
    count = len(place)
    spheres = Spheres(
        position=place @ [X, Z],
        velocity=p["v"] * _knock(count) @ [X, Z],
        radius=np.full(count, RADIUS),
        mass=np.full(count, p["m"]),
        free=np.tile([True, False, True], (count, 1)),
        free_spin=np.ones((count, 3), bool),
    )
    walls = Wall(np.zeros(3), Z), Wall(np.zeros(3), X), Wall(width * X, -X)
    contact = Contact(p["kn"], p["ks"], p["mu"])
    return Scene((*walls, spheres), contact, gravity=-p["g"] * Z)


def _knock(count: int) -> Vector:
    """Directions (count, 2) that repeat nowhere, one after the other by the golden angle."""
    angle = np.pi * (3 - np.sqrt(5)) * np.arange(count)
    return np.stack([np.cos(angle), np.sin(angle)], axis=1)


def _declare(variant: str, p: Parameters) -> Trial:
    scene = _scene(p)
    bodies = range(FIRST, FIRST + len(scene.spheres))
    moved = tuple(Displacement(body) for body in bodies)
    moving = tuple(Velocity(body) for body in bodies if variant == "knocked")
    seen: tuple[Displacement | Velocity, ...] = (*moved, *moving)
    rungs = tuple(Knobs(dt=dt) for dt in STEPS)
    levels = {Level.QUICK: rungs[:2], Level.DEFAULT: rungs, Level.PAPER: rungs}
    if variant == "booked":
        return Trial(Ladder(scene, EVERY, moved, levels, energies=(*HELD, LOST)), _booked(scene, p))
    told = _at_rest(moved, p) if variant == "still" else _knocked(scene, p)
    return Trial(Ladder(scene, GOAL, seen, levels), told)


def _at_rest(moved: tuple[Displacement, ...], p: Parameters) -> tuple[Quantity, ...]:
    return (
        Scalar(
            "moved", "max|u|", "m", "largest displacement of a sphere",
            lambda run: max(float(np.abs(run.values[what]).max()) for what in moved),
            0.0, p["m"] * p["g"] / p["kn"],
            Exact(dict.fromkeys((Method.SECOND_ORDER, Method.FIRST_ORDER), STILL)),
        ),
    )  # fmt: skip


def _knocked(scene: Scene, p: Parameters) -> tuple[Quantity, ...]:
    """Springs of shear and spins are not seen: what they give back is seen as a gain."""
    put_in, held = _put_in(scene, p), functools.partial(_held, scene)
    return (
        Scalar(
            "gained", "max(E(t) - E(s))", "J",
            "the largest rise, over any time s before, of what motion, weight and normal springs "
            "hold", lambda run: _rise(held(run)), 0.0, put_in, RETURNS,
        ),
        Scalar(
            "left", "E - Er", "J", "what they hold at the end above the sheet at rest, as a mean",
            lambda run: float(held(run)[len(run.times) // 2 :].mean() - held(run)[0]) + put_in,
            None, put_in, LEFT,
        ),
    )  # fmt: skip


def _booked(scene: Scene, p: Parameters) -> tuple[Quantity, ...]:
    """All that there is, by a code's own books: friction only takes, so no loss hides a gain."""
    put_in = _put_in(scene, p)
    return (
        Scalar(
            "gained", "max(E(t) - E(s))", "J",
            "the largest rise, over any time s before, of all energy held",
            lambda run: _rise(sum((run.energies[form] for form in HELD), np.zeros(1))),
            0.0, put_in, GAINS,
        ),
        Scalar(
            "returned", "max(Q(s) - Q(t))", "J",
            "the largest fall, below any time s before, of what friction has taken",
            lambda run: _rise(-run.energies[LOST]), 0.0, put_in, NOTHING,
        ),
    )  # fmt: skip


def _put_in(scene: Scene, p: Parameters) -> float:
    """The energy of the knock [J]."""
    return float(0.5 * p["m"] * p["v"] ** 2 * len(scene.spheres))


def _rise(energy: Vector) -> float:
    """How far a history (k,) rises at most above what it was at any time before."""
    return float((energy - np.minimum.accumulate(energy)).max())


def _held(scene: Scene, run: Run) -> Vector:
    """The energy (k,) [J] in motion without spin, in height, and in normal springs."""
    spheres, law = scene.spheres, scene.contact
    bodies = range(FIRST, FIRST + len(spheres))
    u = np.stack([run.values[Displacement(body)] for body in bodies], axis=1)
    v = np.stack([run.values[Velocity(body)] for body in bodies], axis=1)
    x, (i, j) = spheres.position + u, np.triu_indices(len(spheres), 1)
    reach = spheres.radius[i] + spheres.radius[j]
    overlaps = [reach - np.linalg.norm(x[:, j] - x[:, i], axis=2)]
    overlaps += [spheres.radius - (x - wall.point) @ wall.normal for wall in scene.walls]
    springs = 0.5 * law.kn * sum((np.maximum(o, 0.0) ** 2).sum(axis=1) for o in overlaps)
    motion = 0.5 * (spheres.mass * (v**2).sum(axis=2)).sum(axis=1)
    return np.asarray(motion + springs - u @ scene.gravity @ spheres.mass)


STEPS = (2e-4, 1e-4, 5e-5)  # s; the quickest swing takes about 2e-3 s
STILL = Tolerance(
    1e-9,
    "forces balance to the rounding of places, kn eps x = 1e-10 N where a weight is 13 N, and what "
    "that moves is not damped",
    slack="codes round places in their own ways",
)
HELD = (Form.KINETIC, Form.NORMAL, Form.SHEAR, Form.GRAVITY)
LOST = Form.FRICTION
BOTH = Method.SECOND_ORDER, Method.FIRST_ORDER
RETURNS = Exact(dict.fromkeys(BOTH, Tolerance(
    2e-2,
    "shear springs and spins, which are not seen, hold 0.18 of what was put in at most and give "
    "back 7e-3 of it where they are booked, whatever the step",
)))  # fmt: skip
GAINS = Exact({
    method: Tolerance(
        1e-8,
        "no contact opens, and a leapfrog keeps m v- v+/2 and closed springs together but for "
        "normals that turn, by 1e-4 rad in a swing",
        dt=STEPS[0], order=order,
    )
    for method, order in ((Method.SECOND_ORDER, 2), (Method.FIRST_ORDER, 1))
})  # fmt: skip
NOTHING = Exact(dict.fromkeys(BOTH, Tolerance(
    1e-12, "what friction takes in a step is more than nothing, or added as nothing: rounding"
)))  # fmt: skip
LEFT = Shown("friction takes what slips, which hangs on each slip; codes may be compared")
KNOCKED = "E(t) <= E(s) for any s < t, E of motion, weight and springs"
CASE = Case(
    name="resting",
    title="A frictional lattice at rest",
    source=Source(
        *LI_2018,
        "The contact law is that of Eqs. 4-8. The sheet is chosen: 33 spheres, all contacts of "
        "which are closed and their shear springs slack at t = 0. It is put where it is at rest.",
    ),
    parameters=(
        Parameter("n", 6.0, "", "spheres in a long row"),
        Parameter("rows", 6.0, "", "rows, long and short in turn"),
        Parameter("m", 1.3, "kg", "mass of a sphere"),
        Parameter("kn", 1e6, "N/m", "normal contact stiffness"),
        Parameter("ks", 8e5, "N/m", "shear contact stiffness"),
        Parameter("mu", 0.3, "", "friction coefficient"),
        Parameter("g", 9.81, "m/s2", "gravity"),
        Parameter("squeeze", 2e-4, "", "how much narrower the box is than the sheet"),
        Parameter("v", 0.0, "m/s", "speed of each sphere at the start"),
    ),
    variants=(
        Variant("still", "left alone for 0.1 s", "u = 0"),
        Variant(
            "knocked", "every sphere is knocked another way, for 0.1 s",
            KNOCKED, {"v": 0.02},
        ),
        Variant(
            "booked", "the same by a code's own books of energy, with spins and shear springs",
            f"{KNOCKED}; Q(t) >= Q(s), Q what friction has taken", {"v": 0.02},
        ),
    ),
    declare=_declare,
)  # fmt: skip
