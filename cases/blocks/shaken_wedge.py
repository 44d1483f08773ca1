"""A wedge slides down a groove while a sine shakes it, along the groove or horizontally."""

from __future__ import annotations

import dataclasses
import functools
import math
from collections.abc import Callable

import numpy as np

from cases._papers import YAGODA_BIRAN_2016
from cases.hard.wedge import CASE as WEDGE
from cases.hard.wedge import WEDGE as MOVED
from reference_solutions.hard import shaken_wedge
from reference_solutions.hard.wedge import pressing
from vv.ask import History, Knobs, Method
from vv.case import (
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
from vv.scene import Contact, Harmonic, Scene, Vector

OUTPUTS = 300


def _scene(variant: str, p: Parameters) -> Scene:
    """The groove and the wedge of the case `wedge`, with this friction and a sine."""
    still = WEDGE.declare("xi-1", {**WEDGE.defaults("xi-1"), "dip": p["dip"], "xi": p["xi"]})
    scene = still.study.scene
    along = scene.axes[0] if variant == "along" else np.array([1.0, 0.0, 0.0])
    strength, frequency = np.array([p["A"], 0.0, 0.0]), np.array([p["f"], 0.0, 0.0])
    up = np.array([0.0, 0.0, 1.0])
    across = np.array([0.0, 1.0, 0.0])
    axes = np.array([along, across, np.cross(along, across)])
    return dataclasses.replace(
        scene,
        contact=Contact(np.inf, mu=_mu(p)),
        gravity=-p["g"] * up,
        shaking=Harmonic(strength, frequency, axes=axes),
    )


def _mu(p: Parameters) -> float:
    return math.tan(math.radians(p["phi"]))


def _declare(variant: str, p: Parameters) -> Trial:
    held, falls = pressing(p["xi"]) * _mu(p), math.tan(math.radians(p["dip"]))
    if held >= falls:
        raise ValueError(
            f"phi = {p['phi']!r} degrees; friction in the groove, {held:.4g}, holds a wedge at a "
            f"slope of {falls:.4g}, and how a wedge at rest shares its friction between the sides "
            "is not determined"
        )
    scene, goal = _scene(variant, p), History(p["duration"], p["duration"] / OUTPUTS)
    law = {name: p[name] for name in ("dip", "xi", "A", "f", "g")}
    path = functools.partial(SOLUTIONS[variant], mu=_mu(p), **law)
    s = Series(
        name="s",
        symbol="s",
        unit="m",
        meaning="displacement down the groove",
        observe=ComponentAlong(MOVED, scene.axes[0]),
        reference=path,
        judge=_judge(p, scene.blocks[0].mass, path),
        still=0.5 * p["g"] * p["duration"] ** 2,
    )
    return Trial(Ladder(scene, goal, (MOVED,), LEVELS), (s,))


SOLUTIONS: dict[str, Callable[..., Vector]] = {
    "along": shaken_wedge.along,
    "level": shaken_wedge.level,
}


def _judge(p: Parameters, mass: float, path: Callable[[Vector], Vector]) -> Exact:
    """The bounds of each class; springs cause an error of speed, so one that grows with time."""
    way = float(np.abs(path(np.linspace(0.0, p["duration"], OUTPUTS))).max())
    sprung, stepped = _missing_speed(p, mass) * p["duration"] / way, _integrated(p, way)
    late = _whole_steps(p, way, stepped)
    return Exact(
        {
            Method.EXACT: Tolerance(1e-12, "rounding errors of a few located events"),
            Method.SECOND_ORDER: stepped,
            Method.FIRST_ORDER: Tolerance(
                1e-5, "slip begins and ends on whole steps, an error of the speed of at most a dt",
                dt=1e-3, order=1, slack="a slip may end anywhere within a step",
                least=lambda dt: late.uncut(Knobs(dt)),
            ),
            Method.STRAIGHT: late,
            Method.PENALTY: Tolerance(
                max(sprung, LOCATED),
                "when slip begins, the shear springs release the force that they bore across the "
                "groove, and the wedge oscillates on its sides: friction is missing for up to 1/w "
                "of that oscillation. A step changes the speed that the sine causes, up to A/w, by "
                "a part of 7/12 (w dt)^2 at most, that of generalised alpha which damps most",
                kn=SPRING, softness=0.5, least=lambda dt: 7 / 2 * stepped.uncut(Knobs(dt)),
                slack="springs that start charged with the weight, in a step that is cut where "
                "slip stops, leave hardly any oscillation",
            ),
        },
        not_judged={Method.LAGGING: SETTLES},
    )  # fmt: skip


def _whole_steps(p: Parameters, way: float, stepped: Tolerance) -> Tolerance:
    """For slip that begins and ends on whole steps; way: the largest displacement [m]."""
    w, cycles = 2 * math.pi * p["f"], p["f"] * p["duration"]
    late = p["A"] * (1 + _mu(p) * pressing(p["xi"])) * (w * p["duration"] + cycles) / 2 * STEP**2
    return Tolerance(
        late / way + stepped.value,
        "in each period slip begins up to a step late, as the force crosses friction at a rate A w "
        "(1 + K mu): an error of the speed of half of that times dt^2, for up to a period; and it "
        "ends up to a step late, an error of A (1 + K mu) dt^2/2. Between, the sine is integrated "
        "to second order",
        dt=STEP, order=2, floor=LOCATED,
        slack="one step may begin where slip does",
    )  # fmt: skip


def _integrated(p: Parameters, way: float) -> Tolerance:
    """For located events; way: the largest displacement [m]."""
    w = 2 * math.pi * p["f"]
    pushed = p["A"] * (1 + _mu(p) * pressing(p["xi"])) * p["duration"] / w  # m
    return Tolerance(
        max(float(pushed / way * (w * STEP) ** 2 / 6), LOCATED),
        "the trapezoidal rule gives the speed that the sine and its friction cause, up to "
        "A (1 + K mu)/w, an error of (w dt)^2/12; twice that is allowed for the whole duration. "
        "Events are located within the step",
        dt=STEP, order=2, floor=LOCATED,
    )  # fmt: skip


def _missing_speed(p: Parameters, mass: float) -> float:
    """The speed [m/s] that all of friction takes in the time 1/w of the wedge's oscillation.

    While the wedge sticks, shear springs across the sides bear cos^2(xi/2) of the pressing force.
    When it slips, the springs along the normals, CORNERS of kn sin^2(xi/2) out of the groove, take
    that over, and the wedge oscillates about its new equilibrium.
    """
    dip, half = math.radians(p["dip"]), math.sin(p["xi"] / 2)
    presses = p["g"] * math.cos(dip) + p["A"] * math.sin(dip)
    return _mu(p) * pressing(p["xi"]) * presses / (half * math.sqrt(CORNERS * SPRING / mass))


STEP, LOCATED = 1e-3, 1e-9  # s; what the search for an event leaves
CORNERS, SPRING = 8, 1e9  # corners of the wedge on both sides; stiffness of its bound [N/m]
SETTLES = (
    "formulations of this class may let gravity act before the shaking starts, and here gravity "
    "alone makes the wedge slide; lagging friction also misses the pressure of the two sides"
)
RUNGS = (Knobs(1e-3, 1e9), Knobs(5e-4, 1e9), Knobs(2.5e-4, 1e9), Knobs(1e-4, 1e10))
# at two steps on the softer springs and one on the stiffer, of which an order is fitted
LEVELS = {Level.QUICK: RUNGS[:2], Level.DEFAULT: (*RUNGS[:2], RUNGS[-1]), Level.PAPER: RUNGS}
CASE = Case(
    name="shaken-wedge",
    title="A wedge in a groove under a sine",
    source=Source(
        *YAGODA_BIRAN_2016,
        "The sine acts along the line of intersection in Sec. 4.4, and horizontally in Fig. 16: "
        "both are here. The opening angle, amplitude and frequency are not given: 1.5 rad, 2 m/s2 "
        "and 1 Hz are chosen. The wedge is symmetric and cannot turn.",
    ),
    parameters=(
        Parameter("dip", 30.0, "degrees", "inclination of the groove"),
        Parameter("phi", 20.0, "degrees", "friction angle"),
        Parameter("xi", 1.5, "rad", "angle between the sides of the groove"),
        Parameter("A", 2.0, "m/s2", "amplitude of the acceleration"),
        Parameter("f", 1.0, "Hz", "its frequency"),
        Parameter("g", 9.81, "m/s2", "gravity"),
        Parameter("duration", 3.0, "s", "time simulated"),
    ),
    variants=(
        Variant(
            "along", "the sine acts along the groove",
            "s'' = g (sin i - K mu cos i) + A sin wt, K = 1/sin(xi/2)",
        ),
        Variant(
            "level", "the sine acts horizontally",
            "s'' = g sin i + a cos i - K mu (g cos i - a sin i), a = A sin wt",
        ),
    ),
    declare=_declare,
    published={"Fig. 16": "3D-DDA under a sine: below 7 % for the entire simulation."},
)  # fmt: skip
