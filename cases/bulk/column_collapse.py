"""A column of grains collapses on a rough floor: its run-out, measured, and exact laws."""

from __future__ import annotations

import math
from functools import partial

import numpy as np

from reference_solutions.bulk import column
from vv.ask import Displacement, History, Knobs, Observable, Run, Velocity
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
SEEDS = (1, 2, 3)
# height over radius of the column; pitch [D] and radius of the floor
TALL, APART, FLOOR = 0.98, 1.02, 3.0
SIZES = (0.85, 1.0)  # diameters over D
STIFF, SHEAR, DAMPED, DENSE = 2e4, 2.0 / 7.0, 0.3, 2500.0
LASTS, ROWS = 4.5, 9  # of sqrt(height over gravity), three of which are measured; number of outputs
UNIT, RAYS = 0.25, 360


def _layer(radius: float, pitch: float, aside: bool) -> Vector:
    """Points of a triangular lattice in a circle (n, 2), between those of another if `aside`."""
    reach = int(1.3 * radius / pitch) + 3
    i, j = (axis.ravel() for axis in np.meshgrid(*[np.arange(-reach, reach + 1)] * 2))
    x = (i + 0.5 * (j % 2) + 0.5 * aside) * pitch
    y = (j * math.sqrt(0.75) + aside * math.sqrt(1.0 / 12.0)) * pitch
    inside = np.hypot(x, y) <= radius * (1 + 1e-9)
    return np.asarray(np.column_stack([x, y])[inside])


def _grains(seed: int, across: float) -> tuple[Vector, Vector, int]:
    """Centres (n, 3) [m] and radii [m] of falling grains, then of the floor; number that falls."""
    wide, layers, rise = across * D, column.layers(TALL * across), column.RISE * D
    sites = [_layer(wide, D, bool(k % 2)) for k in range(layers)]
    falling = [np.column_stack([xy, np.full(len(xy), D + k * rise)]) for k, xy in enumerate(sites)]
    x = np.concatenate(falling)
    random = np.random.default_rng(seed)
    size = random.uniform(*SIZES, len(x))
    aside = random.uniform(-1, 1, (len(x), 3)) / math.sqrt(3.0)
    x = x + 0.5 * D * (1 - size)[:, None] * aside  # each within its site, so that none overlap
    held = _layer(FLOOR * wide, APART * D, False)
    held = np.column_stack([held, np.zeros(len(held))])
    return (
        np.concatenate([x, held]),
        0.5 * D * np.concatenate([size, np.ones(len(held))]),
        len(x),
    )


def _scene(variant: str, p: Parameters) -> tuple[Scene, int]:
    """Grains that fall, the fixed grains of the floor, and a plane below these."""
    x, radius, count = _grains(int(variant.removeprefix("seed-")), p["wide"])
    mass = DENSE * 4.0 / 3.0 * math.pi * radius**3
    moves = np.repeat([True, False], [count, len(x) - count])[:, None] * np.ones(3, bool)
    spheres = Spheres(x, np.zeros_like(x), radius, mass, moves, free_spin=moves)
    heaviest = float(mass.max())
    kn = STIFF * heaviest * p["g"] / D
    law = Contact(kn, SHEAR * kn, p["mu"], DAMPED * math.sqrt(2.0 * kn * heaviest))
    below = Wall(np.array([0.0, 0.0, -0.52 * D]), np.eye(3)[2])
    return Scene((spheres, below), law, gravity=np.array([0.0, 0.0, -p["g"]])), count


def _places(scene: Scene, count: int, run: Run) -> Vector:
    """The positions of the falling grains (k, n, 3) [m]."""
    moved = np.stack([run.values[Displacement(i)] for i in range(count)], axis=1)
    return scene.spheres.position[:count] + moved


def _covered(x: Vector, radius: float) -> float:
    """The part of a circle about the axis that grains `x` (n, 3) cover, seen from above."""
    turn = np.linspace(0.0, 2.0 * math.pi, RAYS, endpoint=False)
    near = np.abs(np.hypot(x[:, 0], x[:, 1]) - radius) < 0.5 * D
    points = radius * np.column_stack([np.cos(turn), np.sin(turn)])
    gaps = points[:, None] - x[None, near, :2]
    return float((np.linalg.norm(gaps, axis=2) < 0.5 * D).any(axis=1).mean())


