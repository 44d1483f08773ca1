"""A block rocks: let go leaning, and shaken by half a sine until it overturns, or nearly."""

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
PAST = 1.1  # of b: a centre that went so far sideways is beyond the top
Law = dict[str, float]


def _scene(p: Parameters, most: float, start: float = 0.0) -> Scene:
    """The block on its floor, leaning at `start` [rad], or under half a sine of `most` [m/s2]."""
    block = Leaning(p["b"], p["h"], start).block()
    pulse = Pulse(Harmonic(most * X, p["f"] * X), 0.5 / p["f"]) if most else None
    return Scene((Wall(np.zeros(3), Z), block), Contact(np.inf, mu=p["mu"]),
                 gravity=-p["g"] * Z, shaking=pulse)  # fmt: skip


def _declare(variant: str, p: Parameters) -> Trial:
    law = {name: p[name] for name in ("b", "h", "g")}
    w = 2 * math.pi * p["f"]
    if not p["mu"] > p["b"] / p["h"]:
        raise ValueError(f"mu = {p['mu']!r}; a block slips rather than leans up to b/h")
    if variant in SWEPT:
        return _searched(p, law, w, SWEPT[variant])
    if variant.startswith("overturns"):
        return _thrown_over(p, law, w)
    if variant == "threshold":
        return _just_thrown(p, law, w)
    return _rocked(variant, p, law, w)


def _just_thrown(p: Parameters, law: Law, w: float) -> Trial:
    """What the pulse left of the block's energy."""
    most = p["part"] * rocking.threshold(**law, w=w)
    ends = History(1.01 * math.pi / w, math.pi / w)
    levels = LEVELS | {Level.QUICK: (*RUNGS[:2], RUNGS[-1])}  # clumps run at the last
    study = Ladder(_scene(p, most), ends, (CENTRE, MOVING), levels)
    return Trial(study, (_threshold(p, law, w, most),))


def _rocked(variant: str, p: Parameters, law: Law, w: float) -> Trial:
    """The path of the block, let go or under the pulse."""
    released = variant == "released"
    most = 0.0 if released else p["part"] * rocking.threshold(**law, w=w)
    over = rocking.overturns(**law, A=most, w=w) if most and p["part"] > 1.0 else math.inf
    if not p["duration"] < over:
        raise ValueError(
            f"duration = {p['duration']!r} s: from {over:.3g} s on it falls, and slips as it does"
        )
    alpha, rate = rocking.slenderness(**law)
    block = Leaning(p["b"], p["h"], p["part"] * alpha if released else 0.0)
    drive = {"A": most, "w": w, "T": math.pi / w}
    exact = _Exact(tuple(law.items()), tuple(drive.items()), block.start)
    goal = History(p["duration"], p["duration"] / 50)

    def path(t: Vector) -> Vector:
        return np.asarray(block.place(exact.leans(t)) - block.initial_centre())

    motion = Motion(CENTRE, np.array([X, Z]), path, goal.times(None), "m")
    judge = _swings(rate) if released else _near_the_top(w, p["part"])
    quantities = (
        motion.component(0, "x", "displacement of the centre along the floor", judge),
        motion.component(1, "z", "displacement of the centre upwards", judge),
        motion.distance(judge),
        *_phases(block, rate, exact),
    )
    if most and p["duration"] > 0.5:
        quantities += _before_impact(block, exact)
    if released:
        quantities += (_first_swing(block, exact, _falls_back(rate, p["part"])),)
    scene = _scene(p, most, block.start)
    study = Ladder(scene, goal, (CENTRE, MOVING), LEVELS)
    return Trial(study, quantities, _lagging(scene, p), phase=("lean", "rate"))


@dataclass(frozen=True)
class _Exact:
    """The exact lean and its rate at times (k,) [s], which are not the same at each setting."""

    law: tuple[tuple[str, float], ...]
    drive: tuple[tuple[str, float], ...]
    start: float

    def leans(self, t: Vector) -> Vector:
        return np.asarray(_phases_at(self, np.asarray(t, float).tobytes())[:, 0])

    def rates(self, t: Vector) -> Vector:
        return np.asarray(_phases_at(self, np.asarray(t, float).tobytes())[:, 1])


@functools.lru_cache(maxsize=16)  # each setting asks for the same times four times over
def _phases_at(exact: _Exact, times: bytes) -> Vector:
    law = dict((*exact.law, *exact.drive))
    return rocking.phases(np.frombuffer(times), **law, theta=exact.start)


def _lagging(scene: Scene, p: Parameters) -> EnergyAllowance:
    """What friction that lags may give at impacts, as a part of m g R."""
    weight = sum(block.mass for block in scene.blocks) * p["g"]
    return EnergyAllowance(weight * math.hypot(p["b"], p["h"]), {Method.LAGGING: LAGS})


