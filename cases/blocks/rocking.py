"""A block rocks: released from a lean, or shaken by half a sine that overturns it, or nearly."""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass

import numpy as np

from cases._papers import YAGODA_BIRAN_2016
from cases.blocks._leaning import CENTRE, MOVING, Leaning, Y
from reference_solutions.blocks import rocking
from vv.ask import Bracket, History, Knobs, Method, Run, SearchVariable
from vv.case import (
    LARGEST_TOLERANCE,
    Case,
    EnergyAllowance,
    Exact,
    Ladder,
    Level,
    Motion,
    Parameter,
    Parameters,
    Quantity,
    RotationAbout,
    Scalar,
    Series,
    Shown,
    Source,
    Tolerance,
    Trial,
    Variant,
    last_stable_step,
)
from vv.scene import Contact, Harmonic, Pulse, Scene, Vector, Wall

X, _, Z = np.eye(3)
SWEPT = {"search": 1e10, "search-soft": 1e7}  # N/m
PAST = 1.1  # times b: a centre displaced farther sideways is past the top
Law = dict[str, float]


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


def _threshold_trial(p: Parameters, law: Law, w: float) -> Trial:
    """A pulse at the threshold, whose amplitude follows from the energy that it leaves."""
    most = p["part"] * rocking.threshold(**law, w=w)
    ends = History(1.01 * math.pi / w, math.pi / w)
    levels = LEVELS | {Level.QUICK: (*RUNGS[:2], RUNGS[-1])}  # clumps need the finest step
    study = Ladder(_scene(p, most), ends, (CENTRE, MOVING), levels)
    return Trial(study, (_threshold(p, law, w, most),))


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
    drive = {"A": most, "w": w, "T": math.pi / w}
    exact = _Exact(tuple(law.items()), tuple(drive.items()), block.start)
    goal = History(p["duration"], p["duration"] / 50)

    def path(t: Vector) -> Vector:
        return np.asarray(block.place(exact.leans(t)) - block.initial_centre())

    motion = Motion(CENTRE, np.array([X, Z]), path, goal.times(None), "m")
    judge = _free_swings(rate) if released else _near_threshold(w, p["part"])
    quantities = (
        motion.component(0, "x", "displacement of the centre along the floor", judge),
        motion.component(1, "z", "displacement of the centre upwards", judge),
        motion.distance(judge),
        *_phases(block, rate, exact),
    )
    if most and p["duration"] > 0.5:
        quantities += _before_impact(block, exact)
    if released:
        quantities += (_first_swing(block, exact, _released_swing(rate, p["part"])),)
    scene = _scene(p, most, block.start)
    study = Ladder(scene, goal, (CENTRE, MOVING), LEVELS)
    return Trial(study, quantities, _friction_energy(scene, p), phase=("lean", "rate"))


@dataclass(frozen=True)
class _Exact:
    """The exact lean and its rate at times (k,) [s], which differ between settings."""

    law: tuple[tuple[str, float], ...]
    drive: tuple[tuple[str, float], ...]
    start: float

    def leans(self, t: Vector) -> Vector:
        return np.asarray(_phases_at(self, np.asarray(t, float).tobytes())[:, 0])

    def rates(self, t: Vector) -> Vector:
        return np.asarray(_phases_at(self, np.asarray(t, float).tobytes())[:, 1])


@functools.lru_cache(maxsize=16)  # for one setting, four quantities ask for the same times
def _phases_at(exact: _Exact, times: bytes) -> Vector:
    law = dict((*exact.law, *exact.drive))
    return rocking.phases(np.frombuffer(times), **law, theta=exact.start)


def _friction_energy(scene: Scene, p: Parameters) -> EnergyAllowance:
    """The energy that lagging friction may add at impacts, relative to m g R."""
    weight = sum(block.mass for block in scene.blocks) * p["g"]
    return EnergyAllowance(weight * math.hypot(p["b"], p["h"]), {Method.LAGGING: LAGS})


def _phases(block: Leaning, rate: float, exact: _Exact) -> tuple[Quantity, ...]:
    """The lean over alpha and its rate over p alpha, which together make the phase plot."""
    alpha = block.alpha

    def angle(run: Run) -> Vector:
        return block.lean(run)[0] / alpha

    def swift(run: Run) -> Vector:
        return block.lean(run)[1] / (rate * alpha)

    return (
        Series("lean", "theta/alpha", "", "lean of the block over alpha",
               RotationAbout(CENTRE.body, Y, alpha, angle), lambda t: exact.leans(t) / alpha,
               Shown(JUDGED), 1.0),
        Series("rate", "theta'/(p alpha)", "", "rate of the lean over p alpha; plotted over the "
               "lean it gives the phase plot", swift, lambda t: exact.rates(t) / (rate * alpha),
               Shown(JUDGED), 1.0),
    )  # fmt: skip


