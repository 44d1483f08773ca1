"""A block on a shaking foundation, dragged along by friction in one, two and three directions."""

from __future__ import annotations

import functools
from collections.abc import Callable, Mapping

import numpy as np

from cases._papers import YAGODA_BIRAN_2016
from cases._penalty import RUNGS, levels
from reference_solutions.blocks import responding_block
from vv.ask import Displacement, History, Knobs, Method
from vv.case import (
    LARGEST_TOLERANCE,
    Case,
    Exact,
    Ladder,
    Level,
    Motion,
    Parameter,
    Parameters,
    Shown,
    Source,
    Tolerance,
    Trial,
    Variant,
    knob_grid,
)
from vv.scene import Block, Contact, Harmonic, Scene, Vector, Wall, box_geometry, polyhedron_inertia

Path = Callable[[Vector], Vector]  # times (k,) -> displacements (k, directions)

SIDE, DENSITY = 1.0, 2500.0  # m, kg/m3: neither enters the answer
FREE, FLAT = "3d-turning", 0.2  # a plate [m high] that can turn
SAMPLES = 500  # outputs of a history: twenty a cycle at 5 Hz over 5 s
BLOCK = Displacement(1)
UP = np.array([0.0, 0.0, 1.0])
REST = np.full(3, -np.pi / 2)  # the phase at which 1 - cos stands still


def _scene(variant: str, p: Parameters) -> Scene:
    """A cube that cannot rotate, on a level wall that moves by D (1 - cos 2 pi f t) along axes.

    A plate that can rotate stays level: the contact pressure shifts along the direction of
    friction and balances its moment.
    """
    moved = np.array([p["D"], p["Dy"], p["Dz"]])
    motion = Harmonic(moved, np.array([p["f"], p["fy"], p["fz"]]), REST)
    half = np.array([SIDE, SIDE, FLAT if variant == FREE else SIDE]) / 2
    vertices, faces = box_geometry(half[2] * UP, half, np.eye(3))
    mass, inertia = polyhedron_inertia(vertices, faces, DENSITY)
    block = Block(
        "block", vertices, faces, mass, inertia,
        velocity=np.zeros(3),
        free=np.array([True, _directions(p) > 1, True]),
        free_spin=np.full(3, variant == FREE),
    )  # fmt: skip
    wall = Wall(np.zeros(3), UP, motion)
    return Scene((wall, block), Contact(np.inf, mu=p["mu"]), gravity=-p["g"] * UP)


def _directions(p: Parameters) -> int:
    """Number of axes along which the block is free: up to the last one that is shaken."""
    for name in ("Dy", "Dz"):
        if p[name] < 0:
            raise ValueError(f"{name} = {p[name]!r} m; an amplitude must be zero or more")
    return 3 if p["Dz"] > 0 else 2 if p["Dy"] > 0 else 1


def _path(p: Parameters) -> Path:
    """The exact motion, solved in as many directions as there are."""
    law = {"mu": p["mu"], "g": p["g"]}
    if _directions(p) == 1:
        one = {"D": p["D"], "f": p["f"], **law}
        return lambda t: responding_block.one_direction(t, **one)[:, None]
    level = {"Dx": p["D"], "fx": p["f"], "Dy": p["Dy"], "fy": p["fy"], **law}
    if _directions(p) == 2:
        return functools.partial(responding_block.two_directions, **level)
    return functools.partial(responding_block.three_directions, Dz=p["Dz"], fz=p["fz"], **level)


def _declare(variant: str, p: Parameters) -> Trial:
    if variant == FREE and not p["mu"] * FLAT < SIDE:
        raise ValueError(f"mu = {p['mu']!r}; the plate would tip")
    goal, path, directions = (
        History(p["duration"], p["duration"] / SAMPLES),
        _path(p),
        _directions(p),
    )
    motion = Motion(BLOCK, np.eye(3)[:directions], path, goal.times(None), "m", _fall(p))
    if variant == "map":
        return Trial(Ladder(_scene(variant, p), goal, (BLOCK,), MAP), (motion.distance(EXPLORED),))
    first = _whole_steps(p)
    judge = Exact(_tolerances(p, path) | first, not_judged={} if first else LOST)
    along = {2: Exact(_lifted(p))}
    parts = tuple(
        motion.component(
            i, f"d2{axis}", f"displacement of the block along {axis}", along.get(i, judge)
        )
        for i, axis in enumerate("xyz"[:directions])
    )
    whole = (motion.distance(judge),) if directions > 1 else ()
    timed = (RUNGS[0], STIFFER, STIFFEST) if variant in ("1d", "2d", "3d") else ()
    rungs = _resolved(levels(STIFFER, STIFFEST), p)
    return Trial(Ladder(_scene(variant, p), goal, (BLOCK,), rungs, timed), (*parts, *whole))


