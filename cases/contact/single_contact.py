"""Single contacts T1-T4 of Li et al. (2018): a normal and a shear spring, with and without drag."""

from __future__ import annotations

import dataclasses
import functools
import math
from collections.abc import Callable, Mapping

import numpy as np

from cases._papers import LI_2018
from reference_solutions.contact import single_contact as closed
from vv.ask import Displacement, History, Knobs, Method
from vv.case import (
    LARGEST_TOLERANCE,
    Case,
    ComponentAlong,
    Exact,
    Ladder,
    Level,
    Parameter,
    Parameters,
    Series,
    Source,
    Tolerance,
    Trial,
    Variant,
)
from vv.scene import (
    Contact,
    Scene,
    Spheres,
    Vector,
    Wall,
    initial_normal_forces,
    rotated,
    rotation_about_z,
    with_bodies_reversed,
)

ANGLE = 0.9  # rad; arbitrary, far from every axis and diagonal
# what decides the overlap of the shear tests
OVERLAP = ("rho", "r", "kn", "ks", "mu", "eta", "v_b")
FIXED = [False, False, False]
ALONG_Y = [False, True, False]


def _normal_scene(p: Parameters, eta: float) -> Scene:
    """Particle 2 falls on particle 1, which is fixed (Li 2018, Fig. 3)."""
    m = closed.mass(p["rho"], p["r"])
    spheres = Spheres(
        position=np.array([[0.0, -2 * p["r"], 0.0], [0.0, 0.0, 0.0]]),
        velocity=np.array([[0.0, 0.0, 0.0], [0.0, p["v_a"], 0.0]]),
        radius=np.full(2, p["r"]),
        mass=np.full(2, m),
        free=np.array([FIXED, ALONG_Y]),
    )
    return Scene((spheres,), Contact(p["kn"]), eta)


def _shear_scene(p: Parameters, eta: float) -> Scene:
    """Particle 4 is pressed into wall 3 by dx and slides along it (Li 2018, Fig. 5)."""
    dx = closed.overlap(**{name: p[name] for name in OVERLAP})
    wall = Wall(np.array([dx - p["r"], 0.0, 0.0]), np.array([1.0, 0.0, 0.0]))
    sphere = Spheres(
        position=np.zeros((1, 3)),
        velocity=np.array([[0.0, p["v_b"], 0.0]]),
        radius=np.array([p["r"]]),
        mass=np.array([closed.mass(p["rho"], p["r"])]),
        free=np.array([ALONG_Y]),
    )
    return Scene((wall, sphere), Contact(p["kn"], p["ks"], p["mu"]), eta)


REFERENCES: Mapping[str, tuple[Callable[..., Vector], tuple[str, ...]]] = {
    "T1": (closed.t1, ("rho", "r", "kn", "v_a")),
    "T2": (closed.t2, ("rho", "r", "kn", "eta", "v_a")),
    "T3": (closed.t3, OVERLAP),
    "T4": (closed.t4, OVERLAP),
}


def _scene(variant: str, p: Parameters) -> tuple[Scene, int, Vector]:
    """The scene of a variant, the body that moves in it, and the direction of its motion."""
    test, _, change = variant.partition("-")
    eta = p["eta"] if test in ("T2", "T4") else 0.0
    scene = _normal_scene(p, eta) if test in ("T1", "T2") else _shear_scene(p, eta)
    if change == "swapped":
        return with_bodies_reversed(scene), 0, scene.axes[1]
    if change == "free":
        scene = _unlocked(scene)
    if change == "rotated":
        scene = rotated(scene, rotation_about_z(ANGLE))
    return scene, 1, scene.axes[1]


def _unlocked(scene: Scene) -> Scene:
    """The scene without locks on the moving body, where a dead load keeps its contact closed."""
    free = np.array([body.any() for body in scene.spheres.free])[:, None] & np.ones(3, bool)
    load = np.where(free, -initial_normal_forces(scene), 0.0)
    let_go = dataclasses.replace(scene.spheres, free=free, load=load)
    return dataclasses.replace(scene, bodies=(*scene.walls, let_go))


def _require_shallow(test: str, change: str, p: Parameters) -> None:
    """Raise ValueError where a contact that can open overlaps by a tenth of the radius or more.

    Where its normal is locked the overlap is that of the start, and only its force matters.
    """
    if test in ("T3", "T4"):
        if change != "free":
            return
        depth, name = closed.overlap(**{name: p[name] for name in OVERLAP}), "mu"
    else:
        depth, name = abs(p["v_a"]) / _rates(test, p)[0], "v_a"
    if not depth < p["r"] / 10:
        raise ValueError(
            f"{name} = {p[name]!r}; the overlap of {depth:.4g} m must be below a tenth of the "
            f"radius, {p['r'] / 10:g} m"
        )


