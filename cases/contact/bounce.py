"""Spheres that rotate freely and bounce: on a floor, and on each other, with stick and slip."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable

import numpy as np

from cases._papers import LI_2018
from cases.contact.parts._bouncing import (
    GOAL,
    coarsest_step,
    floor_path,
    mass_of,
    on_floor,
    pair_path,
    pair_scene,
    require_meeting,
    require_shallow,
)
from vv.ask import Displacement, Knobs, Method
from vv.case import (
    Case,
    Exact,
    Judge,
    Ladder,
    Level,
    Motion,
    Parameter,
    Parameters,
    Quantity,
    Source,
    Tolerance,
    Trial,
    Variant,
)
from vv.scene import Scene, Vector

Path = Callable[[Vector], Vector]  # times (k,) -> displacements (k, directions)
Why = tuple[str, str] | tuple[()]  # why the bounds of second and of first order


def _declare(variant: str, p: Parameters) -> Trial:
    alone = variant in ("floor", "held")
    if variant == "floor" and p["load"]:
        raise ValueError(f"load = {p['load']!r} N; it must be 0, since nothing bears it here")
    scene = on_floor(p, variant == "held") if alone else pair_scene(p)
    require_shallow(alone, p)
    if not alone:
        require_meeting(p)
    step = coarsest_step(FLOOR_STEP if alone else PAIR_STEP, CASE.defaults(variant), alone, p)
    if alone:
        seen: tuple[Displacement, ...] = (Displacement(1),)
        motion = _motion(seen[0], scene, 3, functools.partial(floor_path, p))
        step /= _parts(_ends(motion, step, p), _late(motion, step, p))
        quantities = _sphere_quantities(motion, step, p, own=p == CASE.defaults(variant))
    else:
        seen = (Displacement(0), Displacement(1))
        paths = [functools.partial(pair_path, p, what.body) for what in seen]
        motions = [_motion(w, scene, 2, path) for w, path in zip(seen, paths, strict=True)]
        quantities = _pair_quantities(motions, step, p)
    if not GOAL.duration / step <= MOST:
        raise ValueError(
            f"kn = {p['kn']!r} N/m; steps that resolve a contact are {GOAL.duration / step:.3g}; "
            f"at most {MOST:g} are run"
        )
    return Trial(Ladder(scene, GOAL, seen, _levels(step)), quantities)


def _parts(second: float, first: float) -> int:
    """How many steps replace one, a power of two: so many that these errors may be judged."""
    most = max(math.sqrt(second / JUDGED), first / JUDGED, 1.0)
    return 1 << math.ceil(math.log2(most))


def _motion(what: Displacement, scene: Scene, directions: int, path: Path) -> Motion:
    return Motion(what, scene.axes[:directions], path, GOAL.times(None), "m")


def _sphere_quantities(
    motion: Motion, step: float, p: Parameters, own: bool
) -> tuple[Quantity, ...]:
    """own: whether the parameters are the case's, at which errors of contacts partly cancel."""
    arm = 2 * _closing(p) * math.sqrt(mass_of(p, p["r1"]) / p["kn"]) / p["r1"]
    ends, late = _ends(motion, step, p), _late(motion, step, p)
    rises = (2e-4 if own else max(2e-4, ends)) + arm
    up = _judge(step, rises, rises + late, arm)
    rubs = min(2 * p["mu"], 1.0)  # twice mu where friction also rotates the sphere
    jump, order = _released(p, mass_of(p, p["r1"]), step * _left_on_floor(p), ends * _way(motion))
    rubbed = max(2e-4, rubs * ends) + jump / _way(motion) + arm
    delayed = max(rubs * late, _rubbing(p) * step / 2 / _way(motion))
    along = _judge(step, rubbed, rubbed + delayed, arm, order=order)
    both = math.hypot(rises, rubbed), math.hypot(rises + late, rubbed + delayed)
    apart = along if own else _judge(step, *both, arm, order=order)
    ways = (
        ("x", "along the throw", along),
        ("y", "horizontally, across the throw", NOWHERE),
        ("z", "upwards", up),
    )
    parts = [
        motion.component(i, axis, f"displacement of the sphere {how}", by)
        for i, (axis, how, by) in enumerate(ways)
    ]
    return (*parts, motion.distance(apart))