STIFFER, STIFFEST = Knobs(2.5e-4, 1e9), Knobs(1e-4, 1e10)
RESOLVED = (Knobs(1e-4, 1e9), STIFFEST)  # where hardly any other step is
STIFFNESSES = (1e7, 2.4e7, 5.6e7, 1.3e8, 3.2e8, 7.5e8, 1.8e9, 4.2e9, 1e10)
STEPS = (5e-4, 2e-4, 1e-4, 5e-5, 2e-5, 1e-5)  # at 1e-3 explicit codes diverge on the stiffest
THIN = knob_grid((5e-4, 2e-4), (1e7, 1.3e8, 7.5e8))  # stable in explicit codes too
MAP = {
    Level.QUICK: THIN[-1:],
    Level.DEFAULT: THIN,
    Level.PAPER: knob_grid(STEPS, STIFFNESSES),
}
EXPLORED = Shown(
    "a map over stiffness and step of springs that stand for rigid contact: soft springs rock and "
    "creep, stiff ones need small steps; it shows which are best, and none is judged"
)


def _resolved(
    levels: Mapping[Level, tuple[Knobs, ...]], p: Parameters
) -> dict[Level, tuple[Knobs, ...]]:
    """The levels without steps on which an answer is chance, as turns of the slip come on them.

    Each has springs stiff enough to see 1 % of friction through what they delay.
    """
    lost = _kept(p) if _directions(p) == 1 else 0.0
    fine = {
        level: tuple(
            rung for rung in dict.fromkeys((*rungs, STIFFEST)) if lost * (rung.dt or 0.0) <= CHANCE
        )
        for level, rungs in levels.items()
    }
    return {level: rungs if len(rungs) > 1 else RESOLVED for level, rungs in fine.items()}


def _kept(p: Parameters) -> float:
    """What it keeps of what the base gains in a step, over its way [1/s]: see `_whole_steps`."""
    omega, friction = 2 * np.pi * p["f"], p["mu"] * p["g"]
    ends = np.pi * p["D"] * omega / (2 * friction) if friction else np.inf
    return float(0.5 * omega**2 * min(ends, p["duration"]))


def _tolerances(p: Parameters, path: Path) -> dict[Method, Tolerance]:
    """What codes can do: turns of the slip located, or late by a part of a step or of 1/w."""
    directions = _directions(p)
    if directions == 1:
        way = float(np.abs(path(np.linspace(0.0, p["duration"], 101))).max())
    else:
        way = float(np.sqrt(p["D"] ** 2 + p["Dy"] ** 2 + (2 * p["Dz"]) ** 2))
    rate = p["mu"] * p["g"] * p["duration"] / (way or _fall(p))
    quick = 1 + p["f"] / 3 if directions == 1 else 1.0  # Hz: what is late adds up the faster
    return {
        Method.EXACT: Tolerance(1e-13, LOCATED) if directions == 1 else _rounded(p, path),
        Method.SECOND_ORDER: _second(p) if directions == 1 else _rotating(p),
        Method.PENALTY: _late(rate, 0.07 * quick, 0.8),
        Method.LAGGING: _late(rate, 0.1 * quick, 2.0, "; friction that lags adds to it"),
    }


def _rounded(p: Parameters, path: Path) -> Tolerance:
    """Where the slip turns: the base and the slip on it are summed, which may nearly cancel."""
    turned = 2 * np.pi * max(p["f"], p["fy"]) * p["duration"]
    ways = np.abs(path(np.linspace(0.0, p["duration"], 101))).max(axis=0)[:2]
    lost = 0.1 * EPS * turned**2 * np.hypot(p["D"], p["Dy"])
    return Tolerance(
        float(np.clip(lost / ways.min(), 1e-13, LARGEST_TOLERANCE)) if ways.min() > 0 else 1e-13,
        f"{LOCATED}, and of the phases w T of the base: a slip that does not stop sums them up",
    )


def _whole_steps(p: Parameters) -> dict[Method, Tolerance]:
    """Of first order, by friction at the ends of steps; none where that says nothing at STEP."""
    omega = 2 * np.pi * np.array([p["f"], p["fy"], p["fz"]][: _directions(p)])
    late = _kept(p) if len(omega) == 1 else float(omega.max())
    bound = Tolerance(
        1e-9,
        "a slip that turns back does so on a whole step, by which the block keeps up to D w^2 dt "
        "for pi D w/(2 mu g), the time in which friction ends it; where slip turns its direction, "
        "friction is late by up to w dt",
        late=late,
        slack="reversals fall on whole steps only if steps divide the period",
    )
    return {Method.FIRST_ORDER: bound} if late * STEP < LARGEST_TOLERANCE else {}