def _declare(variant: str, p: Parameters) -> Trial:
    _require_shallow(variant[:2], variant.partition("-")[2], p)
    scene, body, along = _scene(variant, p)
    solve, names = REFERENCES[variant[:2]]
    shown = Displacement(body)

    y = Series(
        name="y",
        symbol="y",
        unit="m",
        meaning="displacement of the free particle along its line of motion",
        observe=ComponentAlong(shown, along),
        reference=functools.partial(solve, **{name: p[name] for name in names}),
        judge=_judge(variant.partition("-")[0], p),
    )
    goal = History(DURATION, interval=1e-3)
    parts = _parts(variant.partition("-")[0], p)
    levels = {level: _divided(rungs, parts) for level, rungs in LEVELS.items()}
    timed = _divided(TIMED, parts) if variant in REFERENCES else ()
    return Trial(Ladder(scene, goal, (shown,), levels, timed), (y,))


def _parts(test: str, p: Parameters) -> int:
    """How many steps replace one, a power of two: so many that first order may be judged."""
    most = _first_order(*_rates(test, p)) * COARSEST / LARGEST_TOLERANCE
    return 1 << math.ceil(math.log2(max(most, 1.0)))


def _divided(rungs: tuple[Knobs, ...], parts: int) -> tuple[Knobs, ...]:
    return tuple(Knobs(dt=(knobs.dt or 0.0) / parts) for knobs in rungs)


def _rates(test: str, p: Parameters) -> tuple[float, float]:
    """The rates k of the spring and n of the drag [1/s]."""
    mass = closed.mass(p["rho"], p["r"])
    k = math.sqrt(p["kn" if test in ("T1", "T2") else "ks"] / mass)
    return k, p["eta"] / (2 * mass) if test in ("T2", "T4") else 0.0


def _first_order(k: float, n: float) -> float:
    """The error of methods of first order over the step [1/s]."""
    return max(3.6 * n, 0.5 * k)


COARSEST = 4e-3  # s
RUNGS = tuple(Knobs(dt=dt) for dt in (COARSEST, 2e-3, 1e-3, 5e-4, 1e-4, 1e-5))
TIMED = (RUNGS[0], *RUNGS[3:5])
LEVELS = {Level.QUICK: RUNGS[1:5:2], Level.DEFAULT: RUNGS, Level.PAPER: RUNGS}


def _judge(test: str, p: Parameters) -> Exact:
    """The bounds from the rates k of the spring and n of the drag [1/s], over the step."""
    k, n = _rates(test, p)
    step = STEP / _parts(test, p)
    phase = (k * step) ** 2 * _ahead(test, k, n)
    shallow = SHALLOW * _rounding(p) if test in ("T3", "T4") else 0.0
    rounded = ROUNDED_STEPS + shallow
    second = Tolerance(
        max(float(phase), rounded),
        "the phase error of a leapfrog, (k dt)^2/24 per period, is 2e-5 at 1e-3 s and grows with "
        "drag; where contact and slip begin or end within a step, errors of the same order are "
        "added. Below it each of 4e4 steps rounds by eps, and the overlap of T3 and T4 is rounded "
        "as for exact methods",
        dt=step,
        order=2,
        floor=rounded,
    )
    balanced = {} if n else {Method.LATE_LEAPFROG: dataclasses.replace(second, reason=BALANCED)}
    return Exact({
        Method.EXACT: Tolerance(
            1e-13 + shallow,
            "rounding errors of about a hundred operations, eps = 2.2e-16 each. In T3 and T4 the "
            "overlap is rounded too, as a difference of coordinates as large as r: an error of eps "
            "r/dx of the limit of friction, and of at most 1 + sqrt 2 times that of the largest "
            "displacement",
            slack="T1 and T2 are exact to a few eps, T3 and T4 where coordinates are round",
        ),
        Method.SECOND_ORDER: second,
        Method.FIRST_ORDER: Tolerance(
            max(float(_first_order(k, n) * step), rounded),
            "drag that is half a step late changes its coefficient by n dt = 0.7 % at 1e-3 s; a "
            "start half a step late changes the velocity by as much, or by a part of k dt. Both "
            "errors add up over the three stages of T4",
            dt=step,
            order=1,
            floor=rounded,
        ),
        **balanced,
    })  # fmt: skip


def _ahead(test: str, k: float, n: float) -> float:
    """The error of methods of second order over (k dt)^2.

    In T3 and T4 the sphere swings by a quarter of its largest displacement until the end or until
    drag has ended it, and the phase is ahead by (k dt)^2/24 of the angle: beyond the 6.4 rad of the
    case's own parameters this is added.
    """
    swung = k * DURATION if not n else min(k * DURATION, k / (math.e * n))
    beyond = max(0.0, swung - 6.4) if test in ("T3", "T4") else 0.0
    return max(0.4, 0.25 * (1 + (2 * n / k) ** 2)) + 0.257 / 24 * beyond


def _rounding(p: Parameters) -> float:
    """The rounding error of the coordinates over the overlap, at most 1 %."""
    dx = closed.overlap(**{name: p[name] for name in OVERLAP})
    error = float(np.finfo(float).eps) * p["r"] / dx
    if error > 0.01:
        rule = f"an overlap so small is lost as coordinates of r = {p['r']:g} m are rounded"
        raise ValueError(f"dx = {dx:.4g} m; {rule}")
    return error


