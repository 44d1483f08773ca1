"""A wedge slides down a groove: the narrower it is, the harder its sides are pressed."""

from __future__ import annotations

import functools
import math

import numpy as np

from cases._papers import YAGODA_BIRAN_2016
from reference_solutions.blocks import wedge
from vv.ask import Displacement, History, Knobs, Method
from vv.case import (
    Case,
    Check,
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
from vv.scene import Block, Contact, Scene, Vector, Wall, polyhedron_inertia

WEDGE = Displacement(2)
HALF, DENSITY = 0.5, 2500.0  # m, half of its width on top, height and length; kg/m3
OUTLINE = ((0, 1, 2, 3), (7, 6, 5, 4), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0))
LAW = ("dip", "xi", "g")
GOAL = History(1.0, 0.02)


def _axes(dip: float) -> Vector:
    """Rows: down the groove, across it, and out of it."""
    i = math.radians(dip)
    return np.array([[math.cos(i), 0, -math.sin(i)], [0, 1, 0], [math.sin(i), 0, math.cos(i)]])


def _friction(p: Parameters) -> float:
    """The coefficient that holds a part of what pulls the wedge down."""
    return p["held"] * math.tan(math.radians(p["dip"])) / wedge.pressing(p["xi"])


def _scene(p: Parameters) -> Scene:
    """Two walls, and between them a wedge cut off below, so that its size stays as xi falls."""
    axes, h = _axes(p["dip"]), p["xi"] / 2
    foot = HALF - HALF * math.tan(h)
    cut = np.array([[-foot, -HALF], [foot, -HALF], [HALF, 0.0], [-HALF, 0.0]])
    vertices = np.array([along * axes[0] + point @ axes[1:] for along in (HALF, -HALF)
                         for point in cut])  # fmt: skip
    mass, inertia = polyhedron_inertia(vertices, OUTLINE, DENSITY)
    free, still = np.ones(3, bool), np.zeros(3, bool)
    block = Block("wedge", vertices, OUTLINE, mass, inertia, np.zeros(3), free, still)
    walls = [
        Wall(side * HALF * axes[1], -side * math.cos(h) * axes[1] + math.sin(h) * axes[2])
        for side in (1.0, -1.0)
    ]
    gravity = np.array([0.0, 0.0, -p["g"]])
    return Scene((*walls, block), Contact(np.inf, mu=_friction(p)), gravity=gravity, axes=axes)


def _declare(variant: str, p: Parameters) -> Trial:
    if not p["xi"] < math.pi / 2:
        raise ValueError(f"xi = {p['xi']!r} rad; beyond pi/2 nothing is left of its foot")
    scene = _scene(p)
    law = {name: p[name] for name in LAW}
    s = Series(
        name="s",
        symbol="s",
        unit="m",
        meaning="displacement down the groove",
        observe=lambda run: np.asarray(run.values[WEDGE] @ scene.axes[0]),
        reference=functools.partial(wedge.slid, mu=_friction(p), **law),
        judge=_judge(p["xi"]),
        still=0.5 * p["g"] * GOAL.duration**2,
    )
    return Trial(Ladder(scene, GOAL, (WEDGE,), LEVELS), (s,))


def _judge(xi: float) -> Exact:
    """Springs sink by N/kn into either side, and the wedge by 1/sin(xi/2) as much."""
    sinks = 5e-4 / xi**2
    second = Tolerance(
        1e-10 if xi > 0.05 else 1e-5,
        "constant forces are integrated exactly; contacts are solved to 1e-12 m/s, which a narrow "
        "groove magnifies by 1/sin(xi/2) more than once",
        dt=1e-2,
        order=0,
        slack="in wide grooves only rounding errors remain",
    )
    rigid = {
        Method.EXACT: Tolerance(1e-12, "the answer is a parabola, known to rounding"),
        Method.SECOND_ORDER: second,
        Method.FIRST_ORDER: Tolerance(
            1e-2,
            "a start half a step off is one of dt/2 over a second, and as much again",
            dt=1e-2,
            order=1,
            slack="forces are constant: a start that is not off leaves rounding errors only",
        ),
    }
    if xi < 0.05:
        return Exact(rigid, not_judged={Method.PENALTY: SUNK, Method.LAGGING: SUNK})
    return Exact({
        **rigid,
        Method.PENALTY: Tolerance(
            sinks, "the wedge sinks by N/(kn sin(xi/2)), which swings, and its friction with it",
            kn=1e9, softness=0.5,
        ),
        Method.LAGGING: Tolerance(
            6e-2, "friction is that of the iteration before, while the wedge sinks and swings",
        ),
    })  # fmt: skip


SUNK = "springs let the wedge sink by W/(4 kn sin^2(xi/2)): in a narrow groove it falls through"
RUNGS = (Knobs(1e-2, 1e9), Knobs(5e-3, 1e9), Knobs(5e-3, 1e10), Knobs(2.5e-3, 1e10))
LEVELS = {Level.QUICK: RUNGS[:2], Level.DEFAULT: RUNGS[:3], Level.PAPER: RUNGS}
FORMULA = "s'' = g (sin i - mu cos i/sin(xi/2)), N = W cos i/(2 sin(xi/2))"
CASE = Case(
    name="wedge",
    title="A wedge in a narrow groove",
    source=Source(
        *YAGODA_BIRAN_2016,
        "Gravity alone; the opening is chosen, and friction such that half of what pulls the wedge "
        "down is left. It cannot turn.",
    ),
    parameters=(
        Parameter("dip", 30.0, "degrees", "how steeply the groove falls"),
        Parameter("xi", 1.0, "rad", "angle between the sides of the groove"),
        Parameter("held", 0.5, "", "part of the pull that friction takes"),
        Parameter("g", 9.81, "m/s2", "gravity"),
    ),
    variants=tuple(
        Variant(f"xi-{xi:g}", f"sides that open by {xi:g} rad", FORMULA, {"xi": xi},
                frozenset({"xi"}), Level.QUICK if xi in (1.0, 1e-6) else Level.DEFAULT)
        for xi in (1.0, 0.1, 0.01, 1e-6)
    ),
    declare=_declare,
    # at 1e-6 rad what is left of impulses moves by 5e-7 as a processor fuses products or not
    enforced=frozenset(Check) - {Check.REGRESSION},
)  # fmt: skip