def _fall(p: Parameters) -> float:
    """How far [m] it would fall freely: the scale of errors where nothing drags the block."""
    return 0.5 * p["g"] * p["duration"] ** 2


def _second(p: Parameters) -> Tolerance:
    """Along x, where turns are located within the step; whether the block sticks in between."""
    omega = 2 * np.pi * p["f"]
    if p["mu"] * p["g"] < STICKS * p["D"] * omega**2:
        return Tolerance(
            2e-9,
            "it slips all the time, at a velocity that is straight between turns, which are "
            "located within the step; what remains is the tolerance they are located to",
        )
    return Tolerance(
        float(np.clip((omega * STEP) ** 2 / 8, 2e-9, LARGEST_TOLERANCE)),
        "where it sticks it follows a sine, with an error of (w dt)^2/12",
        dt=STEP,
        order=2,
        floor=2e-9,
    )


def _rotating(p: Parameters) -> Tolerance:
    """Where the direction of slip rotates."""
    omega = 2 * np.pi * max(p["f"], p["fy"], p["fz"] if p["Dz"] else 0.0)
    return Tolerance(
        float(np.clip(0.6 * (omega * STEP) ** 2, 1e-7, LARGEST_TOLERANCE)),
        "friction acts along the mean direction of a step; where the slip is short its direction "
        "turns by more than w dt of the quickest sine, which enters by its square",
        dt=STEP,
        order=2,
        floor=1e-7,
    )


def _late(rate: float, by_springs: float, by_steps: float, more: str = "") -> Tolerance:
    """rate: mu g T over the way [1/s], of what is late at each turn of the slip."""
    value = rate * by_springs * np.sqrt(MASS / SPRING)
    return Tolerance(
        float(np.clip(value, 1e-9, LARGEST_TOLERANCE)),
        "springs delay each turn of the slip by a part of 1/w, w^2 = kn/m, and turns come on whole "
        f"steps: over the whole duration T that adds up to mu g T ({by_springs:g}/w + "
        f"{by_steps:g} dt){more}",
        kn=SPRING,
        softness=0.5,
        late=by_steps * rate,
    )


def _lifted(p: Parameters) -> dict[Method, Tolerance]:
    """Upwards, where the block follows the base, and sinks into springs as the base lifts it."""
    omega = 2 * np.pi * p["fz"]
    way = np.hypot(2 * p["Dz"], p["D"])
    sinks = Tolerance(
        float(np.clip(2 * MASS * p["Dz"] * omega**2 / SPRING / way, 1e-9, LARGEST_TOLERANCE)),
        "the block sinks by m z''/kn as the base lifts it, twice as far where it starts to swing",
        kn=SPRING,
        softness=1,
        late=2e-2,
    )
    rests = Tolerance(
        1e-7, "contact is rigid: the block follows the base, as the velocity at the end of a step"
    )
    return {
        Method.EXACT: Tolerance(1e-12, LOCATED),
        Method.SECOND_ORDER: rests,
        Method.FIRST_ORDER: Tolerance(
            1e-9,
            "the block follows the base half a step late",
            late=float(omega) / 2,
            slack="not if its velocity is that of a half step, as it is in some schemes",
        ),
        Method.PENALTY: sinks,
        Method.LAGGING: sinks,
    }


LOST = {
    Method.FIRST_ORDER: "friction that turns on whole steps lets the block keep whatever velocity "
    "is less than the base gains in a step, D w^2 dt, a large part of what friction gives it in "
    "half a period: what comes of it depends on how steps and period fit"
}
LOCATED = "rounding errors of a few hundred located events"
EPS = float(np.finfo(float).eps)
STEP, SPRING, MASS = 1e-3, 1e8, DENSITY * SIDE**3  # s, N/m, kg
CHANCE = 0.2  # of the way: what may hang of how steps and period fit in a step that is judged
STICKS = 0.45  # of the base's acceleration: with less friction than that the block always slips
ONE = (
    "d_2'' = mu g sign(d_1' - d_2') while it slips; d_2'' = d_1'' while d_2' = d_1' and "
    "|d_1''| <= mu g; d_1 = D (1 - cos 2 pi f t)"
)
MORE = (
    "d_2'' = mu (g + d_1z'') w/|w|, w = d_1' - d_2' the slip in the plane, or d_1'' while w = 0 "
    "and |d_1''| <= mu (g + d_1z'')"
)