BALANCED = (
    "without drag the only force that is half a step late is the dead load. It is constant, and "
    "the contact balances it at the start, so that the error of a leapfrog remains: (k dt)^2/24 "
    "per period, and errors of the same order where slip begins or ends within a step"
)
STEP, DURATION = 1e-3, 0.4  # s
ROUNDED_STEPS = 1e-11  # of 4e4 steps, as many as the finest setting takes
SHALLOW = 1 + np.sqrt(2)
"""By what part of the largest displacement T3 and T4 change with the limit of friction y1.

With s = k y1/v_b, in units of v_b/k: the slip (1 - s^2)/2s changes by (1 + s^2)/2s, which is the
largest displacement, the swing about it by s, and its phase by sqrt(1 - s^2)/s of a circle of s.
"""


def _variants() -> tuple[Variant, ...]:
    """T1-T4, then each mirrored, renumbered, unlocked and rotated, with the same exact answer."""
    plain = [Variant(test, *words, inert=INERT[test]) for test, words in WORDS.items()]
    changed = [
        Variant(f"{v.name}-{change}", f"{v.summary}; {how}", v.formula, defaults, v.inert)
        for change, how, defaults in CHANGES
        for v in plain
        if change != "mirrored" or v.name in ("T3", "T4")
    ]
    return (*plain, *changed)


WORDS = {
    "T1": (
        "normal contact of two particles, no drag",
        "y = (v_a/k) sin kt to t = pi/k, then -v_a (t - pi/k); k^2 = kn/m, m = 2 sqrt3 rho r^2, "
        "of a metre of thickness",
    ),
    "T2": (
        "normal contact of two particles with drag",
        "y = (v_a/wd) e^{-nt} sin wd t to pi/wd, then (v_n2/2n)(1 - e^{-2n(t - pi/wd)}); "
        "n = eta/2m, wd^2 = k^2 - n^2, v_n2 = -v_a e^{-n pi/wd}",
    ),
    "T3": (
        "shear contact of a particle with a wall, no drag: stick, slip, stick",
        "y = (v_b/k) sin kt | y1 + v_s1 s - a s^2/2 | b + y1 cos k(t - t_s4); k^2 = ks/m, "
        "y1 = mu kn dx/ks, a = k^2 y1, b = v_s1^2/2a. The overlap dx with the wall is chosen so "
        "that slip begins at t = pi/(8 wd) in T4: dx is as 1/(mu kn), and neither changes y",
    ),
    "T4": (
        "shear contact of a particle with a wall, with drag: stick, slip, stick",
        "y = (v_b/wd) e^{-nt} sin wd t | y1 + (B/2n)(1 - e^{-2ns}) - (a/2n) s | "
        "d + y1 e^{-ns}(cos wd s + (n/wd) sin wd s); n = eta/2m, wd^2 = k^2 - n^2, k, y1 and a as "
        "in T3, B = v_s2 + a/2n, s the time since slip began or ended, d how far it slipped",
    ),
}
INERT = {
    "T1": frozenset({"ks", "mu", "eta", "v_b"}),
    "T2": frozenset({"ks", "mu", "v_b"}),
    "T3": frozenset({"v_a", "kn", "mu"}),  # dx is chosen such that y1 = mu kn dx/ks stays
    "T4": frozenset({"v_a", "kn", "mu"}),
}
CHANGES: tuple[tuple[str, str, Parameters], ...] = (
    ("mirrored", "initial velocity in the opposite direction", {"v_b": -1.0}),
    ("swapped", "bodies in the opposite order", {}),
    ("free", "no direction is locked: a dead load keeps the contact closed", {}),
    ("rotated", f"the whole scene rotated by {ANGLE} rad", {}),
)
CASE = Case(
    name="single-contact",
    title="Single contacts T1-T4",
    source=Source(
        *LI_2018,
        "v_a is -0.1 m/s: the -0.01 of Eq. 27 contradicts Eqs. 29 and 31. Eq. 3 is the root of "
        "a sum of squares. Eq. 8 must cap |F_s| and keep its sign. Eqs. 9 and 11 use the "
        "previous mean velocity.",
    ),
    parameters=(
        Parameter("rho", 2500.0, "kg/m3", "density"),
        Parameter("r", 50.0, "m", "radius"),
        Parameter("kn", 5.5e9, "N/m", "normal contact stiffness"),
        Parameter("ks", 5.5e9, "N/m", "shear contact stiffness"),
        Parameter("mu", 0.1, "", "friction coefficient"),
        Parameter("eta", 3e8, "N s/m", "artificial viscosity"),
        Parameter("v_a", -0.1, "m/s", "initial velocity in the normal tests"),
        Parameter("v_b", 1.0, "m/s", "initial velocity in the shear tests"),
    ),
    variants=_variants(),
    declare=_declare,
    published={
        "Figs. 3-6": "VBOX and PFC2D at dt = 1e-3 s agree with each other and follow the "
        "analytical curves. The relative errors, printed as figures without numbers, grow with "
        "viscosity (T2 above T1, T4 above T3), and the shear tests are said to be less exact "
        "than the normal ones. Both codes use Eqs. 4-12, first order in dt with drag.",
    },
)
