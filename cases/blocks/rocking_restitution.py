"""A leaning block is let go: the rate that its first impact leaves, exact and measured."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from reference_solutions.blocks import rocking
from vv.ask import Displacement, History, Knobs, Method, Run, Velocity
from vv.case import (
    Case,
    EnergyAllowance,
    Exact,
    Ladder,
    Level,
    Measured,
    Measurement,
    Parameter,
    Parameters,
    Quantity,
    Scalar,
    Source,
    Tolerance,
    Trial,
    Variant,
)
from vv.scene import Block, Contact, Scene, Wall, box_geometry, polyhedron_inertia

CENTRE, MOVING = Displacement(1), Velocity(1)
X, Y, Z = np.eye(3)
RATIOS = {"aspect-3": {"concrete": 0.97}, "aspect-5": {"concrete": 0.95, "rubber": 0.67}}
DENSITY, LEAN = 2500.0, 0.5  # kg/m3; of alpha, at the start
STEP = 1e-3  # s


def _block(p: Parameters, lean: float) -> Block:
    """A prism that leans by so much [rad] about its edge at the origin."""
    c, s = math.cos(lean), math.sin(lean)
    axes = np.array([[c, 0.0, -s], [0.0, 1.0, 0.0], [s, 0.0, c]])
    half = np.array([p["b"], p["b"], p["h"]])
    vertices, faces = box_geometry(np.array([-p["b"], 0.0, p["h"]]) @ axes, half, axes)
    mass, inertia = polyhedron_inertia(vertices, faces, DENSITY)
    return Block(
        "block", vertices, faces, mass, inertia, np.zeros(3), free=Y == 0, free_spin=Y != 0
    )


def _declare(variant: str, p: Parameters) -> Trial:
    law = {name: p[name] for name in ("b", "h", "g")}
    if not p["mu"] > p["b"] / p["h"]:
        raise ValueError(f"mu = {p['mu']!r}; a block slips rather than leans up to b/h")
    alpha, rate = rocking.slenderness(**law)
    due = rocking.restitution(p["b"], p["h"])
    first = math.acosh(1.0 / (1.0 - LEAN)) / rate  # of small angles, within a few per cent
    goal = History(STEP * round(1.5 * first / STEP), STEP * 10)
    scene = Scene(
        (Wall(np.zeros(3), Z), _block(p, LEAN * alpha)), Contact(np.inf, mu=p["mu"]),
        gravity=-p["g"] * Z,
    )  # fmt: skip
    height = _lowered(p, LEAN * alpha)

    def kept(run: Run) -> float:
        """By the energy of a turn about a corner, v^2/2 + 3/4 g z, before and after the impact."""
        speed, rise = (run.values[what] for what in (MOVING, CENTRE))
        energy = (speed**2).sum(axis=1) + 1.5 * p["g"] * (rise[:, 2] - height)
        return math.sqrt(max(float(energy[-1]), 0.0) / float(energy[len(energy) // 3]))

    exact = Scalar(
        "restitution", "e", "", "rate of the lean after the first impact over that before", kept,
        due, due, _judge(rate),
    )  # fmt: skip
    study = Ladder(scene, goal, (CENTRE, MOVING), LEVELS)
    weight = sum(block.mass for block in scene.blocks) * p["g"]
    gave = EnergyAllowance(weight * math.hypot(p["b"], p["h"]), {Method.LAGGING: LAGS})
    return Trial(study, (exact, *_measured(variant, due, kept)), gave)


def _lowered(p: Parameters, lean: float) -> float:
    """By how much the centre rises from the start to where the block stands upright [m]."""
    far, alpha = math.hypot(p["b"], p["h"]), math.atan2(p["b"], p["h"])
    return p["h"] - far * math.cos(alpha - lean)


def _judge(rate: float) -> Exact:
    """rate: p [1/s]."""
    step = Tolerance(
        10.0 * (rate * STEP) ** 2,
        "(p dt)^2/12 of the rate a swing, and the impact taken within a step: its height is off by "
        "the way of half a step at most, (p dt)^2 of the energy",
        dt=STEP, order=2, floor=1e-5,
    )  # fmt: skip
    return Exact({Method.SECOND_ORDER: step}, not_judged=SHOWN)


def _measured(variant: str, due: float, kept: Callable[[Run], float]) -> tuple[Quantity, ...]:
    """The measured restitutions of a block, which is Housner's times a printed ratio."""
    return tuple(
        Scalar(
            f"on {base}", "e", "", f"the same, as measured on {base}", kept, None, 1.0,
            Measured(
                Measurement(ratio * due, PRINTED * due, SCATTER * due, CONDITIONS, CITED), None,
                LOOSE,
            ),
        )
        for base, ratio in RATIOS[variant].items()
    )  # fmt: skip


