"""The restitution of a rocking block at its first impact, exact and measured."""

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
DENSITY, LEAN = 2500.0, 0.5  # kg/m3; initial lean over alpha
STEP = 1e-3  # s
LEAST = 0.1  # restitution: after an impact the block rises for a twentieth of its fall then


def _block(p: Parameters, lean: float) -> Block:
    """A prism that leans by `lean` [rad] about its edge at the origin."""
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
        raise ValueError(
            f"mu = {p['mu']!r}; it must exceed b/h, or the block slips instead of leaning"
        )
    alpha, rate = rocking.slenderness(**law)
    due = rocking.restitution(p["b"], p["h"])
    if not due >= LEAST:
        raise ValueError(
            f"b/h = {p['b'] / p['h']:.4g}; of its rate {due:.3g} remains after an impact, so that "
            f"impacts hardly differ in time; {LEAST} is needed"
        )
    first, again = _fall(LEAN), 1.0 - math.sqrt(1.0 - due**2 * LEAN * (2.0 - LEAN))
    ends = first + min(first / 2.0, _fall(again))  # before the second impact
    goal = History(STEP * round(ends / rate / STEP), STEP * 10)
    scene = Scene(
        (Wall(np.zeros(3), Z), _block(p, LEAN * alpha)), Contact(np.inf, mu=p["mu"]),
        gravity=-p["g"] * Z,
    )  # fmt: skip
    height = _lowered(p, LEAN * alpha)

    def kept(run: Run) -> float:
        """From the energy of rotation about a corner, v^2/2 + 3/4 g z, before and after impact."""
        speed, rise = (run.values[what] for what in (MOVING, CENTRE))
        energy = (speed**2).sum(axis=1) + 1.5 * p["g"] * (rise[:, 2] - height)
        return math.sqrt(max(float(energy[-1]), 0.0) / float(energy[len(energy) // 3]))

    exact = Scalar(
        "restitution", "e", "", "rate of the lean after the first impact over that before", kept,
        due, due, _judge(rate, due),
    )  # fmt: skip
    study = Ladder(scene, goal, (CENTRE, MOVING), LEVELS)
    weight = sum(block.mass for block in scene.blocks) * p["g"]
    gave = EnergyAllowance(weight * math.hypot(p["b"], p["h"]), {Method.LAGGING: LAGS})
    return Trial(study, (exact, *_measured(variant, due, kept)), gave)


def _fall(lean: float) -> float:
    """The time of a fall from a lean over alpha, times p: for small angles, else 5 % less."""
    return math.acosh(1.0 / (1.0 - lean))


def _lowered(p: Parameters, lean: float) -> float:
    """The height of the centre of the upright block over that at the start [m]."""
    far, alpha = math.hypot(p["b"], p["h"]), math.atan2(p["b"], p["h"])
    return p["h"] - far * math.cos(alpha - lean)


def _judge(rate: float, due: float) -> Exact:
    """rate: p [1/s]; due: the restitution."""
    step = Tolerance(
        max(10.0, 0.5 / due**2) * (rate * STEP) ** 2,
        "the step changes the rate by (p dt)^2/12 a swing. The impact is located within a step: "
        "the error of its height is at most the displacement in half a step, (p dt)^2 of the "
        "energy, of which the square of the restitution remains",
        dt=STEP, order=2, floor=1e-5,
    )  # fmt: skip
    return Exact({Method.SECOND_ORDER: step}, not_judged=SHOWN)


def _measured(variant: str, due: float, kept: Callable[[Run], float]) -> tuple[Quantity, ...]:
    """The measured restitutions of a block: Housner's times the printed ratio."""
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
    "on springs an impact takes time, and its restitution depends on stiffness and step: it is "
    "like Housner's at 1e10 N/m and 1e-3 s, but the block bounces at 1e-4 s"
)
SHOWN = {
    **dict.fromkeys((Method.PENALTY, Method.LAGGING), SPRUNG),
    Method.FIRST_ORDER: "this class places an impact at the end of a step",
}
LAGS = Tolerance(
    0.1,
    "when a corner strikes, friction of the previous iteration may act in the direction of slip "
    "and add energy: at most 0.003 m g R was found for eight blocks",
    slack="the same bound as in the case rocking, where it added 0.04 m g R",
)
PRINTED, SCATTER = 0.005, 0.01  # of the restitution
CITED = (
    "ElGawady, Ma, Butterworth and Ingham, Effects of interface material on the dynamic behaviour "
    "of rigid blocks, abstract: measured over predicted, to two digits"
)
CONDITIONS = "free rocking of blocks of aspect ratios 3 and 5 on concrete and rubber, laboratory"
LOOSE = (
    "Housner's model has no material. That blocks lose more here is a finding on the model; others "
    "measured less loss than Housner's, on uneven faces that strike twice"
)
NOTE = (
    "The abstract gives ratios of measured to predicted restitution, 0.97, 0.95 and 0.67, as "
    "approximate, without scatter and without the formula of the prediction, which is taken to be "
    "Housner's. The uncertainty of reading is half of the last digit, 0.005, and 0.01 stands for "
    "the scatter. Sizes are chosen: restitution depends neither on them nor on gravity. Limestone "
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
