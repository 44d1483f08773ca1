"""A sphere bounces on a floor until drag has brought it to rest."""

from __future__ import annotations

import functools
import math
from collections.abc import Mapping, Sequence

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
    law, own = {name: p[name] for name in LAW}, p == CASE.defaults(variant)
    moved = Series(
        name="z",
        symbol="z",
        unit="m",
        meaning="displacement upwards",
        observe=HEIGHT,
        reference=functools.partial(settling.settling, **law),
        judge=Exact(PATH if own else _elsewhere(p, law)),
    )
    bounces = Count(
        name="bounces",
        symbol="n",
        meaning="number of times the sphere leaves the floor",
        observe=lambda run: _count_departures(HEIGHT(run) + p["height"]),
        reference=lambda: _bounces(settling.stages(**law)),
        judge=COUNTED if own else COUNTED_ELSEWHERE,
    )
    return Trial(Ladder(_scene(p), GOAL, (SPHERE,), LEVELS), (moved, bounces))


def _bounces(stages: Sequence[settling.Stage]) -> int:
    return sum(stage.flies for stage in stages) - 1


def _elsewhere(p: Parameters, law: Mapping[str, float]) -> dict[Method, Tolerance]:
    """The bounds at parameters other than the case's own."""
    stages, step = settling.stages(**law), 1e-4
    swing = p["kn"] / p["m"] * step**2
    value = min(max(3.0 * _spread(p, stages), 0.4) * swing, LARGEST_TOLERANCE)
    ends = (
        "a contact changes the speed by (k dt)^2/2 (b (1 - b) - a (1 - a)) of it, a and b the "
        "parts of a step after which it begins and ends, at random; each changes all flights that "
        "follow. Three standard deviations are allowed"
    )
    slows = p["eta"] / p["m"] / 20.0 * max(1.0, _bounces(stages) / 30.0)
    starts = math.sqrt(p["g"] / p["height"] / (9.81 / 2e-3))
    return PATH | {
        Method.SECOND_ORDER: Tolerance(value, ends, dt=step, order=2),
        Method.FIRST_ORDER: Tolerance(
            value, f"{PATH[Method.FIRST_ORDER].reason}; {ends}",
            dt=step, order=2, late=100.0 * max(1.0, slows, starts),
        ),
    }  # fmt: skip


def _spread(p: Parameters, stages: Sequence[settling.Stage]) -> float:
    """The standard deviation of the largest error over the height, for (k dt)^2 = 1."""
    flights = [(one.begin, abs(one.v)) for one in stages[1:] if one.flies]
    lags = [
        speed * math.sqrt(sum((begin - earlier) ** 2 for earlier, _ in flights[:i]))
        for i, (begin, speed) in enumerate(flights)
    ]
    return max(lags, default=0.0) / p["height"] / 2 / math.sqrt(90.0)


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
    slack="a number that is right has no error",
)
COUNTED = Exact(dict.fromkeys(PATH, WHOLE))
COUNTED_ELSEWHERE = Exact(
    {method: WHOLE for method in PATH if method is not Method.FIRST_ORDER},
    not_judged={
        Method.FIRST_ORDER: "an error of first order may decide whether the slowest bounce leaves "
        "the floor; that it does not is known at the case's own parameters only"
    },
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
