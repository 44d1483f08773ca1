"""Grains leave a silo through a hole in its floor: their rate, measured, and effect of height.

A plane wall has no opening, in any code: the floor is one layer of fixed grains.
"""

from __future__ import annotations

import math
from functools import partial

import numpy as np

from reference_solutions.bulk import hopper
from vv.ask import Displacement, History, Knobs, Run
from vv.case import (
    Case,
    Invariant,
    Ladder,
    Level,
    Measured,
    Measurement,
    Parameter,
    Parameters,
    Scalar,
    Sign,
    Source,
    Trial,
    Variant,
)
from vv.scene import Contact, Scene, Spheres, Vector, Wall

D = 0.01  # diameter of the largest grain, and of the grains of the floor [m]
SIZES, MEAN = (0.85, 1.0), 0.925  # diameters over D
WIDE, RISE = 10, 0.88  # width of the silo and spacing of the layers [D]
LAYERS = {"narrow": 14, "wide": 14, "low": 8}  # of the filling, by variant
DEEP = 10.0  # of the plane below the floor on which grains come to rest [D]
STIFF, SHEAR, DAMPED, DENSE = 3e3, 2.0 / 7.0, 0.3, 2500.0
FILLED = 0.59  # solid fraction of the poured grains
FROM, TO, SLACK = 0.1, 0.4, 1.2  # parts that have left; time allowed over that of the law
FLOWS = 5.0  # mean grains across a hole over which spheres do not arch (Zuriguel and others 2005)
ROWS, TOLD = 50, 0.1  # number of outputs; unit of rounding over the rate of the law


def _sites(wide: float, pitch: float, aside: bool) -> Vector:
    """Points of a triangular lattice (n, 2) within a square of side `wide` about the axis [D]."""
    reach = int(wide / pitch) + 2
    i, j = (axis.ravel() for axis in np.meshgrid(*[np.arange(-reach, reach + 1)] * 2))
    x = (i + 0.5 * (j % 2) + 0.5 * aside) * pitch
    y = (j * math.sqrt(0.75) + aside * math.sqrt(1.0 / 12.0)) * pitch
    inside = np.maximum(abs(x), abs(y)) <= 0.5 * wide
    return np.asarray(np.column_stack([x, y])[inside])


def _grains(high: int, seed: int) -> tuple[Vector, Vector]:
    """Centres (n, 3) and diameters (n,) of `high` layers of grains [D], none of which overlap."""
    layers = [
        np.insert(_sites(WIDE - 1.0, 1.0, bool(k % 2)), 2, 1.0 + RISE * k, axis=1)
        for k in range(high)
    ]
    x = np.concatenate(layers)
    random = np.random.default_rng(seed)
    size = random.uniform(*SIZES, len(x))
    return x + 0.5 * (1 - size)[:, None] * random.uniform(-1, 1, (len(x), 3)) / math.sqrt(3.0), size


def _floor(opening: float) -> Vector:
    """Centres (n, 3) [D] of grains side by side around the hole, and of a lattice around these."""
    ring, many = hopper.edge(opening)
    turn = 2.0 * math.pi * np.arange(many) / many
    edge = ring * np.column_stack([np.cos(turn), np.sin(turn)])
    rest = _sites(WIDE - 0.02, 1.02, False)
    plate = np.concatenate([edge, rest[np.hypot(*rest.T) > ring + 0.9]])
    return np.insert(plate, 2, 0.0, axis=1)