def _edge(x: Vector) -> float:
    """The radius [m] of the largest circle that grains half cover; stray grains lie beyond it."""
    radii = 0.125 * D * np.arange(4, 8 * 40)
    return float(max(r for r in radii if _covered(x, r) > 0.5))


def _rounded(value: float) -> float:
    """The nearest multiple of UNIT: smaller differences are chance."""
    return round(value / UNIT) * UNIT


def _run_out(scene: Scene, count: int, start: float, run: Run) -> float:
    """The growth of the radius over its initial value, rounded since the rest is chance."""
    grown = _edge(_places(scene, count, run)[-1]) / start - 1.0
    return _rounded(grown)


def _top(scene: Scene, count: int, start: float, run: Run) -> float:
    """The height of the highest grain near the axis over the initial radius, rounded likewise."""
    x = _places(scene, count, run)[-1]
    inner = np.hypot(x[:, 0], x[:, 1]) < 1.5 * D
    top = (x[:, 2] + scene.spheres.radius[:count])[inner].max(initial=0.0) - column.GROUND * D
    return _rounded(float(top) / start)


def _energy_gain(scene: Scene, count: int, p: Parameters, run: Run) -> float:
    """Largest later excess of kinetic and potential energy over that at the start [J]; 0 if none.

    The first output is that start, where codes that store velocities at half steps are off by a
    rounding or by half a step of free fall: what they say there is no gain.
    """
    speed = np.stack([run.values[Velocity(i)] for i in range(count)], axis=1)
    mass = scene.spheres.mass[:count]
    fallen = (_places(scene, count, run) - scene.spheres.position[:count])[:, :, 2]
    energy = 0.5 * (speed**2).sum(axis=2) @ mass + p["g"] * fallen @ mass
    return max(float(energy[1:].max()), 0.0)


def _faster_than_fall(scene: Scene, count: int, p: Parameters, run: Run) -> float:
    """The largest distance of the centre of mass below its free fall [m]; 0 if never below."""
    mass = scene.spheres.mass[:count]
    fallen = (_places(scene, count, run) - scene.spheres.position[:count])[:, :, 2]
    centre = fallen @ mass / mass.sum()
    return max(float((-0.5 * p["g"] * run.times**2 - centre).max()), 0.0)


def _fallen_through(scene: Scene, count: int, run: Run) -> float:
    """The number of grains below the centres of the floor at the end; nan positions count too."""
    z = _places(scene, count, run)[-1][:, 2]
    within = np.hypot(*scene.spheres.position[count:, :2].T).max()
    x = _places(scene, count, run)[-1]
    return float(np.count_nonzero(~(z > 0.0) & (np.hypot(x[:, 0], x[:, 1]) < within)))


def _declare(variant: str, p: Parameters) -> Trial:
    scene, count = _scene(variant, p)
    layers = column.layers(TALL * p["wide"])
    start = column.radius(count / layers) * D
    high = layers * column.RISE * D
    a, weight = high / start, float(scene.spheres.mass[:count].sum() * p["g"])
    unit = math.sqrt(high / p["g"])
    goal = History(LASTS * unit, LASTS * unit / ROWS)
    step = math.sqrt(D / p["g"] / STIFF) / 5.0
    dt = goal.interval / math.ceil(goal.interval / step)
    seen: tuple[Observable, ...] = tuple(
        kind(i) for i in range(count) for kind in (Displacement, Velocity)
    )
    ladder = Ladder(scene, goal, seen, dict.fromkeys(Level, (Knobs(dt=dt),)))
    return Trial(ladder, (
        Scalar(
            "run-out", "(r - r0)/r0", "", "growth of the radius that grains half cover, over its "
            "initial value",
            partial(_run_out, scene, count, start), None, 1.0, _judge(a, start / D),
        ),
        Scalar(
            "height", "h/r0", "", "height at the axis over the initial radius",
            partial(_top, scene, count, start), None, 1.0,
            Measured(_height(a), None, ONE_GRAIN, law=True),
        ),
        Scalar(
            "gain", "max(E - E0)", "J", "kinetic and potential energy in excess of that at the "
            "start",
            partial(_energy_gain, scene, count, p), 0.0, weight * high,
            Invariant(0.5 * (dt / unit) ** 2, HEAT),
        ),
        Scalar(
            "hurry", "d", "m", "largest distance of the centre of mass below its free fall",
            partial(_faster_than_fall, scene, count, p), 0.0, high, Invariant(1e-9, NO_PULL),
        ),
        Scalar(
            "through", "n", "", "number of grains below the centres of the floor at the end",
            partial(_fallen_through, scene, count), 0.0, 1.0, Invariant(0.5, FLOORED),
        ),
    ))  # fmt: skip