def _first_swing(block: Leaning, exact: _Exact, judge: Exact) -> Scalar:
    """The largest error of the lean up to the first impact, over alpha; it judges springs too."""

    def largest(run: Run) -> float:
        due = exact.leans(run.times)
        back = np.flatnonzero(due <= 0.0)
        swing = slice(0, int(back[0]) if len(back) else None)
        return float(np.abs(block.lean(run)[0][swing] - due[swing]).max() / block.alpha)

    return Scalar(
        "first swing", "max|e|/alpha", "", "largest error of the lean until the first impact, over "
        "alpha", largest, 0.0, 1.0, judge,
    )  # fmt: skip


def _before_impact(block: Leaning, exact: _Exact) -> tuple[Quantity, ...]:
    """The paper's own measure of the error: of the lean under a pulse, until the block returns."""

    def largest(after: float, run: Run) -> float:
        lean, due = block.lean(run)[0], exact.leans(run.times)
        down = np.flatnonzero((due <= 0.0) & (run.times > after))
        there = (run.times >= after) & (run.times < (run.times[down[0]] if len(down) else np.inf))
        return float(np.abs(100.0 * (lean[there] / due[there] - 1.0)).max())

    return tuple(
        Scalar(f"E_N after {after:g} s", "E_N", "", f"largest E_N [%] after {after:g} s; the paper "
               f"states below {limit:g} %", functools.partial(largest, after), None, 1.0,
               Shown(NEARLY))
        for after, limit in ((0.3, 10.0), (0.5, 1.0))
    )  # fmt: skip


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
    judge = _at_threshold(w)

    def seen(run: Run) -> float:
        return least * last_stable_step(run, bracket)

    return Trial(study, (
        Scalar("threshold", "A", "m/s2", "largest amplitude of a half-sine pulse that does not "
               "overturn the block", seen,
               most, most, judge),
        Scalar("over the linear one", "A/A_1", "", "the same over the threshold of the equation "
               "linearised for small "
               "angles", lambda run: seen(run) / rocking.linear_threshold(**law, w=w), None, 1.0,
               Shown(SMALL)),
    ))  # fmt: skip


def _overturning_trial(p: Parameters, law: Law, w: float) -> Trial:
    """The time that the block takes to overturn."""
    most = p["part"] * rocking.threshold(**law, w=w)
    due = rocking.overturns(**law, A=most, w=w)
    block, rate = Leaning(p["b"], p["h"]), rocking.slenderness(**law)[1]
    last = due + 1.0 / rate  # ends before the block lies flat
    goal = History(last, last / 300)

    def when(run: Run) -> float:
        """The time at which the lean reaches 2 alpha, interpolated between outputs; nan if it does
        not.
        """
        lean, due_lean = block.lean(run)[0], 2 * block.alpha
        if not (lean > due_lean).any():
            return math.nan
        k = int(np.argmax(lean > due_lean))
        part = slice(max(0, k - 3), k + 3)
        from scipy.interpolate import CubicSpline

        return float(CubicSpline(lean[part], run.times[part])(due_lean))

    near = p["part"] - 1.0
    late = Tolerance(
        min(LARGEST_TOLERANCE, 1e-5 + _threshold_error(w) * p["part"] / (near * rate * due)),
        NEARER,
        dt=COARSE,
        order=2,
        floor=1e-5,
    )
    judge = Exact({Method.SECOND_ORDER: late}, not_judged=SHOWN)
    study = Ladder(_scene(p, most), goal, (CENTRE, MOVING), LEVELS)
    return Trial(study, (
        Scalar("time", "t_o", "s", "time to overturn, when the block leans by 2 "
               "alpha", when, due, due,
               judge),
    ))  # fmt: skip


def _free_swings(rate: float) -> Exact:
    """For free swings: their rate p [1/s] is the scale of the step."""
    five = Tolerance(
        min(LARGEST_TOLERANCE, 17.0 * (rate * COARSE) ** 2),
        "the step changes the rate of each swing by (p dt)^2/12 = 1e-6, and by the square root of "
        "that at the turn of a swing that ends upright; the errors of five impacts add "
        "up", dt=COARSE, order=2,
    )  # fmt: skip
    return Exact({Method.SECOND_ORDER: five}, not_judged=SHOWN)