def _variants() -> tuple[Variant, ...]:
    """The combinations of Figs. 21-25: along x, in the plane, and with the base lifting too."""
    one = [
        Variant(name, f"along x: D {p['D']:g} m, {p['f']:g} Hz, mu {p['mu']:g}", ONE, p,
                inert=frozenset({"fy", "fz"}), level=level)
        for name, level, p in (
            ("1d", Level.QUICK, {"D": 0.2, "f": 2.0, "mu": 0.6}),
            ("1d-3hz", Level.PAPER, {"D": 0.2, "f": 3.0, "mu": 0.6}),
            ("1d-5hz", Level.DEFAULT, {"D": 0.2, "f": 5.0, "mu": 0.6}),
            ("1d-0.3m", Level.PAPER, {"D": 0.3, "f": 1.0, "mu": 0.6}),
            ("1d-0.5m", Level.PAPER, {"D": 0.5, "f": 1.0, "mu": 0.6}),
            ("1d-1m", Level.DEFAULT, {"D": 1.0, "f": 1.0, "mu": 0.6}),
            ("1d-mu-0.1", Level.DEFAULT, {"D": 0.5, "f": 1.0, "mu": 0.1}),
            ("1d-mu-1", Level.QUICK, {"D": 0.5, "f": 1.0, "mu": 1.0}),
        )
    ]  # fmt: skip
    return (
        *one,
        Variant("2d", "along x and y: 0.3 m, 2 Hz and 0.2 m, 4 Hz", MORE,
                {"D": 0.3, "f": 2.0, "Dy": 0.2, "fy": 4.0}, inert=frozenset({"fz"})),
        Variant("3d", "along x, y and z: 0.1 m at 2, 4 and 1 Hz", MORE,
                {"D": 0.1, "f": 2.0, "Dy": 0.1, "fy": 4.0, "Dz": 0.1, "fz": 1.0}),
        Variant(FREE, "the same for a plate that is free to rotate, but does not", MORE,
                {"D": 0.1, "f": 2.0, "Dy": 0.1, "fy": 4.0, "Dz": 0.1, "fz": 1.0, "duration": 2.0}),
        Variant("map", "3d over contact stiffness and step, as in Fig. 23", MORE,
                {"D": 0.1, "f": 2.0, "Dy": 0.1, "fy": 4.0, "Dz": 0.1, "fz": 1.0},
                level=Level.DEFAULT),
    )  # fmt: skip


CASE = Case(
    name="responding-block",
    title="Block on a shaking foundation",
    source=Source(
        *YAGODA_BIRAN_2016,
        "Secs. 3.4 and 4.5, Eqs. 11-13 and 16-18. The second line of Eq. 17 takes the direction "
        "of the base's acceleration, where a slip begins; mu = 0.6 is chosen in 2D and 3D. "
        "g = 9.81 m/s2.",
    ),
    parameters=(
        Parameter("D", 0.2, "m", "amplitude of the base along x"),
        Parameter("f", 2.0, "Hz", "its frequency"),
        Parameter("mu", 0.6, "", "friction coefficient"),
        Parameter("Dy", 0.0, "m", "amplitude of the base along y"),
        Parameter("fy", 1.0, "Hz", "its frequency"),
        Parameter("Dz", 0.0, "m", "amplitude of the base along z"),
        Parameter("fz", 1.0, "Hz", "its frequency"),
        Parameter("g", 9.81, "m/s2", "gravity"),
        Parameter("duration", 5.0, "s", "time simulated"),
    ),
    variants=_variants(),
    declare=_declare,
    published={
        "Sec. 3.4": "2D-DDA along x: generally below 5 %, more sensitive to friction than to "
        "amplitude.",
        "Fig. 18": "3D-DDA along x: below 3 % most of the time at 2 and 3 Hz, below 10 % at 5 Hz, "
        "where it grows with time.",
        "Fig. 19": "The same over amplitudes: below 7 % at 0.3 m, and below 1 % at 0.5 and 1 m, "
        "most of the time.",
        "Fig. 20": "The same over friction: below 7 % for mu = 1, and below 1 % for 0.1 and 0.6.",
        "Figs. 21, 22": "3D-DDA along x and y: below 10 %, growing with time.",
        "Fig. 23": "3D-DDA along x, y and z: best between 1e7 and 1e9 N/m, below 3 % at 1e7 N/m, "
        "well below 10 % at 1e8 and 1e9 N/m.",
    },
)