def _judge(a: float, wide: float) -> Measured:
    """The measured run-out, with what grains of this size may miss of it."""
    value = column.run_out(a)
    seen = Measurement(value, PRINTED * a, SCATTER * value, CONDITIONS, CITED)
    grain = (1.0 + value) / column.height(a) / wide
    return Measured(seen, SURE * seen.uncertainty + grain, BAND, law=True)


def _height(a: float) -> Measurement:
    """The measured height: between the two laws that are cited, which differ near a = 1."""
    low, high = sorted((column.height(a), a))
    half = 0.5 * (high - low)
    return Measurement(low + half, PRINTED * a, half, CONDITIONS, CITED_HEIGHT)


SURE, PRINTED, SCATTER = 3.0, 0.005, 0.1
CITED = (
    "Lube, Huppert, Sparks and Hallworth (2004), J. Fluid Mech. 508, 175-199: 1.24 a up to "
    "a = 1.7, 1.6 sqrt(a) beyond, as others cite it"
)
CITED_HEIGHT = (
    "Lube and others (2004) as others cite it: 0.88 a^(1/6) of tall columns; from 0.74 to 1.7 the "
    "initial height"
)
CONDITIONS = (
    "sand, rice, couscous, sugar and salt in cylinders of many grains across, which are lifted off "
    "quickly; the laws hold for all of them, on smooth and rough floors"
)
BAND = (
    "three standard uncertainties of a tenth each, since no source that could be read states the "
    "scatter; and an edge of one grain: a heap is not resolved where it is thinner than a grain, d "
    "over its measured mean slope away from where its thickness is zero"
)
ONE_GRAIN = (
    "a single grain at the axis decides the value, by a grain or two: a column of five grains "
    "across is 0.3 too low, one of ten 0.12, and no law is known for that"
)
HEAT = (
    "friction, dashpots and spins take energy, springs store some, and nothing adds any; a "
    "velocity may be reported a step of free fall late"
)
NO_PULL = "the floor only pushes, upwards or sideways, so that nothing falls faster than freely"
FLOORED = "the grains of the floor are so close that no falling grain can pass"
FORMULA = "(r - r0)/r0 = 1.24 a, a = h0/r0 < 1.7; E(t) <= E(0); z(t) >= z(0) - g t^2/2"
NOTE = (
    "Grains are spheres with friction and without rolling resistance, of different sizes so that "
    "they form no lattice, and as dense as poured grains, 0.59; the floor is one layer of glued "
    "grains. Stiffness, 2e4 m g/d, damping, friction and sizes are chosen. The paths of grains are "
    "chance: run-out and height are rounded to 0.25, over three random starts. They can show "
    "whether such spheres run out like grains, within their own size, but not how well a code "
    "solves their motion. Lube's paper could not be read: its laws are as others cite them."
)
CASE = Case(
    name="column-collapse",
    title="A column of grains collapses, measured",
    source=Source(
        "Lube, Huppert, Sparks and Hallworth (2004), Axisymmetric collapses of granular columns, "
        "Journal of Fluid Mechanics 508, 175-199",
        "10.1017/S0022112004009036",
        NOTE,
    ),
    parameters=(
        Parameter("mu", 0.5, "", "friction of grains"),
        Parameter("g", 9.81, "m/s2", "gravity", Sign.POSITIVE),
        Parameter("wide", 5.0, "", "radius of the column, in diameters of the largest grain"),
    ),
    variants=tuple(
        Variant(
            f"seed-{seed}",
            f"grains of a fifth of the radius, random start {seed}",
            FORMULA,
            inert=frozenset({"mu", "g", "wide"}),
            level=Level.DEFAULT if seed == SEEDS[0] else Level.PAPER,
        )
        for seed in SEEDS
    ),
    declare=_declare,
)  # fmt: skip
