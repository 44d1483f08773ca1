"""A block rocks: released from a lean, or shaken by half a sine that overturns it, or nearly."""

from __future__ import annotations

import math

import numpy as np

from cases._papers import YAGODA_BIRAN_2016
from cases.blocks.parts import _rocking_bounds, _rocking_friction, _rocking_quantities
from cases.blocks.parts._leaning import CENTRE, MOVING, Leaning
from cases.blocks.parts._rocking_bounds import COARSE
from cases.blocks.parts._rocking_quantities import Law
from reference_solutions.blocks import rocking
from vv.ask import Bracket, History, Knobs, Run, SearchVariable
from vv.case import (
    Case,
    Ladder,
    Level,
    Motion,
    Parameter,
    Parameters,
    Scalar,
    Shown,
    Source,
    Trial,
    Variant,
    last_stable_step,
)
from vv.scene import Contact, Harmonic, Pulse, Scene, Vector, Wall

X, _, Z = np.eye(3)
SWEPT = {"search": 1e10, "search-soft": 1e7}  # N/m
AGAIN = 200  # instants of a pulse at which the block is looked at
PAST = 1.1  # times b: a centre displaced farther sideways is past the top


def _scene(p: Parameters, most: float, start: float = 0.0) -> Scene:
    """The block on its floor, leaning by `start` [rad], or under half a sine of `most` [m/s2]."""
    block = Leaning(p["b"], p["h"], start).block()
    pulse = Pulse(Harmonic(most * X, p["f"] * X), 0.5 / p["f"]) if most else None
    return Scene((Wall(np.zeros(3), Z), block), Contact(np.inf, mu=p["mu"]),
                 gravity=-p["g"] * Z, shaking=pulse)  # fmt: skip


def _declare(variant: str, p: Parameters) -> Trial:
    law = {name: p[name] for name in ("b", "h", "g")}
    w = 2 * math.pi * p["f"]
    if not p["mu"] > p["b"] / p["h"]:
        raise ValueError(
            f"mu = {p['mu']!r}; it must exceed b/h, or the block slips instead of leaning"
        )
    if variant in SWEPT:
        return _search_trial(p, law, w, SWEPT[variant])
    if variant.startswith("overturns"):
        return _overturning_trial(p, law, w)
    if variant == "threshold":
        return _threshold_trial(p, law, w)
    return _rocking_trial(variant, p, law, w)


def _exact(law: Law, w: float, most: float, start: float) -> _rocking_quantities.ExactMotion:
    """The motion after a lean of `start` [rad], or under half a sine of `most` [m/s2]."""
    drive = {"A": most, "w": w, "T": math.pi / w}
    return _rocking_quantities.ExactMotion(tuple(law.items()), tuple(drive.items()), start)


def _threshold_trial(p: Parameters, law: Law, w: float) -> Trial:
    """A pulse at the threshold, whose amplitude follows from the energy that it leaves."""
    most = p["part"] * rocking.threshold(**law, w=w)
    ends = History(1.01 * math.pi / w, math.pi / w)
    block, exact = Leaning(p["b"], p["h"]), _exact(law, w, most, 0.0)
    held = p["g"] * p["b"] / p["h"]
    leans = exact.leans(np.linspace(0.0, math.pi / w, AGAIN))
    if not leans[np.argmax(leans > 0.0) :].min() > 0.0:
        raise ValueError(
            f"part = {p['part']!r}: a pulse of {most:.4g} m/s2, which must exceed g b/h = "
            f"{held:.4g} m/s2 by so much that the block still leans when it ends"
        )
    _rocking_friction.require_grip(block, exact, p, math.pi / w)
    levels = LEVELS | {Level.QUICK: (*RUNGS[:2], RUNGS[-1])}  # clumps need the finest step
    study = Ladder(_scene(p, most), ends, (CENTRE, MOVING), levels)
    return Trial(study, (_rocking_quantities.threshold(p, law, w, most),))