def _scene(variant: str, p: Parameters) -> tuple[Scene, int]:
    """Grains above a fixed floor, between four planes and above one; the number that fall."""
    opening = p["opening"]
    name, _, seed = variant.partition("-")
    filling, size = _grains(LAYERS[name], int(seed))
    plate, count = _floor(opening), len(filling)
    x = D * np.concatenate([filling, plate])
    radius = 0.5 * D * np.concatenate([size, np.ones(len(plate))])
    mass = DENSE * 4.0 / 3.0 * math.pi * radius**3
    moves = (np.arange(len(x)) < count)[:, None] * np.ones(3, bool)
    spheres = Spheres(x, np.zeros_like(x), radius, mass, moves, free_spin=moves)
    kn = STIFF * mass.max() * p["g"] / D
    law = Contact(kn, SHEAR * kn, p["mu"], DAMPED * math.sqrt(2.0 * kn * mass.max()))
    normals = [sign * axis for axis in np.eye(3)[:2] for sign in (1.0, -1.0)]
    sides = [Wall(-0.5 * WIDE * D * normal, normal) for normal in normals]
    below = Wall(np.array([0.0, 0.0, -DEEP * D]), np.eye(3)[2])
    return Scene((spheres, *sides, below), law, gravity=np.array([0.0, 0.0, -p["g"]])), count


def _places(scene: Scene, count: int, run: Run) -> Vector:
    """The positions of the falling grains (k, n, 3) [m]."""
    moved = np.stack([run.values[Displacement(i)] for i in range(count)], axis=1)
    return scene.spheres.position[:count] + moved


def _departure(scene: Scene, count: int, run: Run, part: float) -> float:
    """The time at which a part of all grains has left [s]; nan if it never has."""
    left = (_places(scene, count, run)[:, :, 2] < 0.0).sum(axis=1)
    if left[-1] < part * count:
        return math.nan
    return float(np.interp(part * count, left, run.times))


def _rate_between(scene: Scene, count: int, first: float, last: float, run: Run) -> float:
    """Grains per second while these parts leave; zero if they do not."""
    spent = _departure(scene, count, run, last) - _departure(scene, count, run, first)
    return (last - first) * count / spent if spent > 0 else 0.0


def _rate(scene: Scene, count: int, law: float, run: Run) -> float:
    """Grains per second, rounded since the rest is chance."""
    return law * TOLD * round(_rate_between(scene, count, FROM, TO, run) / law / TOLD)


def _rate_ratio(scene: Scene, count: int, run: Run) -> float:
    """The rate of the second half of that time over that of the first, rounded likewise."""
    middle = 0.5 * (FROM + TO)
    first = _rate_between(scene, count, FROM, middle, run)
    second = _rate_between(scene, count, middle, TO, run)
    return TOLD * round(second / first / TOLD) if first > 0 else 0.0


def _astray(scene: Scene, count: int, run: Run) -> float:
    """The number of grains that left elsewhere than through the hole: beside it, or the silo."""
    x = _places(scene, count, run) / D
    wide = np.abs(x[:, :, :2]).max(axis=2) > 0.5 * WIDE
    crossed = (x[:-1, :, 2] > 0.5) & (x[1:, :, 2] < 0.0)
    beside = np.hypot(x[:-1, :, 0], x[:-1, :, 1]) > 0.5 * WIDE
    return float((wide.any(axis=0) | (crossed & beside).any(axis=0)).sum())


def _check_opening(clear: float) -> None:
    """Raise ValueError for a hole that grains arch over, or that leaves no floor beside it."""
    if not clear <= WIDE - 2.0 * (1.0 + MEAN):
        raise ValueError(
            f"opening = {clear!r}; it must be at most {WIDE - 2.0 * (1.0 + MEAN):.3g}, so that "
            "grains rest between the edge of the hole and the sides; otherwise the filling falls"
        )
    if not (clear >= 1.0 and hopper.across(clear) >= FLOWS * MEAN):
        raise ValueError(
            f"opening = {clear!r}; the hole must be as wide as {FLOWS:g} mean grains, or they may "
            "arch over it and stop"
        )


