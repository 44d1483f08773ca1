"""A sheet of spheres with friction at rest in a box, and one that friction alone holds up."""

from __future__ import annotations

import numpy as np

from cases._papers import LI_2018
from cases.hard.parts._knocked_sheet import (
    BOTH,
    FIRST,
    RADIUS,
    REPORTED,
    STEPS,
    observed_energies,
    reported_energies,
    require_closed,
)
from reference_solutions.contact import held_sphere, resting_lattice
from vv.ask import Displacement, History, Knobs, Method, Velocity
from vv.case import (
    Case,
    ComponentAlong,
    Exact,
    Ladder,
    Level,
    Parameter,
    Parameters,
    Quantity,
    Scalar,
    Series,
    Shown,
    Source,
    Tolerance,
    Trial,
    Variant,
)
from vv.scene import Contact, Scene, Spheres, Vector, Wall

X, Z = np.eye(3)[[0, 2]]
GOAL, EVERY = History(0.1, 1e-3), History(0.1, STEPS[0])  # an output at each of the longest steps


def _scene(p: Parameters) -> Scene:
    """The sheet in the plane of x and z, in which the spheres move; all may rotate."""
    place, width = resting_lattice.at_rest(
        n=int(p["n"]), rows=int(p["rows"]), r=RADIUS,
        m=p["m"], kn=p["kn"], g=p["g"], squeeze=p["squeeze"],
    )  # fmt: skip
    count = len(place)
    spheres = Spheres(
        position=place @ [X, Z],
        velocity=p["v"] * _directions(count) @ [X, Z],
        radius=np.full(count, RADIUS),
        mass=np.full(count, p["m"]),
        free=np.tile([True, False, True], (count, 1)),
        free_spin=np.ones((count, 3), bool),
    )
    walls = Wall(np.zeros(3), Z), Wall(np.zeros(3), X), Wall(width * X, -X)
    contact = Contact(p["kn"], p["ks"], p["mu"])
    return Scene((*walls, spheres), contact, gravity=-p["g"] * Z)


def _directions(count: int) -> Vector:
    """Unit vectors (count, 2), all different: each is turned by the golden angle from the last."""
    angle = np.pi * (3 - np.sqrt(5)) * np.arange(count)
    return np.stack([np.cos(angle), np.sin(angle)], axis=1)


def _held_scene(p: Parameters) -> Scene:
    """One sphere pressed between two upright walls; it may fall and turn."""
    half = RADIUS * (1 - p["squeeze"])
    sphere = Spheres(
        position=np.zeros((1, 3)),
        velocity=np.zeros((1, 3)),
        radius=np.array([RADIUS]),
        mass=np.array([p["m"]]),
        free=np.array([[True, False, True]]),
        free_spin=np.ones((1, 3), bool),
    )
    walls = Wall(-half * X, X), Wall(half * X, -X)
    return Scene((*walls, sphere), Contact(p["kn"], p["ks"], p["mu"]), gravity=-p["g"] * Z)


def _held_trial(p: Parameters) -> Trial:
    """The sphere oscillates on shear springs, or slides if friction does not bear its weight."""

    def height(t: Vector) -> Vector:
        law = {name: p[name] for name in ("m", "ks", "mu", "g")}
        return held_sphere.height(t, pressed=p["kn"] * RADIUS * p["squeeze"], **law)

    unit = float(np.sqrt(p["m"] / (2 * p["ks"])))
    seen = Displacement(2)
    sunk = Series(
        "z", "z", "m", "displacement upwards", ComponentAlong(seen, Z),
        height, _oscillation_bounds(unit),
    )  # fmt: skip
    rungs = tuple(Knobs(dt=step * unit) for step in SWINGS)
    levels = {Level.QUICK: rungs[:2], Level.DEFAULT: rungs, Level.PAPER: rungs}
    return Trial(Ladder(_held_scene(p), History(LASTS * unit, unit / 4), (seen,), levels), (sunk,))


def _declare(variant: str, p: Parameters) -> Trial:
    if variant == "held":
        return _held_trial(p)
    scene = _scene(p)
    bodies = range(FIRST, FIRST + len(scene.spheres))
    moved = tuple(Displacement(body) for body in bodies)
    moving = tuple(Velocity(body) for body in bodies if variant == "knocked")
    seen: tuple[Displacement | Velocity, ...] = (*moved, *moving)
    rungs = tuple(Knobs(dt=dt) for dt in STEPS)
    levels = {Level.QUICK: rungs[:2], Level.DEFAULT: rungs, Level.PAPER: rungs}
    if variant == "booked":
        require_closed(scene, p)
        return Trial(
            Ladder(scene, EVERY, moved, levels, energies=REPORTED),
            reported_energies(scene, p),
        )
    told = _at_rest(moved, p) if variant == "still" else observed_energies(scene, p, _gains(p))
    return Trial(Ladder(scene, GOAL, seen, levels), told)


def _at_rest(moved: tuple[Displacement, ...], p: Parameters) -> tuple[Quantity, ...]:
    return (
        Scalar(
            "moved", "max|u|", "m", "largest displacement of a sphere",
            lambda run: max(float(np.abs(run.values[what]).max()) for what in moved),
            0.0, p["m"] * p["g"] / p["kn"],
            Exact(dict.fromkeys((Method.SECOND_ORDER, Method.FIRST_ORDER), STILL)),
        ),
    )  # fmt: skip


