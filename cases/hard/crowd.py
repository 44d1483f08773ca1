"""Pairs of spheres collide head-on all over a box: a code must detect every contact."""

from __future__ import annotations

import math

import numpy as np

from reference_solutions.contact import dashpot
from vv.ask import Displacement, History, Knobs, Method, Observable, Run
from vv.case import (
    Case,
    Exact,
    Ladder,
    Level,
    Parameter,
    Parameters,
    Scalar,
    Source,
    Tolerance,
    Trial,
    Variant,
)
from vv.scene import Contact, Scene, Spheres, Vector

GRID, SPACING = (4, 3, 3), 1.0  # pairs along each axis, and between their middles [m]
PAIRS = math.prod(GRID)
RADIUS, NEAREST, FARTHEST = 0.05, 0.02, 0.5  # m; the gaps at t = 0 lie between
STEPS = (0.1, 0.05, 0.025)  # times w


def _directions() -> Vector:
    """A direction (PAIRS, 3) for each pair, spread over the sphere by the golden angle."""
    z = 1 - (2 * np.arange(PAIRS) + 1) / PAIRS
    angle, level = np.pi * (3 - np.sqrt(5)) * np.arange(PAIRS), np.sqrt(1 - z**2)
    return np.stack([level * np.cos(angle), level * np.sin(angle), z], axis=1)


def _gaps() -> Vector:
    """The gap between the spheres of each pair at t = 0 (PAIRS,) [m]; no two gaps are equal."""
    turns = np.modf(np.arange(PAIRS) * (np.sqrt(5) - 1) / 2)[0]
    return np.asarray(NEAREST + (FARTHEST - NEAREST) * turns)


def _scene(p: Parameters) -> Scene:
    """The first spheres of all pairs, followed by the second ones."""
    middles = SPACING * np.stack(np.meshgrid(*map(np.arange, GRID), indexing="ij"), 3).reshape(
        -1, 3
    )
    way, half = _directions(), (RADIUS + _gaps() / 2)[:, None]
    count = 2 * PAIRS
    spheres = Spheres(
        position=np.concatenate([middles - half * way, middles + half * way]),
        velocity=0.5 * p["v"] * np.concatenate([way, -way]),
        radius=np.full(count, RADIUS),
        mass=np.full(count, p["m"]),
        free=np.ones((count, 3), bool),
    )
    return Scene((spheres,), Contact(p["kn"]))


def _path(p: Parameters, t: Vector) -> Vector:
    """The approach of each pair (k, PAIRS) [m]; the reduced mass is m/2."""
    since = t[:, None] - _gaps() / p["v"]
    law = {"m": p["m"] / 2, "kn": p["kn"], "z": 0.0, "v": p["v"]}
    return _gaps() + np.where(
        since > 0, dashpot.overlap(np.maximum(since, 0), **law), p["v"] * since
    )


def _declare(variant: str, p: Parameters) -> Trial:
    unit = math.sqrt(p["m"] / 2 / p["kn"])
    if not p["v"] * unit < RADIUS / 10:
        raise ValueError(
            f"v = {p['v']!r} m/s; spheres would overlap by {p['v'] * unit:.6g} m; it must be less "
            f"than a tenth of the radius, {RADIUS / 10:g} m, or springs are no hard spheres"
        )
    goal = History(1.5 * FARTHEST / p["v"], 0.05 * FARTHEST / p["v"])
    seen: tuple[Observable, ...] = tuple(Displacement(i) for i in range(2 * PAIRS))
    way = _directions()

    def apart(run: Run) -> float:
        first, second = (
            np.stack([run.values[what] for what in part], axis=1)
            for part in (seen[:PAIRS], seen[PAIRS:])
        )
        closed = _path(p, run.times)[:, :, None] * way / 2
        return float(np.abs([first - closed, second + closed]).max())

    distance = Scalar(
        "distance", "max|e|", "m", "largest distance of a sphere from its exact path, over the "
        "largest gap",
        apart, 0.0, FARTHEST, Exact(_judged(unit)),
    )  # fmt: skip
    rungs = tuple(Knobs(dt=step * unit) for step in STEPS)
    levels = {Level.QUICK: rungs[:2], Level.DEFAULT: rungs, Level.PAPER: rungs}
    return Trial(Ladder(_scene(p), goal, seen, levels), (distance,))


def _judged(unit: float) -> dict[Method, Tolerance]:
    """unit: 1/w [s]."""
    return {
        Method.EXACT: Tolerance(1e-12, "two events per pair, located to rounding"),
        Method.SECOND_ORDER: Tolerance(
            STEPS[0] ** 2 / 5,
            "a contact closes and opens within a step, which changes the speeds after it by a "
            "fraction of (w dt)^2/2",
            dt=STEPS[0] * unit,
            order=2,
        ),
    }


BRIEF = (
    "a contact lasts 2 ms: 1 % of that changes a path by 1e-5 of the gap, less than the steps do. "
    "The case judges that no contact is missed"
)
CASE = Case(
    name="crowd",
    title="Many pairs of spheres",
    source=Source(
        "Schwager and Poeschel (2007), Coefficient of restitution and linear-dashpot model "
        "revisited, Granular Matter 9(6), 465-469",
        "10.1007/s10035-007-0065-z",
        "The paper's contact without damping, 36 times: pairs on a grid in space, each with a "
        "direction and a gap of its own, so that spheres cross the cells and neighbour lists of a "
        "code.",
    ),
    parameters=(
        Parameter("m", 1.0, "kg", "mass of a sphere"),
        Parameter("kn", 1e6, "N/m", "contact stiffness"),
        Parameter("v", 2.0, "m/s", "approach speed of a pair"),
    ),
    variants=(
        Variant("pairs", "72 spheres, 36 collisions", "u = v/w sin(wt) in contact, w^2 = 2 kn/m",
                unseen=dict.fromkeys(("m", "kn"), BRIEF)),
    ),
    declare=_declare,
)  # fmt: skip
