"""A block under a constant force with kinetic damping: each step keeps a part of its velocity."""

from __future__ import annotations

import numpy as np

from cases._papers import YAGODA_BIRAN_2016
from reference_solutions.blocks.implicit_step import damped_drive
from vv.ask import Displacement, History, Knobs, Method, Run
from vv.case import (
    Case,
    Exact,
    Ladder,
    Level,
    Parameter,
    Parameters,
    Scalar,
    Shown,
    Source,
    Tolerance,
    Trial,
    Variant,
)
from vv.scene import Block, Contact, Scene, box_geometry, polyhedron_inertia

BLOCK = Displacement(0)
X = np.array([1.0, 0.0, 0.0])
STEPS = (1e-2, 1e-3, 1e-4, 1e-5)  # of the duration
UNUSED = 1e8  # N/m: nothing touches


def _declare(variant: str, p: Parameters) -> Trial:
    vertices, faces = box_geometry(np.zeros(3), np.full(3, 0.5), np.eye(3))
    mass, inertia = polyhedron_inertia(vertices, faces, 2500.0)
    free, still = np.array([True, False, False]), np.zeros(3, bool)
    block = Block("block", vertices, faces, mass, inertia, np.zeros(3), free, still)
    scene = Scene((block,), Contact(np.inf), gravity=p["a"] * X)
    if not (p["t"] > 0.0 and p["a"] > 0.0):
        raise ValueError(f"a = {p['a']!r} m/s2, t = {p['t']!r} s; both must be positive")
    rungs = tuple(Knobs(part * p["t"], UNUSED, p["dd"]) for part in STEPS)
    levels = {Level.QUICK: rungs[:2], Level.DEFAULT: rungs, Level.PAPER: rungs}
    study = Ladder(scene, History(p["t"], STEPS[-1] * p["t"]), (BLOCK,), levels)

    def due(run: Run) -> float:
        return damped_drive(p["a"], float(run.times[1]), len(run.times) - 1, p["dd"])

    whole = 0.5 * p["a"] * p["t"] ** 2
    return Trial(
        study,
        (
            Scalar("way", "d/d_N", "", "displacement of the block over that of damped steps",
                   lambda run: _displacement(run) / due(run), 1.0, 1.0, _summed_bounds(p["dd"])),
            Scalar("d", "d", "m", "displacement of the block", _displacement, None, 1.0,
                   Shown(VANISHES)),
            Scalar("of a t^2/2", "2d/at^2", "", "displacement of the block over the right one",
                   lambda run: _displacement(run) / whole, None, 1.0, Shown(VANISHES)),
        ),
    )  # fmt: skip


def _displacement(run: Run) -> float:
    return float(run.values[BLOCK][-1] @ X)


def _summed_bounds(dd: float) -> Exact:
    """The bounds: a velocity that steps pass on keeps the rounding error of each of them."""
    handed_on = min(1.0 / STEPS[-1], 1.0 / (1.0 - dd)) if dd < 1.0 else 1.0 / STEPS[-1]
    summed = Tolerance(1e-12 + EPS * handed_on, SUMMED)
    return Exact(
        {Method.PENALTY: summed, Method.LAGGING: summed}, not_judged={Method.FIRST_ORDER: LEAPS}
    )


EPS = float(np.finfo(float).eps)
SUMMED = (
    "the reference is the sum of the steps in closed form. Rounding errors of velocities remain, "
    "of which each step passes on the part dd: 1/(1 - dd) of them add up"
)
LEAPS = (
    "schemes of first order may pass on the velocity in the middle of a step: with damping they "
    "move 2/(1 + r) times as far"
)
VANISHES = (
    "with damping the velocity tends to a dt r/(1 - r), so that the displacement vanishes with the "
    "step: a t dt (1 + r)/(2 (1 - r)), where a t^2/2 is right"
)
WAY = "d_N = a dt^2 (N/2 + r/(1-r) (N - (1-r^N)/(1-r)))"
CASE = Case(
    name="kinetic-damping",
    title="Kinetic damping",
    source=Source(
        *YAGODA_BIRAN_2016,
        "Sec. 5.2.2, Fig. 25: the displacement of a mass under constant force with 3 % kinetic "
        "damping, a dynamic parameter of 0.97. The force is not given: 1 m/s2 for 1 s is chosen. "
        "Codes whose steps pass on all of the velocity refuse.",
    ),
    parameters=(
        Parameter("dd", 0.97, "", "fraction of the velocity that is kept from step to step, r"),
        Parameter("a", 1.0, "m/s2", "acceleration by the force without damping"),
        Parameter("t", 1.0, "s", "time simulated"),
    ),
    variants=(
        Variant("3-per-cent", "a step loses 3 % of the velocity", WAY),
        Variant(
            "1-per-cent", "a step loses 1 % of the velocity", WAY, {"dd": 0.99}, level=Level.DEFAULT
        ),
    ),
    declare=_declare,
    published={"Sec. 5.2.2": "3 % or 1 % at 1e-5 s: 'did not change the results significantly'."},
)  # fmt: skip