def _gains(p: Parameters) -> Exact | Shown:
    """The bound of what shear springs and spins return, which was observed at the defaults only."""
    return RETURNS if dict(p) == CASE.defaults("knocked") else Shown(ELSEWHERE)


def _oscillation_bounds(unit: float) -> Exact:
    """unit: 1/w [s]."""
    coarsest = SWINGS[0]
    second = Tolerance(
        coarsest**2 / 24 * LASTS / 2 + coarsest**2 / 4,
        "the phase of the oscillation has a relative error of (w dt)^2/24, which counts with half "
        "of the amplitude; its start adds a fraction of (w dt)^2",
        dt=coarsest * unit,
        order=2,
    )
    late = Tolerance(
        0.4 * coarsest, "a weight that acts half a step late shifts the phase of the oscillation "
        "by w dt/2, of which half appears as an error", dt=coarsest * unit, order=1,
    )  # fmt: skip
    exact = Tolerance(1e-12, "an oscillation without events, exact to rounding")
    return Exact({Method.EXACT: exact, Method.SECOND_ORDER: second, Method.FIRST_ORDER: late})


SWINGS, LASTS = (0.05, 0.025, 0.0125), 20.0  # steps and duration, times w
# friction over its need at the lowest point of the oscillation: with 1 % less the sphere slips
HOLDS = 1.005
STILL = Tolerance(
    2e-10,
    "forces balance to the rounding of positions, kn eps x = 1e-10 N beside a weight of 13 N, and "
    "the motion that this starts is not damped",
    slack="codes round positions differently",
)
RETURNS = Exact(dict.fromkeys(BOTH, Tolerance(
    2e-2,
    "shear springs and spins, which are not observed, store at most 0.18 of the initial energy; "
    "where a code reports them they return 7e-3 of it, at any step",
)))  # fmt: skip
ELSEWHERE = (
    "how much shear springs and spins hold and return depends on all parameters; `above` and the "
    "variant `booked` judge at any parameters"
)
STICKS = "while friction holds the sphere its motion is that of the shear springs alone"
GENTLE = 1.5e-3  # m/s: 0.65 of the overlap of the weakest contact; friction takes a quarter
HELD_BY = HOLDS * 1.3 * 9.81 / (0.3 * 1e6 * RADIUS)  # of the radius: mu N = HOLDS m g
STEADY = dict.fromkeys(
    ("n", "rows", "m", "kn", "ks", "mu", "g", "squeeze"),
    "the positions of rest follow from them; the case judges that nothing moves",
)
LOST_ONLY = dict.fromkeys(
    (*STEADY, "v"), "the quantity judges that energy is only lost, whatever the amount"
)
KNOCKED = "E(t) <= E(s) for any s < t, E of motion, weight and springs"
CASE = Case(
    name="resting",
    title="A frictional lattice at rest",
    source=Source(
        *LI_2018,
        "The contact law is that of Eqs. 4-8. The sheet is chosen: 33 spheres, with all "
        "contacts closed and shear springs slack at t = 0, in the positions of equilibrium.",
    ),
    parameters=(
        Parameter("n", 6.0, "", "spheres in a long row", whole=True),
        Parameter("rows", 6.0, "", "rows, alternately long and short", whole=True),
        Parameter("m", 1.3, "kg", "mass of a sphere"),
        Parameter("kn", 1e6, "N/m", "normal contact stiffness"),
        Parameter("ks", 8e5, "N/m", "shear contact stiffness"),
        Parameter("mu", 0.3, "", "friction coefficient"),
        Parameter("g", 9.81, "m/s2", "gravity"),
        Parameter("squeeze", 2e-4, "", "difference of the widths of sheet and box"),
        Parameter("v", 0.0, "m/s", "initial speed of each sphere"),
    ),
    variants=(
        Variant("still", "left undisturbed for 0.1 s", "u = 0", unseen=STEADY),
        Variant(
            "knocked", "every sphere is given a velocity in another direction, for 0.1 s",
            KNOCKED, {"v": 0.02}, unseen=LOST_ONLY,
        ),
        Variant(
            "held",
            "a sphere pressed between two walls, with 0.5 % more friction than it needs to stay: "
            "with 1 % less it slips, with none it falls",
            "z = -(m g/2 ks)(1 - cos wt), w^2 = 2 ks/m, while m g < mu N, N = kn r squeeze; else "
            "it slides where its springs bear mu N",
            {"squeeze": HELD_BY}, frozenset({"n", "rows", "v"}),
            unseen=dict.fromkeys(("kn", "mu", "squeeze"), STICKS),
        ),
        Variant(
            "booked",
            "every sphere is knocked so gently that contacts slip and none opens; judged by the "
            "energies that the code reports, with those of spins and shear springs",
            f"{KNOCKED}; Q(t) >= Q(s), Q the energy dissipated by friction", {"v": GENTLE},
            unseen=LOST_ONLY,
        ),
    ),
    declare=_declare,
)  # fmt: skip
