"""A rod slides on its end against much friction: Painleve's paradox, below and beyond its limit."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from reference_solutions.hard import painleve_rod
from vv.ask import Displacement, History, Knobs, Method
from vv.case import (
    Case,
    EnergyAllowance,
    Exact,
    Ladder,
    Level,
    Motion,
    Parameter,
    Parameters,
    Shown,
    Source,
    Tolerance,
    Trial,
    Variant,
)
from vv.scene import Block, Contact, Scene, Vector, Wall

ROD = Displacement(1)
FAT, DEEP = 0.02, 0.05  # of the half length: half width of the rod and its half depth
ALONG = np.eye(3)[[0, 2]]
OUTLINE = ((0, 1, 2, 3), (7, 6, 5, 4), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0))
GOAL = History(0.04, 0.002)
LAW = ("mu", "slope", "half", "V", "g")


def _scene(p: Parameters) -> Scene:
    """A rhombus as long as the rod, which has the rod's inertia and stands on one corner."""
    theta, half = math.atan(p["slope"]), p["half"]
    along = np.array([math.cos(theta), 0.0, math.sin(theta)])
    across = np.array([-along[2], 0.0, along[0]])
    corners = half * np.array([-along, -FAT * across, along, FAT * across]) + half * along
    depth = DEEP * half * np.array([0.0, 1.0, 0.0])
    rod = Block(
        "rod", np.concatenate([corners - depth, corners + depth]), OUTLINE,
        p["m"], p["m"] * half**2 / 3 * np.eye(3),
        velocity=np.array([-p["V"], 0.0, 0.0]),
        free=np.array([True, False, True]),
        free_spin=np.array([False, True, False]),
    )  # fmt: skip
    up = np.array([0.0, 0.0, 1.0])
    return Scene((Wall(np.zeros(3), up), rod), Contact(np.inf, mu=p["mu"]), gravity=-p["g"] * up)


def _judge(variant: str, p: Parameters, path: Callable[[Vector], Vector]) -> Exact | Shown:
    """Of a rod that slides: bounds of one that stops, or nearly jams, are those of the case's."""
    theta, load = math.atan(p["slope"]), _load(p)
    rub = p["mu"] * math.sin(theta) - math.cos(theta)
    turn = p["g"] * rub / (p["half"] * (1 / 3 - math.cos(theta) * rub))
    slows = p["mu"] * load * p["g"] + p["half"] * math.sin(theta) * turn
    near = p["mu"] > NEARLY * painleve_rod.critical(p["slope"])
    if near or slows * LASTS * GOAL.duration > p["V"]:
        return STOPS if p == CASE.defaults(variant) else Shown(ELSEWHERE)
    way = float(np.linalg.norm(path(GOAL.times(None)), axis=1).max())
    return _slides(p, load, turn * GOAL.duration, way)


def _load(p: Parameters) -> float:
    """The normal force over the weight of a rod that slides and does not rotate yet."""
    theta = math.atan(p["slope"])
    s, c = math.sin(theta), math.cos(theta)
    return 1 / (1 + 3 * c**2 - 3 * p["mu"] * s * c)


def _slides(p: Parameters, load: float, spin: float, way: float) -> Exact:
    """The bounds of a rod that slides to the end, at any parameters.

    load: the normal force over the weight; spin: the rod's at the end [1/s]; way: the displacement
    of its middle [m].
    """
    straight = Tolerance(
        max(float(2 * p["half"] * (spin * STEP) ** 2 / way), ROUNDING),
        "the rod rotates by up to w dt in a step, in which its end moves along a line: an error of "
        "l (w dt)^2; twice that is allowed",
        dt=STEP, order=2, floor=ROUNDING,
    )  # fmt: skip
    kn, rubs = 1e8, load**2 * p["mu"] * p["g"] * GOAL.duration / way
    sinks = load**2 * p["m"] * p["g"] / (kn * way)
    sprung = Tolerance(
        3 * sinks,
        "the end sinks into its spring by N/kn and oscillates on it by as much again, which its "
        "friction magnifies by N/(m g), near the paradox a large number; the step damps this "
        "oscillation, and takes a fiftieth of the speed that friction takes in a step",
        kn=kn, softness=1, late=0.02 * rubs,
    )  # fmt: skip
    lagging = Tolerance(
        3 * sinks,
        "friction is that of the previous iteration, while the end oscillates: its speed is wrong "
        "by what friction takes in a step, N/(m g) times magnified, for up to two and a half steps",
        kn=kn, softness=1, late=2.5 * rubs,
    )  # fmt: skip
    springs = {Method.PENALTY: sprung, Method.LAGGING: lagging}
    return Exact({**SLIDING_RIGID, Method.STRAIGHT: straight, **springs})


def _declare(variant: str, p: Parameters) -> Trial:
    law = {name: p[name] for name in LAW}

    def path(t: Vector) -> Vector:
        return painleve_rod.middle(t, **law)

    motion = Motion(ROD, ALONG, path, GOAL.times(None), "m")
    jams = p["mu"] >= painleve_rod.critical(p["slope"])
    judge = JAMS if jams else _judge(variant, p, path)
    parts = (
        motion.component(0, "x", "displacement of the middle along the floor", judge),
        motion.component(1, "z", "displacement of the middle upwards", judge),
    )
    energy = (
        EnergyAllowance(p["m"] * p["V"] ** 2 / 2, {Method.SECOND_ORDER: IMPACT}) if jams else None
    )
    study = Ladder(_scene(p), GOAL, (ROD,), LEVELS)
    return Trial(study, (*parts, motion.distance(judge)), energy)


