"""A heavy ball drives a light one against a wall: the number of collisions spells pi."""

from __future__ import annotations

import math

import numpy as np

from reference_solutions.contact import galperin
from vv.ask import History, Knobs, Method, Run, Velocity
from vv.case import (
    Case,
    Count,
    Exact,
    Ladder,
    Level,
    Parameter,
    Parameters,
    Source,
    Tolerance,
    Trial,
    Variant,
)
from vv.scene import Contact, Scene, Spheres, Vector, Wall

RADIUS = 0.1  # m; does not enter the answer
LIGHT, HEAVY = Velocity(1), Velocity(2)
DEEPEST = 0.1  # overlap over the radius, beyond which contacts are not taken for such
SWOLLEN = 0.01  # a leapfrog overshoots the depth by (w dt)^2/8, 0.3 % at 20 steps a contact
CLEAR = 0.05  # of a collision: how far their number must be from changing
X = np.array([1.0, 0.0, 0.0])
BEYOND = 1.1  # of the time of the last collision between hard bodies: springs delay it
# outputs in the shortest time between two collisions; those of one pair are twice as far apart
SAMPLES = 2


def _masses(p: Parameters) -> dict[str, float]:
    return {"m": p["m"], "M": p["ratio"] * p["m"]}


def _scene(p: Parameters) -> Scene:
    """Wall, light ball at rest, heavy ball on its way to it; both keep to the line."""
    away = np.array([RADIUS + p["x"], 3 * RADIUS + p["X"]])
    balls = Spheres(
        position=away[:, None] * X,
        velocity=np.array([np.zeros(3), -p["v"] * X]),
        radius=np.full(2, RADIUS),
        mass=np.array(list(_masses(p).values())),
        free=np.array([[True, False, False]] * 2),
    )
    return Scene((Wall(np.zeros(3), X), balls), Contact(p["kn"]))


def _declare(variant: str, p: Parameters) -> Trial:
    masses, way = _masses(p), {name: p[name] for name in ("x", "X", "v")}
    due, last = galperin.collisions(**masses), galperin.last(**masses, **way)
    shortest = galperin.opening(**masses) ** 2 * p["x"] / p["v"]
    touch = math.pi * math.sqrt(p["m"] / p["kn"])
    if not touch < shortest:
        raise ValueError(
            f"kn = {p['kn']!r} N/m; a contact would last {touch:.3g} s, and must be shorter than "
            f"the {shortest:.3g} s between two collisions"
        )
    angles = math.pi / galperin.opening(**masses)
    if not abs(angles - round(angles)) >= CLEAR:
        raise ValueError(
            f"ratio = {p['ratio']!r}; pi over the angle of the walls is {angles:.6g}, so near a "
            f"whole number that the last collision only grazes; {CLEAR} is needed"
        )
    depth = p["v"] * math.sqrt(_masses(p)["M"] / p["kn"])
    if not depth <= (1.0 - SWOLLEN) * DEEPEST * RADIUS:
        raise ValueError(
            f"kn = {p['kn']!r} N/m; the light ball, when it has all energy, would overlap the wall "
            f"by {depth:.3g} m; at most a tenth of its radius is allowed"
        )
    interval = shortest / SAMPLES
    usual = max(BEYOND * last, last + touch + 2 * interval)
    goal = History(max(usual, _delayed(variant, p, due) + due / 2 * touch + interval), interval)
    levels = {
        level: tuple(Knobs(dt=touch / steps) for steps in rungs)
        for level, rungs in RUNGS[variant].items()
    }
    study = Ladder(_scene(p), goal, (LIGHT, HEAVY), levels)
    return Trial(study, (_number(p, due, touch),))


def _turn(p: Parameters, due: int, steps: float) -> float:
    """How far errors turn the direction of motion in Galperin's wedge [rad].

    A spring that closes or opens within a step gains or loses up to kn (v dt)^2/8 of energy,
    depending on where in the step it does. That turns the motion at random, by up to (w dt)^2/8
    times sine and cosine of its angle to the side; over n contacts the root of the sum of squares
    is that times sqrt(n/8). w^2 is kn/m where the light ball strikes the wall, and larger by
    kn/M where it strikes the other. steps: in a contact with the wall.
    """
    sides = math.hypot(1.0, 1.0 + 1.0 / p["ratio"]) / math.sqrt(2.0)
    return (math.pi / steps) ** 2 / 8 * math.sqrt(due / 8) * sides