def _phases(block: Leaning, rate: float, exact: _Exact) -> tuple[Quantity, ...]:
    """The lean over alpha and its rate over p alpha, which make the phase picture."""
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
    """The largest error of the lean over alpha until the first impact, which springs can meet."""

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
    """The paper's own measure of error, of the lean under a pulse until the block comes back."""

    def largest(after: float, run: Run) -> float:
        lean, due = block.lean(run)[0], exact.leans(run.times)
        down = np.flatnonzero((due <= 0.0) & (run.times > after))
        there = (run.times >= after) & (run.times < (run.times[down[0]] if len(down) else np.inf))
        return float(np.abs(100.0 * (lean[there] / due[there] - 1.0)).max())

    return tuple(
        Scalar(f"E_N after {after:g} s", "E_N", "", f"largest E_N [%] after {after:g} s; the "
               f"paper: below {limit:g} %", functools.partial(largest, after), None, 1.0,
               Shown(NEARLY))
        for after, limit in ((0.3, 10.0), (0.5, 1.0))
    )  # fmt: skip


def _searched(p: Parameters, law: Law, w: float, kn: float) -> Trial:
    """Amplitudes are tried from that which just lifts the block, until it overturns."""
    least, rate = p["g"] * p["b"] / p["h"], rocking.slenderness(**law)[1]
    most, span = rocking.threshold(**law, w=w), 3.0 * (1.0 + w / rate)
    bracket = Bracket(span, PAST * p["b"], tries=4, rounds=9, variable=SearchVariable.SHAKING)
    last = math.pi / w + 14.0 / rate
    rungs = (Knobs(COARSE, kn), Knobs(COARSE / 2, kn))
    levels = {Level.QUICK: rungs[:1], Level.DEFAULT: rungs[:1], Level.PAPER: rungs}
    goal = History(last, last / 50)
    study = Ladder(_scene(p, least), goal, (CENTRE,), levels, search=bracket)
    judge = _just(w)

    def seen(run: Run) -> float:
        return least * last_stable_step(run, bracket)

    return Trial(study, (
        Scalar("threshold", "A", "m/s2", "largest amplitude of half a sine that it survives", seen,
               most, most, judge),
        Scalar("over the linear one", "A/A_1", "", "the same over that of the equation for small "
               "angles", lambda run: seen(run) / rocking.linear_threshold(**law, w=w), None, 1.0,
               Shown(SMALL)),
    ))  # fmt: skip


def _thrown_over(p: Parameters, law: Law, w: float) -> Trial:
    """How long it takes to overturn."""
    most = p["part"] * rocking.threshold(**law, w=w)
    due = rocking.overturns(**law, A=most, w=w)
    block, rate = Leaning(p["b"], p["h"]), rocking.slenderness(**law)[1]
    last = due + 1.0 / rate  # before it lies flat
    goal = History(last, last / 300)

    def when(run: Run) -> float:
        """The time at which it leans by 2 alpha, between two outputs; nan if it does not."""
        lean, due_lean = block.lean(run)[0], 2 * block.alpha
        if not (lean > due_lean).any():
            return math.nan
        k = int(np.argmax(lean > due_lean))
        part = slice(max(0, k - 3), k + 3)
        from scipy.interpolate import CubicSpline

        return float(CubicSpline(lean[part], run.times[part])(due_lean))

    near = p["part"] - 1.0
    late = Tolerance(
        min(LARGEST_TOLERANCE, 1e-5 + _off(w) * p["part"] / (near * rate * due)),
        NEARER,
        dt=COARSE,
        order=2,
        floor=1e-5,
    )
    judge = Exact({Method.SECOND_ORDER: late}, not_judged=SHOWN)
    study = Ladder(_scene(p, most), goal, (CENTRE, MOVING), LEVELS)
    return Trial(study, (
        Scalar("time", "t_o", "s", "time to overturn: the block leans by 2 alpha", when, due, due,
               judge),
    ))  # fmt: skip


def _swings(rate: float) -> Exact:
    """Free swings, whose rate p [1/s] says how long a step is."""
    five = Tolerance(
        min(LARGEST_TOLERANCE, 17.0 * (rate * COARSE) ** 2),
        "(p dt)^2/12 = 1e-6 of the rate a swing, and its square root at the turn of a swing that "
        "ends upright: five impacts add up", dt=COARSE, order=2,
    )  # fmt: skip
    return Exact({Method.SECOND_ORDER: five}, not_judged=SHOWN)


def _falls_back(rate: float, part: float) -> Exact:
    """The first swing, at the rate p [1/s], from so much of alpha.

    What shifts alpha is felt as a part of what is left to the top, by which the block falls back.
    """
    felt = min(50.0, max(1.0, 0.4 / (1.0 - part)))
    bounds = {
        Method.SECOND_ORDER: Tolerance(
            min(LARGEST_TOLERANCE, (rate * COARSE) ** 2), "(p dt)^2/12 of the rate",
            dt=COARSE, order=2,
        ),
        Method.PENALTY: Tolerance(
            0.5 * rate * COARSE + 5e-4 * felt, "a start half a step off; and what stands on small "
            "spheres at its corners turns about these, a thousandth of its size across, which is "
            "felt over 1 - part: the nearer the top, the less brings it back",
            dt=COARSE, order=1, floor=5e-4 * felt,
        ),
    }  # fmt: skip
    shown = {method: why for method, why in SHOWN.items() if method not in bounds}
    return Exact(bounds, not_judged=shown)


