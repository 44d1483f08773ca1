"""A gas of spheres in a box without gravity: rate of collisions, and cooling by viscous contacts.

The paths of the spheres differ between codes after some collisions, and each seed is one draw of
many. Means over spheres and time are compared, rounded to units of the width in which the draws of
all seeds lie, as `tests/cases/bulk/test_homogeneous_cooling.py` shows with their means.
"""

from __future__ import annotations

import functools
import math

import numpy as np

from reference_solutions.bulk import cooling
from vv.ask import Displacement, History, Knobs, Method, Run, Velocity
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
from vv.scene import Contact, Scene, Spheres, Vector, Wall
from vv.scene.neighbours import overlapping

COUNT, RADIUS, SIDE = 500, 0.005, 0.14  # spheres, and lengths [m]
PLACES = 12  # sites along each side, of which spheres take some at random
MOVED = tuple(Displacement(i) for i in range(COUNT))  # walls are bodies after the spheres
SPEEDS = tuple(Velocity(i) for i in range(COUNT))
SEEDS = (1, 2, 3)
STEPS = 12  # in a contact of two spheres
SETTLED = 40  # outputs until spheres that start at one speed have lost the memory of it
COOLED, SHARE = 1.0, 0.1  # times tau, and the first part of it, which is left out
LASTED, OUTPUTS = 15.0, 180  # times the diameter over the speed
RATE, MET, SPREAD, KEPT = 0.18, 0.2, 0.15, 0.01  # units to which quantities are rounded


def to_nearest(value: float, unit: float, reference: float) -> float:
    """The value, rounded to whole units from the reference: smaller differences are chance."""
    return reference * (1.0 + unit * round((value / reference - 1.0) / unit))


def _spheres(seed: int, p: Parameters, alike: bool) -> Spheres:
    """Spheres on random sites of a lattice, all of one speed or with Maxwell's distribution."""
    random = np.random.default_rng(seed)
    grid = np.stack(np.meshgrid(*[np.arange(PLACES)] * 3, indexing="ij"), 3).reshape(-1, 3)
    place = grid[random.choice(len(grid), COUNT, replace=False)]
    speed = random.normal(size=(COUNT, 3))
    squares = (speed**2).sum(axis=1, keepdims=True)
    speed *= math.sqrt(3.0) * p["v"] / np.sqrt(squares if alike else squares.mean())
    return Spheres(
        np.asarray((place + 0.5) * SIDE / PLACES, float), speed, np.full(COUNT, RADIUS),
        np.full(COUNT, p["m"]), np.ones((COUNT, 3), bool),
    )  # fmt: skip


def scene_of(seed: int, p: Parameters) -> Scene:
    """The gas and six walls; contacts are viscous if z is not zero."""
    sides = [(np.zeros(3), n) for n in np.eye(3)] + [(np.full(3, SIDE), -n) for n in np.eye(3)]
    viscous = 2.0 * p["z"] * math.sqrt(p["kn"] * p["m"] / 2.0)
    walls = (Wall(point, normal) for point, normal in sides)
    spheres = _spheres(seed, p, alike=p["z"] == 0)
    return Scene((spheres, *walls), Contact(p["kn"], eta_n=viscous))


def _gas(p: Parameters, temperature: float) -> cooling.Gas:
    return cooling.gas(
        COUNT, side=SIDE, d=2 * RADIUS, m=p["m"], kn=p["kn"], temperature=temperature
    )


def moving(scene: Scene, run: Run) -> Vector:
    """Kinetic energy (k,) [J]."""
    squares = sum((run.values[what] ** 2).sum(axis=1) for what in SPEEDS)
    return np.asarray(0.5 * scene.spheres.mass[0] * squares)


def cooling_rate(scene: Scene, run: Run) -> float:
    """The growth rate of the root of the energy at t = 0 over the current one [1/s]."""
    energy, first = moving(scene, run), round(SHARE * (len(run.times) - 1))
    slowed = np.sqrt(energy[0] / energy)
    return float((slowed[-1] - slowed[first]) / (run.times[-1] - run.times[first]))


def _overlaps(scene: Scene, run: Run, k: int) -> Vector:
    """Overlaps [m] of all contacts at an output."""
    s = scene.spheres
    x = s.position + np.stack([run.values[what][k] for what in MOVED])
    i, j = overlapping(Spheres(x, s.velocity, s.radius, s.mass, s.free)).T
    pairs = 2 * RADIUS - np.linalg.norm(x[j] - x[i], axis=1)
    walls = RADIUS - np.concatenate([x, SIDE - x], axis=1).ravel()
    return np.concatenate([pairs, walls[walls > 0]])


def contacts(scene: Scene, run: Run) -> float:
    """The mean number of contacts over the outputs after SETTLED."""
    seen = range(SETTLED, len(run.times))
    return float(np.mean([len(_overlaps(scene, run, k)) for k in seen]))


def flatness(run: Run) -> float:
    """The mean of v^4 over the square of the mean of v^2, averaged over the same outputs."""
    squares = np.stack([(run.values[what][SETTLED:] ** 2).sum(axis=1) for what in SPEEDS])
    return float(((squares**2).mean(axis=0) / squares.mean(axis=0) ** 2).mean())


def energy(p: Parameters, scene: Scene, run: Run) -> float:
    """Energy of motion and of springs at the end [J]."""
    springs = 0.5 * p["kn"] * float((_overlaps(scene, run, -1) ** 2).sum())
    return float(moving(scene, run)[-1]) + springs


