"""A sphere hits a wall on a spring and flies off."""

from __future__ import annotations

import functools

import numpy as np

from reference_solutions import rebound
from vv.ask import Displacement, History, Knobs, Method
from vv.case import (
    Case,
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
from vv.scene import Contact, Scene, Spheres, Wall

RADIUS = 0.1  # m; does not enter the answer
SPHERE = Displacement(1)  # bodies are numbered in order: 0 is the wall
Z = np.array([0.0, 0.0, 1.0])


def declare(variant: str, p: Parameters) -> Trial:
    """The scene with these parameters, what is done with it, and what is judged."""
    wall = Wall(point=np.zeros(3), normal=Z)
    sphere = Spheres(
        position=RADIUS * Z[None],
        velocity=-p["v"] * Z[None],
        radius=np.array([RADIUS]),
        mass=np.array([p["m"]]),
        free=np.array([[False, False, True]]),
    )
    height = Series(
        name="z",
        symbol="z",
        unit="m",
        meaning="displacement away from the wall",
        observe=lambda run: run.values[SPHERE] @ Z,
        reference=functools.partial(rebound.height, m=p["m"], kn=p["kn"], v=p["v"]),
        judge=Exact(TOLERANCES),
    )
    scene = Scene((wall, sphere), Contact(p["kn"]))
    return Trial(Ladder(scene, History(0.06, 1e-3), (SPHERE,), LEVELS), (height,))


RUNGS = tuple(Knobs(dt=dt) for dt in (1e-3, 5e-4, 2.5e-4))  # the contact lasts 31 ms
LEVELS = {Level.QUICK: RUNGS[:2], Level.DEFAULT: RUNGS, Level.PAPER: RUNGS}
TOLERANCES = {
    Method.EXACT: Tolerance(1e-12, "one event, located to rounding"),
    Method.SECOND_ORDER: Tolerance(
        4e-3,
        "(w dt)^2/24 = 4e-4 of the phase of the swing, and as much again for the step in which "
        "the contact opens, wherever in the step that is",
        dt=1e-3,
        order=2,
    ),
}
CASE = Case(
    name="rebound",
    title="A sphere rebounds",
    source=Source("Any textbook of mechanics: the harmonic oscillator", ""),
    parameters=(
        Parameter("m", 1.0, "kg", "mass"),
        Parameter("kn", 1e4, "N/m", "contact stiffness"),
        Parameter("v", 0.1, "m/s", "speed of approach"),
    ),
    variants=(
        Variant("wall", "head on", "z = -(v/w) sin wt to t = pi/w, then v (t - pi/w); w^2 = kn/m"),
    ),
    declare=declare,
)