def _declare(variant: str, p: Parameters) -> Trial:
    _check_opening(p["opening"])
    scene, count = _scene(variant, p)
    unit, opening = math.sqrt(MEAN * D / p["g"]), hopper.across(p["opening"]) / MEAN
    law, sure = hopper.rate(opening, FILLED) / unit, hopper.uncertainty(opening)
    duration = SLACK * (TO * count / law + 4.0 * unit)
    goal_rows = duration / ROWS
    step = math.sqrt(D / p["g"] / STIFF) / 4.0
    dt = goal_rows / math.ceil(goal_rows / step)
    goal = History(duration, goal_rows)
    seen = tuple(Displacement(i) for i in range(count))
    ladder = Ladder(scene, goal, seen, dict.fromkeys(Level, (Knobs(dt=dt),)))
    measured = Measurement(law, 0.0, sure * law, CONDITIONS, CITED)
    return Trial(ladder, (
        Scalar(
            "rate", "W", "1/s", f"grains per second, from {FROM:.0%} to {TO:.0%} of all",
            partial(_rate, scene, count, law), None, law,
            Measured(measured, 3 * sure * law, BAND, law=True),
        ),
        Scalar(
            "steady", "W2/W1", "", "rate of the second half of these grains over that of the first",
            partial(_rate_ratio, scene, count), 1.0, 1.0, Invariant(STEADY, NO_HEAD),
        ),
        Scalar(
            "astray", "n", "", "grains that left the silo elsewhere than through the hole",
            partial(_astray, scene, count), 0.0, 1.0, Invariant(0.5, CLOSED),
        ),
    ))  # fmt: skip


STEADY = 0.25
CITED = (
    "Beverloo, Leniger and van de Velde (1961), Chem. Eng. Sci. 15, 260-269: C = 0.58, k = 1.4 for "
    "spheres, as others cite it, who give C from 0.55 to 0.65"
)
CONDITIONS = (
    "seeds, sand and beads in flat-bottomed silos, whose hole is six grains across or more; the "
    "bulk density is that of the poured grains, here 0.59 of the density of a grain"
)
BAND = "three standard uncertainties of the two constants"
NO_HEAD = (
    "the rate does not depend on the height (Janssen's silo); 100 grains or more leave in each "
    "half, one by one, which gives their rate to some per cent, and it is rounded to 0.1"
)
CLOSED = "the grains of the floor are so close that no falling grain can pass"
NOTE = (
    "A plane wall has no opening in these codes, so that the floor is a layer of glued grains, "
    "which stand side by side around the hole; the hole is taken for a circle of the same area. "
    "Grains are spheres with friction and without rolling resistance. Stiffness, 3e3 m g/d, "
    "damping, friction and sizes are chosen. The paths of grains are chance: the rate is rounded "
    "to a tenth. Beverloo's paper could not be read: his law is as others cite it."
)
CASE = Case(
    name="hopper",
    title="A silo empties through a hole, measured",
    source=Source(
        "Beverloo, Leniger and van de Velde (1961), The flow of granular solids through orifices, "
        "Chemical Engineering Science 15(3-4), 260-269",
        "10.1016/0009-2509(61)85030-6",
        NOTE,
    ),
    parameters=(
        Parameter("mu", 0.5, "", "friction of grains"),
        Parameter("g", 9.81, "m/s2", "gravity", Sign.POSITIVE),
        Parameter("opening", 5.0, "", "clear width of the hole, in diameters of the largest grain"),
    ),
    variants=tuple(
        Variant(
            f"{name}-1",
            f"a hole of {across} mean grains below {LAYERS[name]} layers, random start 1",
            "W = C rho sqrt(g) (D - k d)^(5/2)",
            {"opening": clear},
            inert=frozenset({"mu", "g", "opening"}),
            level=level,
        )
        for name, across, clear, level in (
            ("narrow", 5.1, 4.5, Level.PAPER),
            ("wide", 6.7, 6.0, Level.PAPER),
            ("low", 6.7, 6.0, Level.DEFAULT),
        )
    ),
    declare=_declare,
)  # fmt: skip