def _rocking_trial(variant: str, p: Parameters, law: Law, w: float) -> Trial:
    """The motion of the block, released or shaken by the pulse."""
    released = variant == "released"
    most = 0.0 if released else p["part"] * rocking.threshold(**law, w=w)
    over = rocking.overturns(**law, A=most, w=w) if most and p["part"] > 1.0 else math.inf
    if not p["duration"] < over:
        raise ValueError(
            f"duration = {p['duration']!r} s; it must end before the block overturns and slips, "
            f"at {over:.3g} s"
        )
    alpha, rate = rocking.slenderness(**law)
    block = Leaning(p["b"], p["h"], p["part"] * alpha if released else 0.0)
    exact = _exact(law, w, most, block.start)
    _rocking_friction.require_grip(block, exact, p, p["duration"])
    goal = History(p["duration"], p["duration"] / 50)

    def path(t: Vector) -> Vector:
        return np.asarray(block.place(exact.leans(t)) - block.initial_centre())

    motion = Motion(CENTRE, np.array([X, Z]), path, goal.times(None), "m")
    judge = (
        _rocking_bounds.free_swings(rate)
        if released
        else _rocking_bounds.near_threshold(w, p["part"])
    )
    quantities = (
        motion.component(0, "x", "displacement of the centre along the floor", judge),
        motion.component(1, "z", "displacement of the centre upwards", judge),
        motion.distance(judge),
        *_rocking_quantities.phases(block, rate, exact),
    )
    if most and p["duration"] > 0.5:
        quantities += _rocking_quantities.before_impact(block, exact)
    if released:
        bounds = _rocking_bounds.released_swing(rate, p["part"])
        quantities += (_rocking_quantities.first_swing(block, exact, bounds),)
    scene = _scene(p, most, block.start)
    study = Ladder(scene, goal, (CENTRE, MOVING), LEVELS)
    energy = _rocking_bounds.friction_energy(scene, p)
    return Trial(study, quantities, energy, phase=("lean", "rate"))


def _search_trial(p: Parameters, law: Law, w: float, kn: float) -> Trial:
    """Searches the amplitude that overturns the block, starting from the one that just lifts it."""
    least, rate = p["g"] * p["b"] / p["h"], rocking.slenderness(**law)[1]
    most, span = rocking.threshold(**law, w=w), 3.0 * (1.0 + w / rate)
    bracket = Bracket(span, PAST * p["b"], tries=4, rounds=9, variable=SearchVariable.SHAKING)
    last = math.pi / w + 14.0 / rate
    rungs = (Knobs(COARSE, kn), Knobs(COARSE / 2, kn))
    levels = {Level.QUICK: rungs[:1], Level.DEFAULT: rungs[:1], Level.PAPER: rungs}
    goal = History(last, last / 50)
    study = Ladder(_scene(p, least), goal, (CENTRE,), levels, search=bracket)

    def seen(run: Run) -> float:
        return least * last_stable_step(run, bracket)

    def relative(run: Run) -> float:
        return seen(run) / rocking.linear_threshold(**law, w=w)

    survived = "largest amplitude of a half-sine pulse that does not overturn the block"
    linear = "the same over the threshold of the equation linearised for small angles"
    judge = _rocking_bounds.at_threshold(w)
    return Trial(study, (
        Scalar("threshold", "A", "m/s2", survived, seen, most, most, judge),
        Scalar("over the linear one", "A/A_1", "", linear, relative, None, 1.0, Shown(SMALL)),
    ))  # fmt: skip


def _overturning_trial(p: Parameters, law: Law, w: float) -> Trial:
    """The time that the block takes to overturn."""
    most = p["part"] * rocking.threshold(**law, w=w)
    due = rocking.overturns(**law, A=most, w=w)
    block, rate = Leaning(p["b"], p["h"]), rocking.slenderness(**law)[1]
    last = due + 1.0 / rate  # ends before the block lies flat
    _rocking_friction.require_grip(block, _exact(law, w, most, 0.0), p, due)
    goal = History(last, last / 300)

    judge = _rocking_bounds.overturning_time(w, p["part"], rate, due)
    study = Ladder(_scene(p, most), goal, (CENTRE, MOVING), LEVELS)
    return Trial(study, (_rocking_quantities.overturning_time(block, due, judge),))