STEP, ROUNDING = 1e-3, 1e-11  # s; of some forty steps
RUNGS = (Knobs(1e-3, 1e8), Knobs(5e-4, 1e8), Knobs(2.5e-4, 1e8))
LEVELS = {
    Level.QUICK: RUNGS[:2],
    Level.DEFAULT: RUNGS,
    Level.PAPER: (*RUNGS, Knobs(1e-4, 1e10), Knobs(5e-5, 1e10)),
}
CRITICAL = 4 / 3  # friction at which a rod of slope 2 jams
NEARLY, LASTS = 0.75, 1.25  # of the friction that jams; of the run, with more time to be sure
ELSEWHERE = (
    "a rod that nearly jams, or stops: how far friction magnifies an error is known at the case's "
    "own parameters only"
)
SPRUNG = (
    "on springs the end of the rod sinks and rebounds, the more so near the paradox and beyond it; "
    "this motion does not converge to that of rigid contact"
)
SHOWN = dict.fromkeys((Method.PENALTY, Method.LAGGING), SPRUNG)
SLIDING = Tolerance(
    8e-6,
    "the force that rotates the rod is constant in a step. It changes by dt V/l per step, 2e-3 at "
    "1e-3 s, and the error is the square of that",
    dt=1e-3,
    order=2,
)
STOPPING = Tolerance(
    2e-4,
    "near the paradox the force changes by a tenth in a step, and the rod stops within a step",
    dt=1e-3,
    order=1,
)
JAMMED = Tolerance(
    1.1e-2,
    "the impulse at the start acts at the end of the first step: an error of V dt/2 = 1e-3 m at "
    "the end of the rod and of half that in its middle, over a displacement of 0.05 m",
    dt=1e-3,
    order=1,
    slack="an impulse at the start of its step costs only the turn of that step",
)
LOCATED = Tolerance(
    4e-6,
    "the jam is located within the step and takes no time. Then the force that rotates the rod is "
    "constant in a step, an error of the square of its change",
    dt=1e-3,
    order=2,
)
IMPACT = Tolerance(
    2e-7,
    "the rod turns by 1.3e-3 rad in the step in which it jams. The impulse is that of the end of "
    "the step, which takes too little energy by a fraction of (w dt)^2",
    dt=1e-3,
    order=2,
)
AT_ENDS = Tolerance(
    1e-3,
    "friction acts with its value at the end of a step: an error of its change in a step, 2e-3 of "
    "the speed at 1e-3 s, and half of that in the displacement; a stop takes effect at the end of "
    "a step",
    dt=1e-3,
    order=1,
)
SLIDING_RIGID = {Method.SECOND_ORDER: SLIDING, Method.FIRST_ORDER: AT_ENDS}
STOPS = Exact({**SLIDING_RIGID, Method.SECOND_ORDER: STOPPING}, not_judged=SHOWN)
JAMS = Exact(
    {Method.SECOND_ORDER: LOCATED, Method.FIRST_ORDER: JAMMED},
    not_judged=SHOWN,
)
SHORT = {"half": "in 0.04 s the rod rotates too little for its length to matter"}
JAMMING = {"mu": "with any friction beyond the limit of the paradox the rod jams in the same way"}
CASE = Case(
    name="painleve",
    title="Painleve's paradox",
    source=Source(
        "Genot and Brogliato (1999), New results on Painleve paradoxes, European Journal of "
        "Mechanics A/Solids 18(4), 653-677",
        "10.1016/S0997-7538(99)00144-8",
        "tan(theta) = 2, V and l are chosen. Beyond mu = 4/3 no finite force keeps the end on the "
        "floor; an impulse stops it, and the rod goes on turning about it. A code whose unknowns "
        "are forces has no solution there; one whose unknowns are impulses has this one.",
    ),
    parameters=(
        Parameter("mu", 1.0, "", "friction coefficient"),
        Parameter("slope", 2.0, "", "tan(theta), the rod's slope at the start"),
        Parameter("half", 1.0, "m", "half the rod's length"),
        Parameter("V", 2.0, "m/s", "initial speed"),
        Parameter("g", 9.81, "m/s2", "gravity"),
        Parameter("m", 100.0, "kg", "mass"),
    ),
    variants=tuple(
        Variant(
            f"mu-{mu:g}", f"mu = {mu:g}, {where}",
            "N = m g/(1 + 3 cos^2 - 3 mu sin cos) while it slides without turning, theta its slope",
            {"mu": mu}, frozenset({"m"}), level, SHORT if mu < CRITICAL else JAMMING,
        )
        for mu, where, level in (
            (0.8, "slides", Level.QUICK),
            (1.3, "slides and soon stops, under a normal force of 25 times its "
             "weight", Level.DEFAULT),
            (1.34, "just beyond the limit of the paradox: it jams", Level.DEFAULT),
            (2.0, "far beyond the limit of the paradox: it jams", Level.QUICK),
        )
    ),
    declare=_declare,
)  # fmt: skip
