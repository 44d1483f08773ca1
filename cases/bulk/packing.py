"""Spheres without friction settle in a box; at rest they obey exact laws, however they got there.

After some collisions the paths of spheres differ between codes and are not compared; `python -m
bench.chance.divergence` finds when that begins. Laws of their state of rest and of their loss of
energy are compared, over some seeds here and, with confidence intervals, over many in `python -m
bench.chance.ensembles`.
"""

from __future__ import annotations

import numpy as np

from reference_solutions.bulk import packing
from vv.ask import Displacement, History, Knobs, Method, Run, Velocity
from vv.case import (
    Case,
    Exact,
    Invariant,
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

COUNT, ACROSS = 100, 4  # number of spheres, and of those along each side of the box
LARGEST, SIZES = 0.01, (0.8, 0.85, 0.9, 0.95, 1.0)  # radius [m], and radii over it
SIDE = 1.1 * 2 * LARGEST * ACROSS  # m
SEEN = tuple(Displacement(i) for i in range(COUNT))  # walls are bodies after the spheres
FAST = tuple(Velocity(i) for i in range(COUNT))
GOAL = History(2.4, 0.15)
FADES, SINKS = 0.05, 0.49  # m/eta [s] and m g/eta [m/s] up to and from which that is long enough
SOFT = 200  # radius over the deepest overlap of a pack that is still one of hard spheres
STEP, OWN = 5e-5, 1e-7  # s, and the m/kn [s2] above which it is as long
LONGEST = 30.0  # times GOAL: a minute of calculation in the slowest codes
SEEDS = (1, 2, 3)
FINE, COARSE = 1e-4, 0.2  # units of rounding: parts of the weight and the radius, and contacts


def _rounded(value: float, unit: float) -> float:
    """The nearest multiple of a unit: smaller differences are chance, and vary by platform."""
    return round(value / unit) * unit


def _spheres(seed: int, p: Parameters) -> Spheres:
    """Layers of spheres of random size and velocity."""
    random = np.random.default_rng(seed)
    layers = [np.arange(-(-COUNT // ACROSS**2)), np.arange(ACROSS), np.arange(ACROSS)]
    grid = np.stack(np.meshgrid(*layers, indexing="ij"), 3).reshape(-1, 3)[:COUNT, ::-1]
    size = random.choice(SIZES, COUNT)
    aside = 0.5 * LARGEST * (1 - size)[:, None] * random.uniform(-1, 1, (COUNT, 3))
    return Spheres(
        np.asarray(2 * LARGEST * (grid + 0.5) + aside, float),
        0.3 * random.normal(size=(COUNT, 3)),
        LARGEST * size,
        p["m"] * size**3,
        np.ones((COUNT, 3), bool),
    )


def _walls() -> tuple[Wall, ...]:
    """A floor and four sides."""
    near = [Wall(np.zeros(3), n) for n in np.eye(3)]
    return (*near, *(Wall(SIDE * np.ones(3), -n) for n in np.eye(3)[:2]))


def _placed(scene: Scene, run: Run, row: int) -> Spheres:
    """The spheres at their positions at an output."""
    s = scene.spheres
    moved = np.stack([run.values[what][row] for what in SEEN])
    return Spheres(s.position + moved, s.velocity, s.radius, s.mass, s.free)


def pressed(scene: Scene, run: Run, row: int = -1) -> Vector:
    """Overlaps (n, 5) [m] of the spheres with each wall."""
    s = _placed(scene, run, row)
    gaps = [(s.position - wall.point) @ wall.normal - s.radius for wall in scene.walls]
    return np.maximum(-np.stack(gaps, axis=1), 0.0)


def contacts(scene: Scene, run: Run) -> float:
    """Contacts per sphere, including those with walls."""
    touching = len(overlapping(_placed(scene, run, -1))) + np.count_nonzero(pressed(scene, run))
    return touching / COUNT


def sideways(kn: float, scene: Scene, run: Run) -> float:
    """The larger imbalance of the forces on opposite side walls [N]."""
    x, y, _, far_x, far_y = kn * pressed(scene, run).sum(axis=0)
    return float(max(abs(x - far_x), abs(y - far_y)))


def still(run: Run) -> float:
    """The largest displacement of a sphere between the last two outputs [m]."""
    ways = [run.values[what][-1] - run.values[what][-2] for what in SEEN]
    return float(np.linalg.norm(ways, axis=1).max())


def moving(scene: Scene, run: Run) -> Vector:
    """Kinetic energy (k,) [J]."""
    squares = np.stack([(run.values[what] ** 2).sum(axis=1) for what in FAST], axis=1)
    return np.asarray(0.5 * squares @ scene.spheres.mass)


def momentum(scene: Scene, run: Run) -> float:
    """The magnitude of the total momentum at the end, over the sum of magnitudes at the start."""
    fast = np.stack([run.values[what] for what in FAST], axis=1)
    most = scene.spheres.mass @ np.linalg.norm(fast[0], axis=1)
    return float(np.linalg.norm(scene.spheres.mass @ fast[-1]) / most)


def _spring_energy(kn: float, scene: Scene, run: Run, row: int) -> float:
    """The energy of springs at an output [J]."""
    s = _placed(scene, run, row)
    i, j = overlapping(s).T
    deep = s.radius[i] + s.radius[j] - np.linalg.norm(s.position[i] - s.position[j], axis=1)
    return 0.5 * kn * float((deep**2).sum() + (pressed(scene, run, row) ** 2).sum())


def gained(p: Parameters, scene: Scene, run: Run) -> float:
    """The largest growth of kinetic, spring and potential energy towards a later output [J]."""
    height = np.stack([run.values[what][:, 2] for what in SEEN], axis=1) @ scene.spheres.mass
    springs = [_spring_energy(p["kn"], scene, run, row) for row in range(len(run.times))]
    whole = moving(scene, run) + p["g"] * height + springs
    return max(0.0, float((whole - np.minimum.accumulate(whole)).max()))


def _longer(p: Parameters) -> float:
    """How many times as long as GOAL a pack takes to come to rest, since drag is weak or strong.

    Strong drag slows the sinking of spheres, and as the last of them roll into place it outweighs
    inertia: their soft motions take twice the time by which that is longer, found by trial.
    """
    sinks = SINKS * p["eta"] / (p["m"] * p["g"])
    longer = max(1.0, p["m"] / p["eta"] / FADES, 2.0 * sinks - 1.0)
    if not longer <= LONGEST:
        raise ValueError(
            f"eta = {p['eta']!r} N s/m, m = {p['m']!r} kg, g = {p['g']!r} m/s2; the pack takes "
            f"{longer * GOAL.duration:.3g} s to come to rest; at most {LONGEST * GOAL.duration:g} "
            "s are run"
        )
    return longer


def _declare(variant: str, p: Parameters) -> Trial:
    if not p["eta"] > 0.0:
        raise ValueError(f"eta = {p['eta']!r} N s/m; without drag nothing brings a pack to rest")
    spheres = _spheres(int(variant.removeprefix("seed-")), p)
    sunk = COUNT / ACROSS**2 * p["m"] * p["g"] / p["kn"] if p["kn"] > 0 else 0.0
    if not sunk < LARGEST / SOFT:
        raise ValueError(
            f"kn = {p['kn']!r} N/m; spheres on the floor overlap it by {sunk:.3g} m; it must be "
            f"below {LARGEST / SOFT:g} m, or a pack has more contacts than one of hard spheres"
        )
    down = np.array([0.0, 0.0, -p["g"]])
    scene = Scene((spheres, *_walls()), Contact(p["kn"]), p["eta"], down)
    longer = _longer(p)
    goal = History(longer * GOAL.duration, longer * GOAL.interval)
    # on stiffer springs, as long a part of a contact
    step = STEP * min(1.0, np.sqrt(p["m"] / p["kn"] / OWN))
    ladder = Ladder(scene, goal, (*SEEN, *FAST), dict.fromkeys(Level, (Knobs(dt=float(step)),)))
    weight = packing.weight(spheres.mass, p["g"])
    return Trial(ladder, (*_forces(p, scene, weight), *_motions(p, scene, weight)))


def _forces(p: Parameters, scene: Scene, weight: float) -> tuple[Scalar, ...]:
    """The forces on the pack at the end: of the floor, of the sides, and its contacts."""
    floor = Scalar(
        "floor", "F", "N", "force of the floor at the end, from overlaps",
        lambda run: _rounded(p["kn"] * float(pressed(scene, run)[:, 2].sum()), FINE * weight),
        weight, weight, Exact(REST),
    )  # fmt: skip
    sides = Scalar(
        "sides", "S", "N", "difference of the forces of opposite sides at the end",
        lambda run: _rounded(sideways(p["kn"], scene, run), FINE * weight), 0.0, weight,
        Exact(REST),
    )  # fmt: skip
    coordination = Scalar(
        "coordination", "c", "", "contacts per sphere at the end, including those with walls",
        lambda run: _rounded(contacts(scene, run), COARSE), packing.CONTACTS, packing.CONTACTS,
        Exact(COUNTED),
    )  # fmt: skip
    return floor, sides, coordination


def _motions(p: Parameters, scene: Scene, weight: float) -> tuple[Scalar, ...]:
    """How far the pack has come to rest, and whether drag alone took its energy."""
    rest = Scalar(
        "still", "d", "m", "largest displacement of a sphere in the last sixteenth of the time",
        lambda run: _rounded(still(run), FINE * LARGEST), 0.0, LARGEST, Exact(REST),
    )  # fmt: skip
    heavy = Scalar(
        "momentum", "|P|/sum m v0", "", "total momentum at the end, over the sum of momenta at the "
        "start",
        lambda run: _rounded(momentum(scene, run), FINE), 0.0, 1.0, Exact(REST),
    )  # fmt: skip
    lost = Scalar(
        "decay", "E/E0", "", "kinetic energy at the end, over that at the start",
        lambda run: _rounded(float(moving(scene, run)[-1] / moving(scene, run)[0]), FINE), 0.0, 1.0,
        Exact(REST),
    )  # fmt: skip
    gain = Scalar(
        "gain", "max(E2 - E1)", "J", "growth of kinetic, spring and potential energy",
        lambda run: _rounded(gained(p, scene, run), FINE * LARGEST * weight), 0.0,
        2.0 * LARGEST * weight, Invariant(1e-3, DRAGGED),
    )  # fmt: skip
    return rest, heavy, lost, gain


DRAGGED = (
    "drag takes energy and nothing adds any; the energy of a leapfrog oscillates by (w dt)^2/8 of "
    "what contacts store, 6e-3 of a tenth of it, and velocities may be reported half a step late"
)
SLOWEST = (
    "half of all packs have less than 4e-9, but how long a pack takes to come to rest is chance"
)
REST = {
    method: Tolerance(
        0.5 * FINE,
        "residual motion: the slowest of 40 packs has 4e-6 after 2.1 s",
        slack=SLOWEST,
    )
    for method in (Method.SECOND_ORDER, Method.FIRST_ORDER)
}
COUNTED = {
    method: Tolerance(
        0.025,
        "springs that yield close a few more contacts: in 40 packs the mean is 3.012 +- 0.006 "
        "(95 %), and each lies between 2.97 and 3.05",
        slack="what lies between them counts as right, without an error",
    )
    for method in (Method.SECOND_ORDER, Method.FIRST_ORDER)
}
CASE = Case(
    name="packing",
    title="A packing at rest",
    source=Source(
        "Moukarzel (1998), Isostatic phase transition and instability in stiff granular "
        "materials, Physical Review Letters 81(8), 1634-1637",
        "10.1103/PhysRevLett.81.1634",
        "The paths of the spheres differ between codes after some collisions and are not compared; "
        "the laws of their state of rest are, over several seeds.",
    ),
    parameters=(
        Parameter("m", 0.01, "kg", "mass of the largest sphere"),
        Parameter("kn", 1e5, "N/m", "contact stiffness"),
        Parameter("eta", 0.2, "N s/m", "drag that brings all spheres to rest"),
        Parameter("g", 9.81, "m/s2", "gravity"),
    ),
    variants=tuple(
        Variant(
            f"seed-{seed}",
            f"{COUNT} spheres, random start {seed}",
            "F = sum m g; opposite sides push equally; 3 contacts per sphere",
            inert=frozenset({"kn", "eta"}),
            level=Level.QUICK if seed == 1 else Level.PAPER,
        )
        for seed in SEEDS
    ),
    declare=_declare,
)  # fmt: skip