def _ends(motion: Motion, step: float, p: Parameters) -> float:
    """The largest error by ends of contacts within steps [s], over the displacement.

    A leapfrog conserves v^2/2 + k^2 x x*/2, x and x* the overlaps before and after a step. In the
    steps in which a contact begins and ends, x x* is between -(v dt)^2/4 and 0: a contact changes
    the speed by up to (k dt)^2/8 of it, for the time that is left.
    """
    speed = _closing(p) * p["kn"] / mass_of(p, p["r1"]) * step**2 / 8
    return speed * _left_on_floor(p) / _way(motion)


def _left_on_floor(p: Parameters) -> float:
    """The time that is left after a contact with the floor closes, summed over all [s]."""
    return _left(p, p["g"], _closing(p), math.sqrt(p["kn"] / mass_of(p, p["r1"])))


def _left(p: Parameters, pull: float, closing: float, swing: float) -> float:
    """The time that is left after a contact closes, summed over all [s].

    pull: what presses the bodies together [m/s2]; closing: the speed at which they meet [m/s];
    swing: the rate of the contact [1/s].
    """
    first = 2 * p["gap"] / (closing + p["v_n"])
    apart = max(np.pi / swing, 2 * closing / pull if pull > 0 else GOAL.duration)
    return float((GOAL.duration - np.arange(first, GOAL.duration, apart)).sum())


def _late(motion: Motion, step: float, p: Parameters) -> float:
    """The error of a weight that acts half a step [s] late or early, over the displacement.

    It changes the speed at the start by g dt/2. All happens up to dt/2 earlier or later, at speeds
    of at most sqrt(c^2 + g^2/k^2) and v + g T, and the speed c of impact changes by g dt/2 v/c, for
    the whole time T; so do the durations of all flights, which are as c: that is as much again.
    """
    closing, pressed = _closing(p), p["g"] * math.sqrt(mass_of(p, p["r1"]) / p["kn"])
    fastest = min(math.hypot(closing, pressed), p["v_n"] + p["g"] * GOAL.duration)
    faster = p["g"] * step / 2 * p["v_n"] / closing
    return (fastest * step / 2 + 2 * faster * GOAL.duration) / _way(motion)


def _rubbing(p: Parameters) -> float:
    """The largest change [m/s] of the speed along the floor.

    Friction is at most mu times a normal force, whose impulse over the mass is g T and, as the
    sphere comes and goes, twice the speed at which it meets the floor. It does not do more than
    turn round the slip, of which 2/7 is the motion of the centre.
    """
    pushed = p["g"] * GOAL.duration + 2 * _closing(p)
    return min(p["mu"] * pushed, 4 / 7 * _slip(p))


def _slip(p: Parameters) -> float:
    """The largest slip at the start [m/s]."""
    return abs(p["v_t"]) + abs(p["r1"] * p["w1"]) + abs(p["r2"] * p["w2"])


def _closing(p: Parameters) -> float:
    """The speed [m/s] at which the sphere meets the floor."""
    return math.sqrt(p["v_n"] ** 2 + 2 * p["g"] * p["gap"])


def _way(motion: Motion) -> float:
    """The largest displacement [m]."""
    return float(np.linalg.norm(motion.path(GOAL.times(None)), axis=1).max())


def _pair_quantities(motions: list[Motion], step: float, p: Parameters) -> tuple[Quantity, ...]:
    quantities: list[Quantity] = []
    for n, motion in enumerate(motions, 1):
        second, first = _pair_errors(p, n, step)
        way = _way(motion)
        # Only friction acts across the line of centres: mu times the normal force, twice if it
        # rotates. While the spheres stick, shear springs swing with kt^2 = 3.5 ks/m and a velocity
        # of up to mu v k/kt: an error of the phase of (kt dt)^2/24 times kt, for a time of pi/k.
        rubs = max(min(2 * p["mu"], 1.0), math.pi / 6 * p["mu"] * 3.5 * p["ks"] / p["kn"])
        for i, (axis, how, part) in enumerate(PARTS):
            share = rubs**part / way
            jump, order = _released(p, mass_of(p, p[f"r{n}"]), step * GOAL.duration, second)
            worst = second * share + part * jump / way + ROUNDED
            judge = _judge(step, worst, first * share + worst, why=OF_PAIR, order=order * part or 2)
            what = f"displacement of sphere {n} {how}"
            quantities.append(motion.component(i, f"{axis}{n}", what, judge))
    return tuple(quantities)