def _scalar(
    name: str, symbol: str, unit: str, meaning: str, observe: functools.partial[float],
    reference: float, width: float, why: str,
) -> Scalar:  # fmt: skip
    """A mean that is judged in units of a width."""
    tolerance = Tolerance(0.5 * width, why, slack=DRAWN)
    return Scalar(
        name, symbol, unit, meaning, lambda run: to_nearest(observe(run), width, reference),
        reference, reference,
        Exact({Method.SECOND_ORDER: tolerance, Method.FIRST_ORDER: tolerance}),
    )  # fmt: skip


def _cooled(scene: Scene, p: Parameters, dt: float) -> Trial:
    """The trial of a gas that cools."""
    rate = cooling.cooling(COUNT, _gas(p, p["m"] * p["v"] ** 2), p["z"])
    steps = round(COOLED / rate / dt / 10)
    falls = _scalar(
        "cooling rate", "1/tau", "1/s", "growth rate of sqrt(E(0)/E), from 0.1 tau on",
        functools.partial(cooling_rate, scene), rate, RATE,
        "all of 24 seeds lie within 5.1 % of their mean, which is 2.4 +- 0.9 % (95 %) below theory",
    )  # fmt: skip
    goal = History(10 * steps * dt, steps * dt)
    ladder = Ladder(scene, goal, SPEEDS, dict.fromkeys(Level, (Knobs(dt=dt),)))
    return Trial(ladder, (falls,))


def _elastic(scene: Scene, p: Parameters, dt: float) -> Trial:
    """The trial of a gas that keeps its energy."""
    whole, steps = 1.5 * COUNT * p["m"] * p["v"] ** 2, round(LASTED * 2 * RADIUS / p["v"] / dt)
    law = {"m": p["m"], "kn": p["kn"]}
    warm = p["m"] * p["v"] ** 2
    found = cooling.touching(_gas(p, warm), **law)
    warm /= 1.0 + found / (3.0 * COUNT)  # the spring of each contact stores T/2
    found = cooling.touching(_gas(p, warm), **law)
    met = _scalar(
        "contacts", "c", "", "mean number of contacts, including those with walls",
        functools.partial(contacts, scene), found, MET,
        "all of 24 seeds lie within 6 % of their mean, which is 0.4 +- 1.1 % (95 %) below theory",
    )  # fmt: skip
    spread = _scalar(
        "flatness", "<v4>/<v2>2", "", "flatness of the distribution of speeds, which are all equal "
        "at t = 0",
        functools.partial(flatness), cooling.flatness(COUNT), SPREAD,
        "all of 24 seeds lie within 3.5 % of the exact value",
    )  # fmt: skip
    kept = _scalar(
        "energy", "E", "J", "energy of motion and of springs at the end",
        functools.partial(energy, p, scene), whole, KEPT,
        "a contact that begins within a step gains or loses some (w dt)^2/2 of its energy, 2 %, at "
        "random: 2e-3 of all energy after 20 contacts of each sphere",
    )  # fmt: skip
    goal = History(OUTPUTS * (steps // OUTPUTS) * dt, (steps // OUTPUTS) * dt)
    ladder = Ladder(scene, goal, (*MOVED, *SPEEDS), dict.fromkeys(Level, (Knobs(dt=dt),)))
    return Trial(ladder, (met, spread, kept))


def _declare(variant: str, p: Parameters) -> Trial:
    scene = scene_of(int(variant.rpartition("-")[2]), p)
    dt = math.pi * math.sqrt(p["m"] / (2.0 * p["kn"])) / STEPS
    return (_cooled if p["z"] > 0 else _elastic)(scene, p, dt)


DRAWN = "values are rounded to units of twice this scatter, so that chance does not change a result"
WIDE = "one seed gives it to some per cent, and it is rounded to units of 15 to 20 %"
CASE = Case(
    name="homogeneous-cooling",
    title="A gas of spheres cools",
    source=Source(
        "Haff (1983), Grain flow as a fluid-mechanical phenomenon, Journal of Fluid Mechanics "
        "134, 401-430",
        "10.1017/S0022112083003419",
        "The gas is between walls, which take energy too: there is no periodic boundary, and walls "
        "have the viscosity of all contacts. The rate of collisions is Enskog's, with the equation "
        "of state of Carnahan and Starling; the effect of walls is the surface tension of "
        "Henderson and Plischke, and the restitution that of Schwager and Poeschel.",
    ),
    parameters=(
        Parameter("m", 1e-3, "kg", "mass of a sphere"),
        Parameter("kn", 2.5e5, "N/m", "contact stiffness"),
        Parameter("v", 1.0, "m/s", "root of the mean square of the speed along an axis, at t = 0"),
        Parameter("z", 0.035, "", "damping over critical damping, of two spheres"),
    ),
    variants=(
        *(
            Variant(
                f"viscous-{seed}", f"{COUNT} spheres, e = 0.90, random start {seed}",
                "E = E(0)/(1 + t/tau)^2; 1/tau = (C (1 - e^2) + R (1 - w^2))/(3 N)",
                level=Level.DEFAULT if seed == SEEDS[0] else Level.PAPER,
                unseen=dict.fromkeys(("m", "kn", "v", "z"), WIDE),
            )
            for seed in SEEDS
        ),
        *(
            Variant(
                f"elastic-{seed}", f"{COUNT} spheres without dashpots, random start {seed}",
                "c = (C/sqrt(2) + R) pi sqrt(m/kn); <v4>/<v2>2 = 5 N/(3 N + 2); E = E(0)",
                {"z": 0.0}, level=Level.PAPER,
                unseen=dict.fromkeys(("m", "kn", "v"), WIDE),
            )
            for seed in SEEDS[:2]
        ),
    ),
    declare=_declare,
)  # fmt: skip
