"""A block rocks: let go leaning, and shaken by half a sine just below and beyond overturning."""

from __future__ import annotations

import functools
import math

import numpy as np

from cases._papers import YAGODA_BIRAN_2016
from reference_solutions.blocks import rocking
from vv.ask import Displacement, History, Knobs, Method, Run, Velocity
from vv.case import (
    Case,
    Exact,
    Ladder,
    Level,
    Motion,
    Parameter,
    Parameters,
    Scalar,
    Source,
    Tolerance,
    Trial,
    Variant,
)
from vv.scene import Block, Contact, Harmonic, Pulse, Scene, Vector, Wall, polyhedron_inertia

CENTRE, MOVING = Displacement(1), Velocity(1)
DEEP, DENSITY = 0.3, 2500.0  # m, half the depth; kg/m3
OUTLINE = ((0, 1, 2, 3), (7, 6, 5, 4), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0))
X, Y, Z = np.eye(3)
OVERTURNS = ("stands", "topples", "threshold")


def _place(lean: Vector, p: Parameters) -> Vector:
    """Where the centre is, (k, 2) along the floor and above it [m], at leans (k,) [rad]."""
    alpha, far = math.atan2(p["b"], p["h"]), math.hypot(p["b"], p["h"])
    side, rest = np.where(lean < 0, -1.0, 1.0), alpha - np.abs(lean)
    return np.stack([side * (p["b"] - far * np.sin(rest)), far * np.cos(rest)], axis=1)


def _block(p: Parameters, lean: float) -> Block:
    """A prism that leans by so much [rad] about its corner at x = b."""
    b, h = p["b"], p["h"]
    upright = np.array([[-2 * b, 0.0], [0.0, 0.0], [0.0, 2 * h], [-2 * b, 2 * h]])
    c, s = math.cos(lean), math.sin(lean)
    flat = np.insert(upright @ np.array([[c, -s], [s, c]]) + [b, 0.0], 1, 0.0, axis=1)
    vertices = np.concatenate([flat - DEEP * Y, flat + DEEP * Y])
    mass, inertia = polyhedron_inertia(vertices, OUTLINE, DENSITY)
    return Block("block", vertices, OUTLINE, mass, inertia, np.zeros(3), free=Y == 0,
                 free_spin=Y != 0)  # fmt: skip


def _declare(variant: str, p: Parameters) -> Trial:
    law = {name: p[name] for name in ("b", "h", "g")}
    alpha, _ = rocking.slenderness(**law)
    shaken, w = variant in OVERTURNS, 2 * math.pi * p["f"]
    most = p["part"] * rocking.threshold(**law, w=w) if shaken else 0.0
    start = 0.0 if shaken else p["part"] * alpha
    drive = {"A": most, "w": w, "T": math.pi / w}
    pulse = Pulse(Harmonic(most * X, p["f"] * X), math.pi / w) if shaken else None
    scene = Scene((Wall(np.zeros(3), Z), _block(p, start)), Contact(np.inf, mu=p["mu"]),
                  gravity=-p["g"] * Z, shaking=pulse)  # fmt: skip
    if variant == "threshold":
        ends = History(1.01 * math.pi / w, math.pi / w)
        study = Ladder(scene, ends, (CENTRE, MOVING), LEVELS)
        return Trial(study, (_threshold(p, law, w, most),))
    goal = History(p["duration"], p["duration"] / 50)

    @functools.cache
    def leans() -> Vector:
        return rocking.leans(goal.times(None), **law, **drive, theta=start)

    def path(t: Vector) -> Vector:
        seen = rocking.leans(t, **law, **drive, theta=start) if len(t) != len(leans()) else leans()
        return np.asarray(_place(seen, p) - _place(np.array([start]), p))

    motion = Motion(CENTRE, np.array([X, Z]), path, goal.times(None), "m")
    judge = Exact(FREE if variant == "released" else NEAR, not_judged=SHOWN)
    parts = (
        motion.component(0, "x", "displacement of the centre along the floor", judge),
        motion.component(1, "z", "displacement of the centre upwards", judge),
    )
    return Trial(Ladder(scene, goal, (CENTRE,), LEVELS), (*parts, motion.distance(judge)))


