"""Spheres that rotate freely and bounce: on a floor, and on each other, with stick and slip."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable

from cases._papers import LI_2018
from cases.contact.parts import _bouncing_bounds as bounds
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
        step /= _parts(
            bounds.error_of_ends(motion, step, p), bounds.error_of_late_weight(motion, step, p)
        )
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
    arm = 2 * bounds.closing_speed(p) * math.sqrt(mass_of(p, p["r1"]) / p["kn"]) / p["r1"]
    ends, late = bounds.error_of_ends(motion, step, p), bounds.error_of_late_weight(motion, step, p)
    rises = (2e-4 if own else max(2e-4, ends)) + arm
    up = bounds.judge(step, rises, rises + late, arm)
    rubs = min(2 * p["mu"], 1.0)  # twice mu where friction also rotates the sphere
    jump, order = bounds.released(
        p, mass_of(p, p["r1"]), step * bounds.left_on_floor(p), ends * bounds.farthest(motion)
    )
    rubbed = max(2e-4, rubs * ends) + jump / bounds.farthest(motion) + arm
    delayed = max(rubs * late, bounds.rubbing(p) * step / 2 / bounds.farthest(motion))
    along = bounds.judge(step, rubbed, rubbed + delayed, arm, order=order)
    both = math.hypot(rises, rubbed), math.hypot(rises + late, rubbed + delayed)
    apart = along if own else bounds.judge(step, *both, arm, order=order)
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


def _pair_quantities(motions: list[Motion], step: float, p: Parameters) -> tuple[Quantity, ...]:
    quantities: list[Quantity] = []
    for n, motion in enumerate(motions, 1):
        second, first = bounds.pair_errors(p, n, step)
        way = bounds.farthest(motion)
        # Only friction acts across the line of centres: mu times the normal force, twice if it
        # rotates. While the spheres stick, shear springs swing with kt^2 = 3.5 ks/m and a velocity
        # of up to mu v k/kt: an error of the phase of (kt dt)^2/24 times kt, for a time of pi/k.
        rubs = max(min(2 * p["mu"], 1.0), math.pi / 6 * p["mu"] * 3.5 * p["ks"] / p["kn"])
        for i, (axis, how, part) in enumerate(PARTS):
            share = rubs**part / way
            jump, order = bounds.released(p, mass_of(p, p[f"r{n}"]), step * GOAL.duration, second)
            worst = second * share + part * jump / way + ROUNDED
            judge = bounds.judge(
                step, worst, first * share + worst, why=bounds.OF_PAIR, order=order * part or 2
            )
            what = f"displacement of sphere {n} {how}"
            quantities.append(motion.component(i, f"{axis}{n}", what, judge))
    return tuple(quantities)


def _levels(coarsest: float) -> dict[Level, tuple[Knobs, ...]]:
    rungs = tuple(Knobs(dt=coarsest / 2**i) for i in range(4))
    coarse = rungs[:3:2]  # the finest beside them shows 1 % of rho to methods of first order
    return {Level.QUICK: coarse, Level.DEFAULT: (*coarse, rungs[3]), Level.PAPER: rungs}


ROUNDED = 1e-11  # of the displacement: rounding errors where nothing pushes
PARTS = (("x", "along the initial line of centres", 0), ("y", "across that line", 1))
NOWHERE: Judge = Exact(dict.fromkeys(
    (Method.EXACT, Method.SECOND_ORDER, Method.FIRST_ORDER),
    Tolerance(1e-12, "no force acts in this direction, or it is locked: only rounding errors "
              "remain"),
))  # fmt: skip
FLOOR_STEP, PAIR_STEP = 5e-7, 2e-5  # s
MOST = 1e6  # steps at the coarsest setting; the finest of a default run takes half a minute
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
