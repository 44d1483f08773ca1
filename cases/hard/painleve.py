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
LOW = 0.05  # of the half length: where its side is still above the floor
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


def _load(p: Parameters, turned: float = 0.0) -> float:
    """The normal force over the weight of a rod that slides, has turned [rad], and has no spin."""
    theta = math.atan(p["slope"]) + turned
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
    kn, rubs = SPRING * p["m"], p["mu"] * load * p["g"] * GOAL.duration / way
    sinks = 2 * load**2 * p["g"] / (SPRING * way) * math.hypot(1.0, p["mu"]) * _grown(p)
    changes = abs(_load(p, spin * GOAL.duration / 2) - load) * p["g"] + load * p["half"] * spin**2
    damped = GOAL.duration / (2 * way) * changes * math.hypot(1.0, p["mu"])
    magnified = load * (1 + 3 * math.cos(math.atan(p["slope"])) ** 2)
    sprung = Tolerance(
        sinks,
        "the end sinks into its spring by N/kn and oscillates on it by as much again. The middle "
        "moves N/(m g) times as far down, near the paradox a large number, and mu times that "
        "sideways, and the rod then rotates faster. Forces are those of the end of a step, dt/2 "
        "early: the speed is wrong by dt/2 times what the acceleration changes by as the rod turns",
        kn=kn, softness=1, late=damped,
    )  # fmt: skip
    lagging = Tolerance(
        sinks,
        "friction is that of the previous iteration: none at first, and then a part q of what it "
        "lacked, since q of the normal force is due to friction. So the speed is wrong by what "
        "friction takes in 1/(1 - q) steps, and in six tenths as many while the end oscillates",
        kn=kn, softness=1, late=1.6 * magnified * rubs + damped,
    )  # fmt: skip
    springs = {Method.PENALTY: sprung, Method.LAGGING: lagging}
    rigid = {Method.SECOND_ORDER: straight, Method.STRAIGHT: straight}
    return Exact({Method.FIRST_ORDER: AT_ENDS, **rigid, **springs})


def _grown(p: Parameters) -> float:
    """By which factor an error of the slope has grown: cosh(T sqrt(r)), r = d theta''/d theta."""
    theta = math.atan(p["slope"])
    s, c = math.sin(theta), math.cos(theta)
    b, more = p["mu"] * s - c, p["mu"] * c + s  # theta'' = g b/(l (1/3 - c b)), and db/dtheta
    below = 1 / 3 - c * b
    rate = (more * below + b * (c * more - s * b)) / below**2 * p["g"] / p["half"]
    return math.cosh(GOAL.duration * math.sqrt(max(rate, 0.0)))


def _jams(p: Parameters, path: Callable[[Vector], Vector]) -> Exact:
    """The bounds of a rod that jams, and then rotates about its end as a pendulum."""
    theta, half = math.atan(p["slope"]), p["half"]
    way = float(np.linalg.norm(path(GOAL.times(None)), axis=1).max())
    spin, falls = _spin(p), 0.75 * p["g"] / half  # of the start [1/s], and the most it changes by
    arc = half * (spin + falls * GOAL.duration / 2) * GOAL.duration / way
    bent = falls / 6 + (spin + falls * GOAL.duration) ** 2 / 24
    located = Tolerance(
        max(arc * bent * STEP**2, ROUNDING),
        "the jam is located within the step and takes no time. Then the moment of the weight is "
        "constant in a step: it changes by a part k = 3 g/(4 l) of the arc of the middle, and the "
        "error is dt^2/12 times that, twice of which is allowed; and arcs are chords, (w dt)^2/24 "
        "shorter",
        dt=STEP, order=2, floor=ROUNDING,
    )  # fmt: skip
    late = p["V"] / 4 + half * falls * math.cos(theta) * GOAL.duration / 2
    jammed = Tolerance(
        located.value,
        "the impulse at the start acts at the end of the first step: an error of V dt/2 at the end "
        "of the rod and of half that in its middle, and a step without the moment of the weight",
        dt=STEP, order=2, late=late / way,
        slack="an impulse at the start of its step costs only the turn of that step",
    )  # fmt: skip
    return Exact({Method.SECOND_ORDER: located, Method.FIRST_ORDER: jammed}, not_judged=SHOWN)


def _spin(p: Parameters) -> float:
    """The rate at which a rod that jams rotates at first [1/s]: 3 V sin(theta)/(4 l)."""
    return 0.75 * p["V"] * math.sin(math.atan(p["slope"])) / p["half"]


def _impact(p: Parameters) -> Tolerance:
    """Of the energy of the impulse."""
    return Tolerance(
        max((_spin(p) * STEP) ** 2 / 8, ROUNDING),
        "the rod turns by w dt in the step in which it jams. The impulse is that of the end of the "
        "step, which takes too little energy by a fraction of (w dt)^2/8",
        dt=STEP, order=2, floor=ROUNDING,
    )  # fmt: skip


def _declare(variant: str, p: Parameters) -> Trial:
    law = {name: p[name] for name in LAW}

    def path(t: Vector) -> Vector:
        return painleve_rod.middle(t, **law)

    low = float(path(GOAL.times(None))[:, 1].min()) + p["half"] * math.sin(math.atan(p["slope"]))
    if low < LOW * p["half"]:
        raise ValueError(
            f"half = {p['half']!r} m; the middle of the rod falls to {low:.6g} m, it must stay "
            f"above {LOW} of half, or the rod lies down"
        )
    motion = Motion(ROD, ALONG, path, GOAL.times(None), "m")
    jams = p["mu"] >= painleve_rod.critical(p["slope"])
    judge = _jams(p, path) if jams else _judge(variant, p, path)
    parts = (
        motion.component(0, "x", "displacement of the middle along the floor", judge),
        motion.component(1, "z", "displacement of the middle upwards", judge),
    )
    energy = (
        EnergyAllowance(p["m"] * p["V"] ** 2 / 2, {Method.SECOND_ORDER: _impact(p)})
        if jams
        else None
    )
    study = Ladder(_scene(p), GOAL, (ROD,), _levels(p["m"]))
    return Trial(study, (*parts, motion.distance(judge)), energy)


STEP, ROUNDING = 1e-3, 1e-11  # s; of some forty steps
SPRING = 1e6  # 1/s2, over the mass: then the oscillation of the end on a spring is as fast


def _levels(mass: float) -> dict[Level, tuple[Knobs, ...]]:
    """Steps, on springs that are as stiff for the mass [kg] as those of the usual one."""
    soft, stiff = SPRING * mass, 100 * SPRING * mass
    rungs = tuple(Knobs(dt, soft) for dt in (STEP, STEP / 2, STEP / 4))
    return {
        Level.QUICK: rungs[:2],
        Level.DEFAULT: rungs,
        Level.PAPER: (*rungs, Knobs(1e-4, stiff), Knobs(5e-5, stiff)),
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
STOPPING = Tolerance(
    2e-4,
    "near the paradox the force changes by a tenth in a step, and the rod stops within a step",
    dt=1e-3,
    order=1,
)
AT_ENDS = Tolerance(
    1e-3,
    "friction acts with its value at the end of a step: an error of its change in a step, 2e-3 of "
    "the speed at 1e-3 s, and half of that in the displacement; a stop takes effect at the end of "
    "a step",
    dt=1e-3,
    order=1,
)
STOPS = Exact({Method.SECOND_ORDER: STOPPING, Method.FIRST_ORDER: AT_ENDS}, not_judged=SHOWN)
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
