"""A sphere bounces on a floor until drag has brought it to rest."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Sequence

import numpy as np

from cases._papers import LI_2018
from reference_solutions.contact import settling
from vv.ask import Displacement, History, Knobs, Method
from vv.case import (
    LARGEST_TOLERANCE,
    Case,
    ComponentAlong,
    Count,
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
from vv.scene import Contact, Scene, Spheres, Vector, Wall

RADIUS = 0.1  # m; does not enter the answer
SPHERE = Displacement(1)
GOAL = History(0.8, 1e-4)  # twice the time to the last bounce; six outputs in the shortest flight
Z = np.array([0.0, 0.0, 1.0])
HEIGHT = ComponentAlong(SPHERE, Z)
LAW = ("m", "kn", "eta", "g", "height")


def _scene(p: Parameters) -> Scene:
    sphere = Spheres(
        position=(RADIUS + p["height"]) * Z[None],
        velocity=np.zeros((1, 3)),
        radius=np.array([RADIUS]),
        mass=np.array([p["m"]]),
        free=np.array([[False, False, True]]),
    )
    floor = Wall(np.zeros(3), Z)
    return Scene((floor, sphere), Contact(p["kn"]), p["eta"], gravity=-p["g"] * Z)


def _declare(variant: str, p: Parameters) -> Trial:
    law = {name: p[name] for name in LAW}
    moved = Series(
        name="z",
        symbol="z",
        unit="m",
        meaning="displacement upwards",
        observe=HEIGHT,
        reference=functools.partial(settling.settling, **law),
        judge=Exact(PATH | {Method.SECOND_ORDER: _second(p, settling.stages(**law))}),
    )
    bounces = Count(
        name="bounces",
        symbol="n",
        meaning="number of times the sphere leaves the floor",
        observe=lambda run: _count_departures(HEIGHT(run) + p["height"]),
        reference=lambda: _bounces(settling.stages(**law)),
        judge=Exact(dict.fromkeys(PATH, WHOLE)),
    )
    return Trial(Ladder(_scene(p), GOAL, (SPHERE,), LEVELS), (moved, bounces))


def _bounces(stages: Sequence[settling.Stage]) -> int:
    return sum(stage.flies for stage in stages) - 1


def _second(p: Parameters, stages: Sequence[settling.Stage]) -> Tolerance:
    """The bound of 30 bounces at the case's own parameters, for as many as there are."""
    many = max(1.0, _bounces(stages) / 30.0) ** 2
    swing = p["kn"] / p["m"] / 1e6
    return dataclasses.replace(
        PATH[Method.SECOND_ORDER], value=min(4e-3 * swing * many, LARGEST_TOLERANCE)
    )


def _count_departures(z: Vector) -> int:
    return int(np.count_nonzero((z[:-1] <= 0) & (z[1:] > 0)))


RUNGS = tuple(Knobs(dt=dt) for dt in (1e-4, 5e-5, 2.5e-5, 1.25e-5))
COARSE = RUNGS[:3:2]
LEVELS = {Level.QUICK: COARSE, Level.DEFAULT: (*COARSE, RUNGS[3]), Level.PAPER: RUNGS}
PATH = {
    Method.EXACT: Tolerance(
        5e-13, "rounding errors of sixty events, each of which shifts the next"
    ),
    Method.SECOND_ORDER: Tolerance(
        4e-3,
        "a contact lasts 30 steps of 1e-4 s: an error of (k dt)^2/24 = 4e-4 for its oscillation, "
        "and as much at random for each of its ends. An error of the speed after a contact changes "
        "each flight that follows, so that errors grow with the square of the number of bounces",
        dt=1e-4,
        order=2,
    ),
    Method.FIRST_ORDER: Tolerance(
        1e-2,
        "drag that is half a step late changes its coefficient by n dt = 0.1 % at 1e-4 s, which "
        "adds up over thirty bounces; gravity that is half a step late changes the first speed by "
        "g dt/2v = 0.25 %",
        dt=1e-4,
        order=1,
    ),
}
WHOLE = Tolerance(
    1e-6,
    "a number of bounces is right or wrong; the last that leaves the floor rises above it by 2 % "
    "of its depth, and the next one stays as much below it",
)
CASE = Case(
    name="settling",
    title="Bounces to rest",
    source=Source(
        *LI_2018,
        "The contact law is that of T2, here under gravity and in many bounces. With a spring the "
        "number of bounces is finite; with a coefficient of restitution, which is not a term of "
        "scenes, it would be infinite. The case `dashpot` is about the restitution of a dashpot.",
    ),
    parameters=(
        Parameter("m", 1.0, "kg", "mass"),
        Parameter("kn", 1e6, "N/m", "contact stiffness"),
        Parameter("eta", 20.0, "N s/m", "artificial viscosity"),
        Parameter("g", 9.81, "m/s2", "gravity"),
        Parameter("height", 2e-3, "m", "initial height above the floor"),
    ),
    variants=(
        Variant(
            "drop",
            "dropped from 2 mm: it leaves the floor 30 times",
            "m z'' = -m g - eta z' - kn z while z < 0, without kn in flight",
        ),
    ),
    declare=_declare,
)