RUNGS = tuple(Knobs(STEP / 2**i, 1e10) for i in range(3))
LEVELS = {Level.QUICK: RUNGS[:2], Level.DEFAULT: RUNGS, Level.PAPER: RUNGS}
SPRUNG = (
    "springs lengthen the impact and give back what they please, by stiffness and step: like "
    "Housner's at 1e10 N/m and 1e-3 s, bouncing at 1e-4 s"
)
SHOWN = {
    **dict.fromkeys((Method.PENALTY, Method.LAGGING), SPRUNG),
    Method.FIRST_ORDER: "it takes an impact at the end of a step",
}
LAGS = Tolerance(
    0.1,
    "as a corner strikes, friction of the iteration before may act along the slip: 0.003 of m g R "
    "was the most that it gave for eight blocks",
    slack="as in the case of rocking, where it gave 0.04",
)
PRINTED, SCATTER = 0.005, 0.01  # of the restitution
CITED = (
    "ElGawady, Ma, Butterworth and Ingham, Effects of interface material on the dynamic behaviour "
    "of rigid blocks, abstract: measured over predicted, to two digits"
)
CONDITIONS = "free rocking of blocks of aspect ratios 3 and 5 on concrete and rubber, laboratory"
LOOSE = (
    "Housner's model has no material: that it loses too little here is a finding on the model, and "
    "others measured less loss than it has, on uneven faces that strike twice"
)
NOTE = (
    "The abstract gives ratios of measured to predicted restitution, 0.97, 0.95 and 0.67, with the "
    "word approximately and without scatter or the formula of the prediction, which is taken to be "
    "Housner's. Reading is half of the last digit, 0.005, and 0.01 stands for the scatter. Sizes "
    "are chosen: restitution does not depend on them, or on gravity. Limestone "
    "blocks of 12 aspect ratios (Vlachakis and others) would be better data; only their abstract "
    "could be read. Others found less loss than Housner's (Ther and Kollar 2017)."
)
FORMULA = "e = 1 - 3/2 sin^2(alpha), tan(alpha) = b/h"
CASE = Case(
    name="rocking-restitution",
    title="Restitution of a rocking block at impact, measured over Housner's",
    source=Source(
        "Housner (1963), The behavior of inverted pendulum structures during earthquakes, Bulletin "
        "of the Seismological Society of America 53(2), 403-417; measured by ElGawady, Ma, "
        "Butterworth and Ingham",
        "10.1785/BSSA0530020403",
        NOTE,
    ),
    parameters=(
        Parameter("b", 0.2, "m", "half the width, and half the depth"),
        Parameter("h", 0.6, "m", "half the height"),
        Parameter("mu", 0.6, "", "friction"),
        Parameter("g", 9.81, "m/s2", "gravity"),
    ),
    variants=(
        Variant("aspect-3", "height three times the width", FORMULA, inert=frozenset({"mu", "g"})),
        Variant(
            "aspect-5", "height five times the width", FORMULA, {"h": 1.0},
            frozenset({"mu", "g"}),
        ),
    ),
    declare=_declare,
)  # fmt: skip