def _released_swing(rate: float, part: float) -> Exact:
    """For the first swing, at the rate p [1/s], of a block released at `part` of alpha.

    The moment that brings the block back is in proportion to alpha - theta. An error of alpha
    therefore counts relative to 1 - part.
    """
    felt = min(50.0, max(1.0, 0.4 / (1.0 - part)))
    bounds = {
        Method.SECOND_ORDER: Tolerance(
            min(LARGEST_TOLERANCE, (rate * COARSE) ** 2), "the step changes the rate p by (p "
            "dt)^2/12",
            dt=COARSE, order=2,
        ),
        Method.PENALTY: Tolerance(
            0.5 * rate * COARSE + 5e-4 * felt, "the motion starts half a step late, an error of p "
            "dt/2. A block on small spheres at its corners turns about these, whose size is a "
            "thousandth of its own: that shifts the angle at the top, and counts relative to 1 - "
            "part, since the nearer the top, the weaker is the moment that brings the block back",
            dt=COARSE, order=1, floor=5e-4 * felt,
        ),
    }  # fmt: skip
    shown = {method: why for method, why in SHOWN.items() if method not in bounds}
    return Exact(bounds, not_judged=shown)


def _near_threshold(w: float, part: float) -> Exact:
    """For a pulse of frequency w [1/s] whose amplitude is `part` times the threshold."""
    left = 0.2 * _threshold_error(w) / max(abs(part - 1.0), 1e-3)
    slow = Tolerance(
        min(LARGEST_TOLERANCE, 2e-4 + left),
        "the step shifts the threshold by (w dt)^2/2, which counts relative to the distance of the "
        "pulse from the threshold",
        dt=COARSE, order=2,
    )  # fmt: skip
    return Exact({Method.SECOND_ORDER: slow}, not_judged=SHOWN)


def _at_threshold(w: float) -> Exact:
    """For the threshold itself, as far as a search resolves it."""
    least = Tolerance(
        min(LARGEST_TOLERANCE, max(FOUND, _threshold_error(w))),
        "an error of (w dt)^2/2: a step averages the sine, and the block starts to lean within a "
        "step", dt=COARSE, order=2, floor=FOUND,
    )  # fmt: skip
    return Exact({Method.SECOND_ORDER: least}, not_judged=SHOWN)


def _threshold_error(w: float) -> float:
    """The relative error of the threshold at the longest step, (w dt)^2/2."""
    return 0.5 * (w * COARSE) ** 2


def _threshold(p: Parameters, law: Law, w: float, most: float) -> Scalar:
    """The amplitude that would just overturn the block, from the energy that the pulse left."""
    step = 1e-5 * most
    rate = rocking.slenderness(**law)[1]
    far = math.hypot(p["b"], p["h"])

    def seen(run: Run) -> float:
        """The amplitude minus the excess of energy over its derivative by the amplitude."""
        x, _, z = run.values[CENTRE][-1] + np.array([-p["b"], 0.0, p["h"]])
        speed = float(np.linalg.norm(run.values[MOVING][-1])) / far
        too_much = speed**2 / 2 + rate**2 * (z / math.hypot(x, z) - 1)
        gain = (
            rocking.excess(most + step, **law, w=w) - rocking.excess(most - step, **law, w=w)
        ) / (2 * step)
        return float(most - (too_much - rocking.excess(most, **law, w=w)) / gain)

    return Scalar("threshold", "A", "m/s2", "amplitude of the half-sine pulse that just overturns "
                  "the block",
                  seen, most, most, _at_threshold(w))  # fmt: skip


COARSE = 1e-3  # s
FOUND = 4e-6  # relative resolution of a search for the threshold
LAGS = Tolerance(
    0.1,
    "when a corner strikes, friction of the previous iteration may act in the direction of slip "
    "and add energy: at most 0.04 m g R was found for eight blocks",
)
# explicit codes are stable at the last
RUNGS = tuple(Knobs(COARSE / part, 1e10) for part in (1, 2, 4, 20))
LEVELS = {Level.QUICK: RUNGS[:2], Level.DEFAULT: RUNGS, Level.PAPER: RUNGS}
SPRUNG = (
    "on springs an impact takes time, and its restitution depends on stiffness and step: it is "
    "like Housner's at 1e10 N/m and 1e-3 s, but the block bounces at 1e-4 s"
)
SHOWN = {
    **dict.fromkeys((Method.PENALTY, Method.LAGGING), SPRUNG),
    Method.FIRST_ORDER: "this class places an impact at the end of a step, and the errors of five "
    "impacts add up",
}
NEARLY = (
    "relative to the lean, the error has no bound when the block starts to lean; so near the "
    "threshold it is the error of the threshold, which grows as exp(p t)"
)
JUDGED = "displacements are judged instead: the rate jumps at every impact"
SMALL = (
    "the threshold of the block itself is judged, 1.0363 times the linear one at the default sizes"
)
NEARER = (
    "the step shifts the threshold by (w dt)^2/2, which counts relative to the excess of the pulse "
    "over the threshold: when that falls by a factor of e, the time to overturn grows by 1/p"
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
