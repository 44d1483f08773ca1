"""A sphere bounces on a floor until drag has brought it to rest."""

from __future__ import annotations

import functools

import numpy as np

from cases._papers import LI_2018
from cases.hard.parts import _settling_bounds
from cases.hard.parts._settling_bounds import INTERVAL
from reference_solutions.contact import settling
from vv.ask import Displacement, History, Knobs
from vv.case import (
    Case,
    ComponentAlong,
    Count,
    Ladder,
    Level,
    Parameter,
    Parameters,
    Series,
    Source,
    Trial,
    Variant,
)
from vv.scene import Contact, Scene, Spheres, Vector, Wall

RADIUS = 0.1  # m; does not enter the answer
SPHERE = Displacement(1)
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
    stages = settling.stages(**law)
    goal = History(
        max(_settling_bounds.DURATION, 2.0 * stages[-1].begin), INTERVAL
    )  # until it bounces no longer
    moved = Series(
        name="z",
        symbol="z",
        unit="m",
        meaning="displacement upwards",
        observe=HEIGHT,
        reference=functools.partial(settling.settling, **law),
        judge=_settling_bounds.path(p, stages, own),
    )
    bounces = Count(
        name="bounces",
        symbol="n",
        meaning="number of times the sphere leaves the floor",
        observe=lambda run: _count_departures(HEIGHT(run) + p["height"]),
        reference=lambda: _settling_bounds.bounces(stages),
        judge=_settling_bounds.count(p, law, stages, own),
    )
    parts = 1 if own else _settling_bounds.parts(p, stages)
    levels = {
        level: tuple(Knobs(dt=(one.dt or 0.0) / parts) for one in rungs)
        for level, rungs in LEVELS.items()
    }
    return Trial(Ladder(_scene(p), goal, (SPHERE,), levels), (moved, bounces))


def _count_departures(z: Vector) -> int:
    return int(np.count_nonzero((z[:-1] <= 0) & (z[1:] > 0)))


RUNGS = tuple(Knobs(dt=dt) for dt in (1e-4, 5e-5, 2.5e-5, 1.25e-5))
COARSE = RUNGS[:3:2]
LEVELS = {Level.QUICK: COARSE, Level.DEFAULT: (*COARSE, RUNGS[3]), Level.PAPER: RUNGS}
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
