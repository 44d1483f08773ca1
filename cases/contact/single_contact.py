"""Single contacts T1-T4 of Li et al. (2018): a normal and a shear spring, with and without drag."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Callable, Mapping

import numpy as np

from cases._papers import LI_2018
from cases.contact.parts import _single_contact_bounds as bounds
from cases.contact.parts._single_contact_bounds import OVERLAP
from reference_solutions.contact import single_contact as closed
from vv.ask import Displacement, History, Knobs
from vv.case import (
    Case,
    ComponentAlong,
    Ladder,
    Level,
    Parameter,
    Parameters,
    Series,
    Source,
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
        depth, name = abs(p["v_a"]) / bounds.rates(test, p)[0], "v_a"
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
        judge=bounds.judge(variant.partition("-")[0], p),
    )
    goal = History(bounds.DURATION, interval=1e-3)
    parts = bounds.parts(variant.partition("-")[0], p)
    levels = {level: _divided(rungs, parts) for level, rungs in LEVELS.items()}
    timed = _divided(TIMED, parts) if variant in REFERENCES else ()
    return Trial(Ladder(scene, goal, (shown,), levels, timed), (y,))


def _divided(rungs: tuple[Knobs, ...], parts: int) -> tuple[Knobs, ...]:
    return tuple(Knobs(dt=(knobs.dt or 0.0) / parts) for knobs in rungs)


RUNGS = tuple(Knobs(dt=dt) for dt in (bounds.COARSEST, 2e-3, 1e-3, 5e-4, 1e-4, 1e-5))
TIMED = (RUNGS[0], *RUNGS[3:5])
LEVELS = {Level.QUICK: RUNGS[1:5:2], Level.DEFAULT: RUNGS, Level.PAPER: RUNGS}


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
