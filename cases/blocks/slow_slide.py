"""A block slides so slowly that friction stops it within a few steps of a solver."""

from __future__ import annotations

import functools
import math

import numpy as np

from cases._papers import YAGODA_BIRAN_2016
from reference_solutions.blocks import incline
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
from vv.scene import Block, Contact, Scene, Wall, box_geometry, polyhedron_inertia

BLOCK = Displacement(1)
HALF = np.array([0.5, 0.5, 0.1])  # m; a plate hardly tips as friction pulls at its base
FEW, MANY = 3.4, 102.0  # steps to the stop at the coarsest setting
ROUNDING = 1e-11  # of some hundred steps
EPS = float(np.finfo(float).eps)
FOUND = 1e-4  # of a step: how exactly the stop is to be found
WATCHED = 4  # times as long as it slides, so that later creep is seen
STIFF = (1e9, 1e10)  # N/m
SPRUNG = (Method.PENALTY, Method.LAGGING)
SOFT = "shear springs stretch by a part of the slide that is too large to judge what is left"
RESTS, SHEAR = 4, 25.0  # corners; ks over kn of springs that stand for rigid contact


def _deceleration(p: Parameters) -> float:
    """The deceleration: friction less the pull of gravity down the slope [m/s2]."""
    alpha = math.radians(p["alpha"])
    return p["g"] * (p["mu"] * math.cos(alpha) - math.sin(alpha))


def _scene(p: Parameters, turns: bool) -> Scene:
    alpha = math.radians(p["alpha"])
    c, s = math.cos(alpha), math.sin(alpha)
    axes = np.array([[c, 0.0, -s], [0.0, 1.0, 0.0], [s, 0.0, c]])
    vertices, faces = box_geometry(HALF[2] * axes[2], HALF, axes)
    mass, inertia = polyhedron_inertia(vertices, faces, p["m"] / (8 * HALF.prod()))
    block = Block(
        "block", vertices, faces, mass, inertia, velocity=p["v0"] * axes[0],
        free=np.array([True, turns, True]), free_spin=np.full(3, turns),
    )  # fmt: skip
    gravity = np.array([0.0, 0.0, -p["g"]])
    wall = Wall(np.zeros(3), axes[2])
    return Scene((wall, block), Contact(np.inf, mu=p["mu"]), gravity=gravity, axes=axes)


def _declare(variant: str, p: Parameters) -> Trial:
    slows = _deceleration(p)
    if not slows > 0 or not p["v0"] > 0:
        raise ValueError(
            f"v0 = {p['v0']!r} m/s, mu = {p['mu']!r}, alpha = {p['alpha']!r} deg; the block must "
            "move, and friction must stop it"
        )
    if not p["mu"] * HALF[2] < HALF[0] / 2:
        raise ValueError(f"mu = {p['mu']!r}; the plate would tip")
    turns = variant != "held"
    count, stop = FEW if turns else MANY, p["v0"] / slows
    first, scene = stop / count, _scene(p, turns)
    rungs = tuple(Knobs(first / part, kn) for kn in STIFF[not turns :] for part in (1, 2))
    law = {name: p[name] for name in ("alpha", "g", "v0")}
    s = Series(
        name="s",
        symbol="s",
        unit="m",
        meaning="displacement along the slope",
        observe=ComponentAlong(BLOCK, scene.axes[0]),
        reference=functools.partial(
            incline.newmark, phi=math.degrees(math.atan(p["mu"])), A=0.0, f=1.0, **law
        ),
        judge=_judge(p, stop, count, turns),
    )
    levels = {Level.QUICK: rungs[:2], Level.DEFAULT: rungs, Level.PAPER: rungs}
    each = stop / FEW  # the longest of all steps
    goal = History(round(WATCHED * FEW) * each, each)
    return Trial(Ladder(scene, goal, (BLOCK,), levels), (s,))