def _near_the_top(w: float, part: float) -> Exact:
    """Under a pulse of w [1/s], so many parts of the threshold."""
    left = 0.2 * _off(w) / max(abs(part - 1.0), 1e-3)
    slow = Tolerance(
        min(LARGEST_TOLERANCE, 2e-4 + left),
        "the threshold of the step is (w dt)^2/2 off, over the part that the pulse is off it",
        dt=COARSE, order=2,
    )  # fmt: skip
    return Exact({Method.SECOND_ORDER: slow}, not_judged=SHOWN)


def _just(w: float) -> Exact:
    """The threshold itself, as near as a search comes to it."""
    least = Tolerance(
        min(LARGEST_TOLERANCE, max(FOUND, _off(w))),
        "(w dt)^2/2, as the sine is taken by its mean over a step and the block begins to lean "
        "within one", dt=COARSE, order=2, floor=FOUND,
    )  # fmt: skip
    return Exact({Method.SECOND_ORDER: least}, not_judged=SHOWN)


def _off(w: float) -> float:
    """How far the threshold of the longest step is off, (w dt)^2/2."""
    return 0.5 * (w * COARSE) ** 2


def _threshold(p: Parameters, law: Law, w: float, most: float) -> Scalar:
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
                  seen, most, most, _just(w))  # fmt: skip


COARSE = 1e-3  # s
FOUND = 4e-6  # of the threshold, within which a search comes to it
LAGS = Tolerance(
    0.1,
    "as a corner strikes, friction of the iteration before may act along the slip: 0.04 of m g R "
    "was the most that it gave for eight blocks",
)
RUNGS = tuple(Knobs(COARSE / part, 1e10) for part in (1, 2, 4, 20))  # explicit codes bear the last
LEVELS = {Level.QUICK: RUNGS[:2], Level.DEFAULT: RUNGS, Level.PAPER: RUNGS}
SPRUNG = (
    "springs lengthen every impact and give back what they please, by stiffness and step: like "
    "Housner's at 1e10 N/m and 1e-3 s, bouncing at 1e-4 s"
)
SHOWN = {
    **dict.fromkeys((Method.PENALTY, Method.LAGGING), SPRUNG),
    Method.FIRST_ORDER: "it takes an impact at the end of a step, of which five add up",
}
NEARLY = (
    "it has no bound as the block begins to lean, and so near the threshold it is that of the "
    "threshold, grown by exp(p t)"
)
JUDGED = "the displacements are judged; a rate jumps at every impact"
SMALL = "that of the block itself, 1.0363 of the linear one at the default sizes, is judged"
NEARER = (
    "the threshold of the step is (w dt)^2/2 off, which an excess over it near the threshold feels "
    "as a part of itself: the time grows by 1/p for a factor of e"
)
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
        Parameter("part", 0.6, "", "initial lean over alpha, or amplitude over the threshold"),
        Parameter("f", 1.0, "Hz", "frequency of the sine, of which half a period acts"),
        Parameter("mu", 0.6, "", "friction coefficient"),
        Parameter("g", 9.81, "m/s2", "gravity"),
        Parameter("duration", 1.5, "s", "time simulated"),
    ),
    variants=(
        Variant("released", "released at 0.6 alpha, through three impacts",
                "theta'' = -p^2 sin(alpha - theta), p^2 = 3 g/4R; rate times 1 - 1.5 sin^2 alpha "
                "at impacts", inert=frozenset({"mu", "f"})),
        Variant("stands", "half a sine, 1e-3 below the threshold: it leans and "
                          "returns", SHAKEN := (
                "theta'' = p^2 (-sin(alpha - theta) + a/g cos(alpha - theta)), a = A sin wt to "
                "t = pi/w"), {"part": 0.999}, frozenset({"mu"}), Level.DEFAULT),
        Variant("topples", "half a sine, 1e-3 beyond the threshold", SHAKEN, {"part": 1.001},
                frozenset({"mu"}), Level.DEFAULT),
        Variant("threshold", "the amplitude that just overturns it",
                "theta'^2/2 + p^2 cos(alpha - theta) = p^2 as the pulse ends",
                {"part": 1.0}, frozenset({"mu", "duration"}), unseen={
                    "f": "a pulse at the threshold of its own frequency leaves no more energy"}),
        *(
            Variant(f"overturns-{name}", f"time to overturn under half a sine, {name} beyond the "
                    "threshold", SHAKEN + "; ln(100)/p more for two decades nearer",
                    {"part": 1.0 + near}, frozenset({"mu", "duration"}), Level.DEFAULT)
            for name, near in (("1e-1", 1e-1), ("1e-2", 1e-2), ("1e-4", 1e-4))
        ),
        *(
            Variant(name, f"the largest amplitude it survives, searched with {what}", SHAKEN, {},
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