def _pair_errors(p: Parameters, n: int, step: float) -> tuple[float, float]:
    """Errors of the displacement [m] by ends of contacts within steps [s], and by a late load.

    Where the load lets the spheres meet again and again, the changes of speed by all contacts add.
    """
    light = 1 / mass_of(p, p["r1"]), 1 / mass_of(p, p["r2"])
    pull, share = p["load"] * sum(light), light[n - 1] / sum(light)
    closing = np.sqrt(p["v_n"] ** 2 + 2 * pull * p["gap"])
    square = p["kn"] * sum(light)
    left = max(2 * GOAL.duration, _left(p, pull, closing, math.sqrt(square)))
    second = float(closing * square * step**2 / 8) * share * left
    return second, pull * step / 2 * share * GOAL.duration


def _released(p: Parameters, mass: float, late: float, second: float) -> tuple[float, int]:
    """The error [m] by the last slip before bodies part, and its order.

    A shear force F falls to zero with mu kn U: an error of mu times `second`, that of the normal
    force. Where it falls within less than a step, it ends anywhere in that and changes the speed by
    up to F dt/m; F is at most what springs make of all slip at the start, s sqrt(ks m/3.5), and
    less where both bodies move. late: dt times the time that is left [s2].
    """
    jump = _slip(p) * math.sqrt(p["ks"] / (3.5 * mass)) * late
    resolved = max(p["mu"] - 1.0, 0.0) * second
    return (resolved, 2) if resolved < jump else (jump, 1)


def _levels(coarsest: float) -> dict[Level, tuple[Knobs, ...]]:
    rungs = tuple(Knobs(dt=coarsest / 2**i) for i in range(4))
    coarse = rungs[:3:2]  # the finest beside them shows 1 % of rho to methods of first order
    return {Level.QUICK: coarse, Level.DEFAULT: (*coarse, rungs[3]), Level.PAPER: rungs}


def _judge(
    step: float, second: float, first: float, arm: float = 0.0, why: Why = (), order: int = 2
) -> Judge:
    """second, first: bounds at the coarsest step [s]; arm: the effect of U/(2 r) on the force."""
    rubbed, late = why or ON_FLOOR
    return Exact({
        Method.EXACT: Tolerance(
            1e-11,
            "two independent routes to the answer agree to 1e-12, over a dozen located events",
        ),
        Method.SECOND_ORDER: Tolerance(second, rubbed, dt=step, order=order, floor=arm),
        Method.FIRST_ORDER: Tolerance(first, late, dt=step, order=1),
    })  # fmt: skip


ON_FLOOR = (
    "a contact lasts for more than a hundred steps: an error of (k dt)^2/24 = 3e-5 for its "
    "oscillation, and as much for each of its ends and for those of slip, over four bounces. At "
    "most (k dt)^2/8 of the speed is lost or gained in a contact, for the time that is left, and "
    "friction turns this into tangential speed. Codes differ in the arm of the shear force, r - "
    "U/2 or r, with U/r = 1e-5",
    "weight and load act half a step late at the start: this changes the speed v of the first "
    "impact by g dt/2v, 6e-5, and everything after it by as much; speeds along the floor are late "
    "by as much",
)
OF_PAIR = (
    "each end of a contact falls within a step, and costs up to (k dt)^2/8 of the closing speed, "
    "k^2 = kn (1/m1 + 1/m2); the errors of both ends of one contact may add, for the whole time, "
    "and those of all contacts, for the time that is left after each. "
    "Across the line of centres it is the part by friction or, if that is more, pi/24 (kt dt)^2 mu "
    "of the closing speed by the phase of shear springs, kt^2 = 3.5 ks (1/m1 + 1/m2)",
    "the load acts half a step late at the start: the closing speed is too small by a dt/2 for the "
    "whole time, a = P (1/m1 + 1/m2)",
)
ROUNDED = 1e-11  # of the displacement: rounding errors where nothing pushes
PARTS = (("x", "along the initial line of centres", 0), ("y", "across that line", 1))
NOWHERE: Judge = Exact(dict.fromkeys(
    (Method.EXACT, Method.SECOND_ORDER, Method.FIRST_ORDER),
    Tolerance(1e-12, "no force acts in this direction, or it is locked: only rounding errors "
              "remain"),
))  # fmt: skip
FLOOR_STEP, PAIR_STEP = 5e-7, 2e-5  # s
MOST = 1e7  # steps at the coarsest setting, some seconds of calculation
JUDGED = 0.05  # the largest error that is judged