def _threshold(p: Parameters, law: dict[str, float], w: float, most: float) -> Scalar:
    """The amplitude that would just overturn the block, by what the pulse left of its energy."""
    step = 1e-5 * most
    rate = rocking.slenderness(**law)[1]
    far = math.hypot(p["b"], p["h"])

    def seen(run: Run) -> float:
        """The amplitude less what the energy is too much, over what an amplitude gives of it."""
        x, _, z = run.values[CENTRE][-1] + np.array([-p["b"], 0.0, p["h"]])
        speed = float(np.linalg.norm(run.values[MOVING][-1])) / far
        too_much = speed**2 / 2 + rate**2 * (z / math.hypot(x, z) - 1)
        gain = (
            rocking.excess(most + step, **law, w=w) - rocking.excess(most - step, **law, w=w)
        ) / (2 * step)
        return float(most - (too_much - rocking.excess(most, **law, w=w)) / gain)

    return Scalar("threshold", "A", "m/s2", "amplitude of half a sine that overturns the block",
                  seen, most, most, Exact(LEAST, not_judged=SHOWN))  # fmt: skip


RUNGS = tuple(Knobs(dt, 1e10) for dt in (1e-3, 5e-4, 2.5e-4))
LEVELS = {Level.QUICK: RUNGS[:2], Level.DEFAULT: RUNGS, Level.PAPER: RUNGS}
SPRUNG = (
    "springs lengthen every impact and give back what they please, by stiffness and step: like "
    "Housner's at 1e10 N/m and 1e-3 s, bouncing at 1e-4 s"
)
SHOWN = dict.fromkeys((Method.PENALTY, Method.LAGGING), SPRUNG)
FREE = {
    Method.SECOND_ORDER: Tolerance(
        2e-4, "(p dt)^2/12 = 1e-6 of the rate a swing, and its square root at the turn of a swing "
        "that ends upright: five impacts add up", dt=1e-3, order=2,
    )
}  # fmt: skip
NEAR = {
    Method.SECOND_ORDER: Tolerance(
        4e-3, "(p dt)^2/12 = 1e-6 of the energy, over the thousandth part that is left at the top",
        dt=1e-3, order=2,
    )
}  # fmt: skip
LEAST = {
    Method.SECOND_ORDER: Tolerance(
        2e-5,
        "(w dt)^2/2, as the sine is taken by its mean over a step and the block begins to lean "
        "within one",
        dt=1e-3,
        order=2,
    )
}
CASE = Case(
    name="rocking",
    title="A rocking block",
    source=Source(
        *YAGODA_BIRAN_2016,
        "Figs. 9-11, after Makris and Roussos (2000), Geotechnique 50(3), 243-262. The bracket "
        "5.43 to 5.44 m/s2 that it gives belongs to the equation for small angles and a g of 9.80 "
        "or 9.80665: 5.43639 and 5.43911. The block itself overturns from 5.63805 on at 9.81. A "
        "pulse that ends at 0.5 s cannot start with a phase: it starts at none, since the block "
        "stands until a = g b/h. Friction is chosen so that it does not slip, depth and density "
        "do not matter.",
    ),
    parameters=(
        Parameter("b", 0.2, "m", "half the width"),
        Parameter("h", 0.6, "m", "half the height"),
        Parameter("part", 0.6, "", "lean at the start over alpha, or amplitude over the threshold"),
        Parameter("f", 1.0, "Hz", "frequency of the sine, of which half a period acts"),
        Parameter("mu", 0.6, "", "friction coefficient"),
        Parameter("g", 9.81, "m/s2", "gravity"),
        Parameter("duration", 1.5, "s", "time simulated"),
    ),
    variants=(
        Variant("released", "let go at 0.6 alpha, through three impacts",
                "theta'' = -p^2 sin(alpha - theta), p^2 = 3 g/4R; rate times 1 - 1.5 sin^2 alpha "
                "at impacts", inert=frozenset({"mu", "f"})),
        Variant("stands", "half a sine, 1e-3 below the threshold, and back", SHAKEN := (
                "theta'' = p^2 (-sin(alpha - theta) + a/g cos(alpha - theta)), a = A sin wt to "
                "t = pi/w"), {"part": 0.999}, frozenset({"mu"}), Level.DEFAULT),
        Variant("topples", "half a sine, 1e-3 beyond the threshold", SHAKEN, {"part": 1.001},
                frozenset({"mu"}), Level.DEFAULT),
        Variant("threshold", "the amplitude that just overturns it",
                "theta'^2/2 + p^2 cos(alpha - theta) = p^2 as the pulse ends",
                {"part": 1.0}, frozenset({"mu", "duration"}), unseen={
                    "f": "a pulse at the threshold of its own frequency leaves no more energy"}),
    ),
    declare=_declare,
)  # fmt: skip