# explicit codes are stable at the last, by which they are judged; with the first two it shows the
# order of the others
RUNGS = tuple(Knobs(COARSE / part, 1e10) for part in (1, 2, 4, 20))
LEVELS = {Level.QUICK: RUNGS[:2], Level.DEFAULT: (*RUNGS[:2], RUNGS[-1]), Level.PAPER: RUNGS}
SMALL = (
    "the threshold of the block itself is judged, 1.0363 times the linear one at the default sizes"
)
CASE = Case(
    name="rocking",
    title="A rocking block",
    source=Source(
        *YAGODA_BIRAN_2016,
        "Figs. 9-11, after Makris and Roussos (2000), Geotechnique 50(3), 243-262. The paper "
        "brackets the threshold between 5.43 and 5.44 m/s2, which is right for the equation "
        "linearised for small angles and g = 9.80 or 9.80665 m/s2: 5.43639 and 5.43911 m/s2. The "
        "block itself overturns from 5.63805 m/s2 on, at g = 9.81 m/s2. A half sine that ends at "
        "0.5 s leaves no choice of phase: it starts at zero, and the block stands until a = g b/h. "
        "Friction is chosen so that the block does not slip; depth and density do not matter.",
    ),
    parameters=(
        Parameter("b", 0.2, "m", "half the width"),
        Parameter("h", 0.6, "m", "half the height"),
        Parameter("part", 0.6, "", "initial lean over alpha, or amplitude over the threshold"),
        Parameter("f", 1.0, "Hz", "frequency of the sine, of which half a period acts"),
        Parameter("mu", 0.6, "", "friction coefficient"),
        Parameter("g", 9.81, "m/s2", "gravity"),
        Parameter("duration", 1.5, "s", "time simulated"),
    ),
    variants=(
        Variant("released", "released from a lean of 0.6 alpha, followed through three impacts",
                "theta'' = -p^2 sin(alpha - theta), p^2 = 3 g/4R; each impact multiplies theta' by "
                "1 - 1.5 sin^2 alpha", inert=frozenset({"mu", "f"})),
        Variant("stands", "half a sine with an amplitude 1e-3 below the threshold: the block leans "
                "and returns", SHAKEN := (
                "theta'' = p^2 (-sin(alpha - theta) + a/g cos(alpha - theta)), a = A sin wt to "
                "t = pi/w"), {"part": 0.999}, frozenset({"mu"}), Level.DEFAULT),
        Variant("topples", "half a sine with an amplitude 1e-3 above the threshold: the block "
                "overturns", SHAKEN, {"part": 1.001},
                frozenset({"mu"}), Level.DEFAULT),
        Variant("threshold", "the amplitude that just overturns the block",
                "theta'^2/2 + p^2 cos(alpha - theta) = p^2 at the end of the pulse",
                {"part": 1.0}, frozenset({"mu", "duration"}), unseen={
                    "f": "at any frequency, a pulse at its own threshold leaves the same energy"}),
        *(
            Variant(f"overturns-{name}", f"time to overturn under half a sine, {name} above the "
                    "threshold", SHAKEN + "; two decades nearer to the threshold it takes "
                    "ln(100)/p longer",
                    {"part": 1.0 + near}, frozenset({"mu", "duration"}), Level.DEFAULT)
            for name, near in (("1e-1", 1e-1), ("1e-2", 1e-2), ("1e-4", 1e-4))
        ),
        *(
            Variant(name, "the largest amplitude that does not overturn the block, searched "
                    f"with {what}", SHAKEN, {},
                    frozenset({"mu", "duration", "part"}), level)
            for name, what, level in (
                ("search", "stiff contacts", Level.DEFAULT),
                ("search-soft", "contact springs of 1e7 N/m, in codes that have "
                                "them", Level.PAPER),
            )
        ),
    ),
    declare=_declare,
)  # fmt: skip