def _judge(p: Parameters, stop: float, count: float, turns: bool) -> Exact:
    """stop: the time until the block stops [s]; count: that time in the longest steps."""
    way, points = 0.5 * p["v0"] * stop, RESTS if turns else 1
    friction = p["mu"] * p["m"] * p["g"] * math.cos(math.radians(p["alpha"]))
    stretch = friction / (points * SHEAR * STIFF[0])
    leaning = friction * HALF[2] ** 2 / (RESTS * STIFF[0] * HALF[0] ** 2) if turns else 0.0
    late = 0.25 / (count * stop)
    rounding = max(ROUNDING, 4 * EPS * float(HALF.max()) / way if turns else 0.0)
    softer, stiffer = 2.5 * (stretch + leaning) / way, STIFF[0] / STIFF[-1]
    springs = Tolerance(
        softer * stiffer,
        "shear springs start slack, stretch by mu N/ks and swing back when the block stops; so "
        "does the block, which leans under friction at its base. The step in which it stops ends "
        "at rest: the displacement that is left then is a(dt/2)^2/2 at most, (dt/T)^2/4 of the "
        "whole",
        kn=STIFF[-1], softness=1, late=late,
    )  # fmt: skip
    soft = softer * (1.0 if turns else stiffer) > LARGEST_TOLERANCE
    return Exact({
        Method.EXACT: Tolerance(1e-12, "one event, located to rounding"),
        Method.SECOND_ORDER: Tolerance(
            max((FOUND / count) ** 2, rounding),
            "the trapezoidal rule follows a parabola, so that only the stop can be missed. The "
            "case demands that it is found to 1e-4 of its step, by which an error of (1e-4 dt/T)^2 "
            "of the displacement is left: a demand and no estimate, which tells schemes that find "
            "the stop from those that end the step at rest and are off by (dt/T)^2/4. Its floor is "
            "the rounding of the block's position and corners",
            dt=stop / count,
            order=2,
            floor=rounding,
        ),
        Method.STRAIGHT: Tolerance(
            0.25 / count**2,
            "the step in which the block stops ends at rest: the displacement that is left then is "
            "a(dt/2)^2/2 at most, (dt/T)^2/4 of the whole",
            dt=stop / count,
            order=2,
            slack="a step that is cut where the block stops leaves nothing",
        ),
        Method.FIRST_ORDER: Tolerance(
            1e-9, "friction acts with its value at the end of a step: an error of up to dt/T of "
            "the displacement", late=1 / stop,
            slack="forces in the middle of a step, and a stop at its end, leave rounding errors",
        ),
        **(dict.fromkeys(SPRUNG, springs) if not soft else {}),
    }, not_judged=dict.fromkeys(SPRUNG, SOFT) if soft else {})  # fmt: skip


CASE = Case(
    name="slow-slide",
    title="A slow slide stops in a few steps",
    source=Source(
        *YAGODA_BIRAN_2016,
        "The paper's block on a slope, launched along it; mass, speed and slope are chosen. The "
        "block stops after 3.4 and 6.8 steps where it may turn, and after 102 and 204 where it may "
        "not, so that explicit codes can run it; it is observed for four times as long.",
    ),
    parameters=(
        Parameter("m", 3389.0, "kg", "mass of the block"),
        Parameter("mu", 0.6, "", "friction coefficient"),
        Parameter("alpha", 0.0, "degrees", "slope"),
        Parameter("v0", 0.02, "m/s", "speed down the slope at t = 0"),
        Parameter("g", 9.81, "m/s2", "gravity"),
    ),
    variants=tuple(
        Variant(
            name, summary, "s = v0 t - a t^2/2 to t = v0/a, then v0^2/(2a); "
            "a = g (mu cos alpha - sin alpha)",
            {"alpha": alpha}, frozenset({"m"}),
        )
        for name, summary, alpha in (
            ("level", "a plate that can turn stops on a level floor, after 3.4 and 6.8 steps", 0.0),
            ("slope", "a plate that can turn stops on a slope of 5 degrees, after 3.4 and 6.8 "
             "steps", 5.0),
            ("held", "a plate that cannot turn stops on a level floor, after 102 and 204 "
             "steps", 0.0),
        )
    ),
    declare=_declare,
)  # fmt: skip
