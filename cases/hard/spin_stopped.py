"""Two spinning prisms meet edge on edge, and the impact takes all their spin."""

from __future__ import annotations

import numpy as np

from reference_solutions.hard import spin_stopped
from vv.ask import Displacement, History, Knobs, Method, Observable, Run
from vv.case import (
    Case,
    Exact,
    Ladder,
    Level,
    Motion,
    Parameter,
    Parameters,
    Series,
    Source,
    Tolerance,
    Trial,
    Variant,
)
from vv.scene import Block, Contact, Scene, Vector, box_geometry, polyhedron_inertia

AXES = np.array([[2.0, -1.0, 2.0], [2.0, 2.0, -1.0], [-1.0, 2.0, 2.0]]) / 3  # n is the third
NORMAL = AXES[2]
SIDES, LONG, DENSITY = (1.0, 0.8), (1.5, 1.2), 2500.0  # m, m, kg/m3
MASSES = {f"m{i + 1}": DENSITY * SIDES[i] ** 2 * LONG[i] for i in (0, 1)}
Shape = tuple[Vector, tuple[tuple[int, ...], ...], float, Vector]
LEAST = 30.0  # deg between the edges
APART = 1e-10  # gap at t = 0 [m]: too small to be seen, and well above rounding errors


def _prism(side: float, length: float, edge: Vector, centre: Vector) -> Shape:
    """Vertices, faces, mass and inertia of a prism with an edge above its centre and one below."""
    across = np.cross(NORMAL, edge)
    axes = np.stack([edge, (across + NORMAL) / np.sqrt(2), (NORMAL - across) / np.sqrt(2)])
    vertices, faces = box_geometry(centre, np.array([length, side, side]) / 2, axes)
    return vertices, faces, *polyhedron_inertia(vertices, faces, DENSITY)


def _scene(p: Parameters) -> Scene:
    """The edges cross at the origin, away from the middles of both."""
    turn = np.radians(p["crossing"])
    edges = AXES[0], np.cos(turn) * AXES[0] + np.sin(turn) * AXES[1]
    arms = np.stack([
        p["a1"] * edges[0] + SIDES[0] / np.sqrt(2) * NORMAL,
        p["a2"] * edges[1] - SIDES[1] / np.sqrt(2) * NORMAL,
    ])  # fmt: skip
    lift = np.array([0.0, APART])
    shapes = [_prism(SIDES[i], LONG[i], edges[i], lift[i] * NORMAL - arms[i]) for i in (0, 1)]
    spins = spin_stopped.spins(arms, [shape[3] for shape in shapes], NORMAL, **MASSES, V=p["V"])
    free = np.ones(3, bool)
    bodies = tuple(
        Block(name, *shape, velocity=-speed * NORMAL, free=free, free_spin=free, spin=spin)
        for name, shape, speed, spin in zip(
            ("below", "above"), shapes, (0.0, p["V"]), spins, strict=True
        )
    )
    return Scene(bodies, Contact(np.inf))


def _declare(variant: str, p: Parameters) -> Trial:
    _check(p)
    speed = spin_stopped.together(**MASSES, V=p["V"])
    goal = History(p["duration"], p["duration"] / 10)
    coarsest = min(STEP / p["V"], goal.interval)
    judge = _judge(coarsest, APART / abs(speed * p["duration"]))

    def path(t: Vector) -> Vector:
        return np.outer(speed * t, [0.0, 0.0, 1.0])

    motions = {
        name: Motion(Displacement(i), AXES, path, goal.times(None), "m")
        for i, name in enumerate(("below", "above"))
    }
    parts = tuple(
        motion.component(
            k, f"{name}{where}", f"displacement of the prism {name} along {line}", judge
        )
        for name, motion in motions.items()
        for k, where, line in ((2, "", "n"), (0, "_across", "the lower edge"))
    )
    seen = tuple(motion.observable for motion in motions.values())
    # as deep as at 1 m/s: a prism sinks by V sqrt(m/kn)
    kn = KN * max(1.0, p["V"]) ** 2
    rungs = tuple(Knobs(coarsest / 2**i, kn) for i in range(3))
    levels = {Level.QUICK: rungs[:2], Level.DEFAULT: rungs, Level.PAPER: rungs}
    return Trial(Ladder(_scene(p), goal, seen, levels), (*parts, _middle(p, speed, seen)))


