"""A closed contact at steps just below and beyond the largest stable one."""

from __future__ import annotations

import dataclasses
import math

import numpy as np

from reference_solutions import stability
from vv.ask import Displacement, History, Knobs
from vv.case import (
    Case,
    Interval,
    Parameter,
    Parameters,
    Scalar,
    Shown,
    Source,
    Trial,
    Variant,
)
from vv.scene import Contact, Scene, Spheres, Wall
from vv.study import Ladder, Level

RADIUS = 50.0  # m; does not enter the answer
SPHERE = Displacement(1)
X, Y, _ = np.eye(3)


def _scene(p: Parameters) -> Scene:
    """A sphere pressed into a wall, free along it; its shear spring holds far beyond its swing."""
    sphere = Spheres(
        position=np.zeros((1, 3)),
        velocity=p["v"] * Y[None],
        radius=np.array([RADIUS]),
        mass=np.array([p["m"]]),
        free=np.array([[False, True, False]]),
    )
    wall = Wall((p["dx"] - RADIUS) * X, X)
    return Scene((wall, sphere), Contact(p["kn"], p["ks"], p["mu"]), p["eta"])


def _declare(variant: str, p: Parameters) -> Trial:
    w, n = math.sqrt(p["ks"] / p["m"]), p["eta"] / (2 * p["m"])
    free, late = stability.centred(w), stability.lagged(w, n)
    dt = {
        "undamped": (0.9 * free, NEAR * free),
        "undamped-beyond": (free / NEAR,),
        "viscous": (0.9 * late, NEAR * late),
        "viscous-beyond": (late / NEAR, NEAR * free),
    }[variant]
    steps = 400 if n > 0 else 24  # drag makes an unstable swing grow as much more slowly
    rungs = tuple(Knobs(one) for one in dt)
    goal = History(steps * free, late / 4)
    study = Ladder(_scene(p), goal, (SPHERE,), dict.fromkeys(Level, rungs))
    return Trial(study, ((_decades if variant.endswith("beyond") else _reach)(p["v"] / w),))


def _reach(swing: float) -> Scalar:
    """How far it swings, over what it would without steps and drag [m]."""
    return Scalar(
        name="reach",
        symbol="max|y| w/v",
        unit="",
        meaning="largest displacement over that of the exact swing without drag",
        observe=lambda run: float(np.abs(run.values[SPHERE] @ Y).max() / swing),
        reference=None,
        scale=1.0,
        judge=BOUNDED,
    )


def _decades(swing: float) -> Scalar:
    """The same in powers of ten: what an instability makes of it, from rounding on."""
    reach = _reach(swing)
    return dataclasses.replace(
        reach,
        name="decades",
        symbol="lg(max|y| w/v)",
        meaning=f"logarithm to base ten of the {reach.meaning}",
        observe=lambda run: math.log10(reach.observe(run)),
        judge=SHOWN,
    )


NEAR = 0.99
BOUNDED = Interval(
    0.01,
    7.2,
    "a stable leapfrog swings up to 1/sqrt(1 - (w dt/2)^2) times as far as the exact motion, 7.1 "
    "times at 0.99 of its limit; drag makes it less, lagged drag of a large step 0.03 at least",
)
SHOWN = Shown(
    "beyond the limit an explicit scheme grows until friction gives way, or refuses the step; "
    "drag at the velocity before lowers the limit, drag at the middle does not"
)
SWING = "m y'' = -ks y - eta y', |y| <= v/w; a stable leapfrog: |y| <= v/(w sqrt(1 - (w dt/2)^2))"
UNDAMPED = frozenset({"eta"})
CASE = Case(
    name="stable-step",
    title="Largest stable step",
    source=Source(
        "Li, Yin, Jia, Zhang, Wang and Xu (2018), Validation Tests for Discrete Element Codes "
        "Using Single-Contact Systems, International Journal of Geomechanics",
        "10.1061/(ASCE)GM.1943-5622.0001133",
        "The limits are not in the paper: 2/w, and 2 (sqrt(n^2 + w^2) - n)/w^2 for the drag of its "
        "Eqs. 9-12, 0.0822797 s with the numbers of T2. Steps are these limits times and over "
        "0.99.",
    ),
    parameters=(
        Parameter("m", 21650635.0946, "kg", "mass"),
        Parameter("kn", 5.5e9, "N/m", "normal contact stiffness"),
        Parameter("ks", 5.5e9, "N/m", "shear contact stiffness"),
        Parameter("mu", 0.1, "", "friction coefficient"),
        Parameter("dx", 0.5, "m", "overlap with the wall"),
        Parameter("eta", 3e8, "N s/m", "artificial viscosity"),
        Parameter("v", 1e-6, "m/s", "velocity at the start"),
    ),
    variants=(
        Variant("undamped", "up to 0.99 times 2/w", SWING, {"eta": 0.0}),
        Variant("undamped-beyond", "2/w over 0.99", SWING, {"eta": 0.0}),
        Variant("viscous", "up to 0.99 times the limit of lagged drag", SWING),
        Variant("viscous-beyond", "beyond that limit, and 0.99 times 2/w", SWING),
    ),
    declare=_declare,
)