def _is_clear(p: Parameters, due: int, steps: float) -> bool:
    """Whether twice that turn changes no number of collisions."""
    theta = galperin.opening(**_masses(p))
    angles = math.pi / theta
    return 2.0 * _turn(p, due, steps) / theta <= abs(angles - round(angles))


def _delayed(variant: str, p: Parameters, due: int) -> float:
    """The time of the last collision of a motion that errors of steps turned away from it [s].

    It counts the coarsest steps at which the number must be right.
    """
    rungs = (steps for level in RUNGS[variant].values() for steps in level)
    steps = min((one for one in rungs if _is_clear(p, due, one)), default=math.inf)
    theta = galperin.opening(**_masses(p))
    left = math.pi - due * theta - _turn(p, due, steps)
    return (p["X"] + p["x"] * math.tan(theta) / math.tan(left)) / p["v"]


def _number(p: Parameters, due: int, touch: float) -> Count:
    """touch: the time of a contact with the wall [s]."""
    spread = _turn(p, due, COARSEST) / galperin.opening(**_masses(p)) / due
    return Count(
        name="collisions",
        symbol="n",
        meaning="collisions of the balls with each other and of the light one with the wall",
        observe=_count_collisions,
        reference=due,
        judge=Exact({
            Method.EXACT: Tolerance(
                1e-6, "the number of collisions is either right or wrong", slack=RIGHT
            ),
            Method.SECOND_ORDER: Tolerance(
                spread,
                BLURRED,
                dt=touch / COARSEST,
                order=2,
                slack=RIGHT,
                least=lambda dt: 0.0 if _is_clear(p, due, touch / dt) else 1.0 / due,
            ),
        }),
    )  # fmt: skip


def _count_collisions(run: Run) -> int:
    """The number of times an approach ends: of the balls, and of the light one and the wall."""
    light, heavy = run.values[LIGHT] @ X, run.values[HEAVY] @ X
    return _count_approaches(heavy - light) + _count_approaches(light)


def _count_approaches(rate: Vector) -> int:
    """How often a distance stops shrinking, from its rate at the outputs."""
    return int(np.count_nonzero((rate[:-1] < 0) & (rate[1:] >= 0)))


COARSEST = 10  # steps in a contact
SHORT, LONG = (20, 40, 80, 160), (10, 20)
RUNGS = {
    "31": {Level.QUICK: SHORT[:3:2], Level.DEFAULT: SHORT, Level.PAPER: SHORT},
    "314": {Level.QUICK: LONG[:1], Level.DEFAULT: LONG[:1], Level.PAPER: LONG},
}
RIGHT = "a number that is right has no error"
BLURRED = (
    "a contact that begins and ends within a step changes the speed by up to (w dt)^2/8, randomly; "
    "n contacts change the direction by sqrt(n/8) times that. Where twice as much would change no "
    "number of collisions, it must be right; where it would, one collision more or fewer is allowed"
)
WHOLE = {"ratio": "the number of collisions is an integer: 1 % of the ratio changes it by a sixth"}
INERT = frozenset({"m", "x", "X", "v", "kn"})
UNFOLDED = "n = ceil(pi/theta) - 1, theta = atan(sqrt(m/M))"
CASE = Case(
    name="galperin",
    title="Collisions that compute pi",
    source=Source(
        "Galperin (2003), Playing pool with pi (the number pi from a billiard point of view), "
        "Regular and Chaotic Dynamics 8(4), 375-394",
        "10.1070/RD2003v008n04ABEH000252",
        "Bodies are hard there; here they are springs, which reflect the motion as hard bodies do "
        "while only one acts at a time. Collisions are counted from the velocities at the outputs, "
        "where an approach turns into a separation.",
    ),
    parameters=(
        Parameter("m", 1.0, "kg", "mass of the light ball"),
        Parameter("ratio", 100.0, "", "mass of the heavy ball over that of the light one"),
        Parameter("x", 1.0, "m", "gap between the light ball and the wall at the start"),
        Parameter(
            "X",
            1.1,
            "m",
            "gap between the heavy ball and the wall, less the diameter of the light one",
        ),
        Parameter("v", 1.0, "m/s", "speed of the heavy ball towards the light one"),
        Parameter("kn", 1.6e6, "N/m", "contact stiffness"),
    ),
    variants=(
        Variant("31", "mass ratio 100", UNFOLDED, inert=INERT, unseen=WHOLE),
        Variant(
            "314",
            "mass ratio 10 000",
            UNFOLDED,
            {"ratio": 1e4, "kn": 4e9},
            INERT,
            Level.PAPER,
            WHOLE,
        ),
    ),
    declare=_declare,
)