def _check(p: Parameters) -> None:
    """Raise ValueError where edges are too near parallel, or one ends before the other."""
    if not LEAST <= p["crossing"] <= 180 - LEAST:
        raise ValueError(
            f"crossing = {p['crossing']!r} deg; from {LEAST} to {180 - LEAST} deg edges touch at "
            "a point"
        )
    for name, length in zip(("a1", "a2"), LONG, strict=True):
        if not abs(p[name]) < 0.4 * length:
            raise ValueError(
                f"{name} = {p[name]!r} m; the edge ends {length / 2} m from its middle"
            )


def _judge(coarsest: float, gap: float) -> Exact:
    """The bounds of rigid contact; coarsest: the longest step [s]; gap: over the displacement."""
    second = Tolerance(
        2e-6,
        "an error of (w dt)^2 of the displacement, w = 0.8 1/s the faster spin: the prisms rotate "
        "by w dt in the step of the impact. They come closer by the gap first",
        dt=coarsest, order=2, floor=1e-8 + gap,
        slack="prisms that touch at t = 0 meet in the first step, and hardly rotate in it",
    )  # fmt: skip
    first = Tolerance(
        5e-2, "the impact takes effect at the end of its step: an error of dt V over the common "
        "displacement of 0.04 m",
        dt=coarsest, order=1,
        slack="prisms that touch at t = 0 meet in the first step, which has no such error",
    )  # fmt: skip
    return Exact(
        {Method.SECOND_ORDER: second, Method.FIRST_ORDER: first},
        not_judged=dict.fromkeys((Method.PENALTY, Method.LAGGING), SPRUNG),
    )


def _middle(p: Parameters, speed: float, seen: tuple[Observable, ...]) -> Series:
    """The centre of mass of both, whose motion does not depend on what springs return."""

    def observe(run: Run) -> Vector:
        moved = [MASSES[f"m{i + 1}"] * run.values[what] @ NORMAL for i, what in enumerate(seen)]
        return np.asarray(sum(moved) / sum(MASSES.values()))

    judge = Exact(dict.fromkeys(
        (Method.SECOND_ORDER, Method.FIRST_ORDER, Method.PENALTY, Method.LAGGING),
        Tolerance(1e-11, "momentum is conserved, to the rounding of some hundred steps"),
    ))  # fmt: skip
    what = "displacement of the centre of mass of both"
    return Series("middle", "middle", "m", what, observe, lambda t: speed * t, judge)


STEP = 2e-3  # m, over V
KN = 1e9  # N/m, up to 1 m/s
SPRUNG = "springs return a part of the energy of the impact that depends on their damping"
CASE = Case(
    name="spin-stopped",
    title="An impact that stops two spins",
    source=Source(
        "Goldsmith (1960), Impact: the theory and physical behaviour of colliding solids, "
        "Edward Arnold",
        "",
        "Chapter 2, impact of rigid bodies; without friction and restitution, since rigid contact "
        "has none. Any other impulse, point or normal would leave spins and two velocities.",
    ),
    parameters=(
        Parameter("crossing", 70.0, "deg", "angle between the edges"),
        Parameter("a1", 0.3, "m", "distance from the middle of the lower edge to the contact"),
        Parameter("a2", -0.2, "m", "distance from the middle of the upper edge to the contact"),
        Parameter("V", 1.0, "m/s", "speed of the upper prism"),
        Parameter("duration", 0.1, "s", "time simulated"),
    ),
    variants=(
        Variant(
            "crossed", "prisms of 1 m and 0.8 m, whose edges cross at 70 deg",
            "V m2/(m1 + m2) for both, without spin",
            inert=frozenset({"crossing", "a1", "a2"}),
        ),
    ),
    declare=_declare,
)  # fmt: skip