LAW = (
    "U'' = g - kn U/m in contact; F' = -ks s while |F| <= mu kn U, s = v_x - r w, "
    "m v_x' = F, 2/5 m r^2 w' = -r F; F = 0 where they part"
)
BOTH = (
    "m_i u_i'' = -+(kn U n + F e) +- P, 2/5 m_i r_i^2 w_i' = -a_i F; F' = -ks s while "
    "|F| <= mu kn U, s = (v_2 - v_1).e - (a_1 w_1 + a_2 w_2), a_i = r_i - U/2; F = 0 where they "
    "part"
)
OF_ONE, WEIGHTLESS = frozenset({"r2", "w2"}), frozenset({"g"})
VARIANTS = (
    Variant(
        "floor", "a sphere thrown onto a floor bounces four times, sticking and slipping each time",
        LAW, inert=OF_ONE,
    ),
    Variant(
        "held", "the same, locked along a horizontal direction in which a load pushes it, with "
        "backspin",
        LAW, {"mu": 0.3, "ks": 1.6e10, "v_t": 0.005, "w1": 0.15, "load": 50.0},
        inert=OF_ONE | {"load"},
    ),
    Variant(
        "pair", "two spheres collide obliquely without gravity and separate: slip, stick, slip",
        BOTH, PAIR := {"kn": 5e6, "ks": 4e6, "mu": 0.3, "g": 0.0, "v_n": 0.04, "v_t": 0.03,
                       "w1": 0.2, "w2": -0.4}, inert=WEIGHTLESS,
    ),
    Variant(
        "again", "dead loads press the spheres together: they bounce on each other three times",
        BOTH, {**PAIR, "load": 26.0}, inert=WEIGHTLESS,
    ),
)  # fmt: skip
CASE = Case(
    name="bounce",
    title="Bouncing spheres with spin",
    source=Source(
        *LI_2018,
        "The contact law is that of Eqs. 4-8; bounces and spin are not in the paper. On the floor "
        "the shear force acts at the radius, between two spheres in the middle of the overlap. The "
        "shear spring starts uncharged at every contact.",
    ),
    parameters=(
        Parameter("rho", 2500.0, "kg/m3", "density"),
        Parameter("r1", 0.1, "m", "radius of the sphere, or of the first"),
        Parameter("r2", 0.07, "m", "radius of the second"),
        Parameter("kn", 2e10, "N/m", "normal contact stiffness"),
        Parameter("ks", 3e10, "N/m", "shear contact stiffness"),
        Parameter("mu", 0.5, "", "friction coefficient"),
        Parameter("g", 9.81, "m/s2", "gravity"),
        Parameter("gap", 1e-4, "m", "gap at the start"),
        Parameter(
            "v_n", 0.0, "m/s", "initial velocity towards the floor, or towards the first sphere"
        ),
        Parameter("v_t", 0.02, "m/s", "initial velocity across that direction"),
        Parameter("w1", 0.5, "1/s", "initial spin of the sphere, or of the first"),
        Parameter("w2", 0.0, "1/s", "initial spin of the second sphere"),
        Parameter("load", 0.0, "N", "dead load: along the lock, or on each of two spheres"),
    ),
    variants=VARIANTS,
    declare=_declare,
)
