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
REST = np.full(3, -np.pi / 2)  # the phase at which 1 - cos starts at rest


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
    along = {2: Exact(_vertical_bounds(p))}
    parts = tuple(
        motion.component(
            i, f"d2{axis}", f"displacement of the block along {axis}", along.get(i, judge)
        )
        for i, axis in enumerate("xyz"[:directions])
    )
    whole = (motion.distance(judge),) if directions > 1 else ()
    timed = (RUNGS[0], STIFFER, STIFFEST) if variant in ("1d", "2d", "3d") else ()
    rungs = _resolved_levels(levels(STIFFER, STIFFEST), p)
    return Trial(Ladder(_scene(variant, p), goal, (BLOCK,), rungs, timed), (*parts, *whole))


STIFFER, STIFFEST = Knobs(2.5e-4, 1e9), Knobs(1e-4, 1e10)
RESOLVED = (Knobs(1e-4, 1e9), STIFFEST)  # for a level that is left with one step at most
STIFFNESSES = (1e7, 2.4e7, 5.6e7, 1.3e8, 3.2e8, 7.5e8, 1.8e9, 4.2e9, 1e10)
STEPS = (5e-4, 2e-4, 1e-4, 5e-5, 2e-5, 1e-5)  # at 1e-3 explicit codes diverge on the stiffest
THIN = knob_grid((5e-4, 2e-4), (1e7, 1.3e8, 7.5e8))  # stable in explicit codes too
MAP = {
    Level.QUICK: THIN[-1:],
    Level.DEFAULT: THIN,
    Level.PAPER: knob_grid(STEPS, STIFFNESSES),
}
EXPLORED = Shown(
    "a map over the step and the stiffness of springs in place of rigid contact. On soft springs "
    "blocks rock and creep, stiff springs need small steps; the map shows which settings are best, "
    "and none is judged"
)


def _resolved_levels(
    levels: Mapping[Level, tuple[Knobs, ...]], p: Parameters
) -> dict[Level, tuple[Knobs, ...]]:
    """The levels without steps so long that the answer depends on where reversals of slip fall.

    Every level has springs so stiff that an error of 1 % of friction exceeds that of their delay.
    """
    lost = _reversal_error(p) if _directions(p) == 1 else 0.0
    fine = {
        level: tuple(
            rung for rung in dict.fromkeys((*rungs, STIFFEST)) if lost * (rung.dt or 0.0) <= CHANCE
        )
        for level, rungs in levels.items()
    }
    return {level: rungs if len(rungs) > 1 else RESOLVED for level, rungs in fine.items()}


def _reversal_error(p: Parameters) -> float:
    """The error by reversals on whole steps, over the displacement [1/s]; see `_whole_steps`."""
    omega, friction = 2 * np.pi * p["f"], p["mu"] * p["g"]
    ends = np.pi * p["D"] * omega / (2 * friction) if friction else np.inf
    return float(0.5 * omega**2 * min(ends, p["duration"]))


def _tolerances(p: Parameters, path: Path) -> dict[Method, Tolerance]:
    """The tolerances: reversals of slip are located, or late by a part of a step or of 1/w."""
    directions = _directions(p)
    if directions == 1:
        way = float(np.abs(path(np.linspace(0.0, p["duration"], 101))).max())
    else:
        way = float(np.sqrt(p["D"] ** 2 + p["Dy"] ** 2 + (2 * p["Dz"]) ** 2))
    rate = p["mu"] * p["g"] * p["duration"] / (way or _fall(p))
    # f in Hz: delays add up faster at higher frequencies
    quick = 1 + p["f"] / 3 if directions == 1 else 1.0
    return {
        Method.EXACT: Tolerance(1e-13, LOCATED) if directions == 1 else _rounding(p, path),
        Method.SECOND_ORDER: _second(p) if directions == 1 else _rotating(p),
        Method.PENALTY: _late_reversals(rate, 0.07 * quick, 0.8),
        Method.LAGGING: _late_reversals(rate, 0.1 * quick, 2.0, "; lagging friction adds to it"),
    }


def _rounding(p: Parameters, path: Path) -> Tolerance:
    """For slip that rotates: displacements of base and slip are summed, and may nearly cancel."""
    turned = 2 * np.pi * max(p["f"], p["fy"]) * p["duration"]
    ways = np.abs(path(np.linspace(0.0, p["duration"], 101))).max(axis=0)[:2]
    lost = 0.1 * EPS * turned**2 * np.hypot(p["D"], p["Dy"])
    return Tolerance(
        float(np.clip(lost / ways.min(), 1e-13, LARGEST_TOLERANCE)) if ways.min() > 0 else 1e-13,
        f"{LOCATED}, and of the phases w T of the base, which add up in a slip that does not stop",
    )


def _whole_steps(p: Parameters) -> dict[Method, Tolerance]:
    """For first order: friction acts at ends of steps; empty if the bound at STEP is too large."""
    omega = 2 * np.pi * np.array([p["f"], p["fy"], p["fz"]][: _directions(p)])
    late = _reversal_error(p) if len(omega) == 1 else float(omega.max())
    bound = Tolerance(
        1e-9,
        "slip reverses on whole steps: the block keeps an error of speed of up to D w^2 dt for pi "
        "D w/(2 mu g), the time in which friction removes it. Where the direction of slip rotates, "
        "friction is late by up to w dt",
        late=late,
        slack="reversals fall on whole steps only if steps divide the period",
    )
    return {Method.FIRST_ORDER: bound} if late * STEP < LARGEST_TOLERANCE else {}


def _fall(p: Parameters) -> float:
    """The height of a free fall [m], which scales errors where nothing drags the block."""
    return 0.5 * p["g"] * p["duration"] ** 2


def _second(p: Parameters) -> Tolerance:
    """For motion along x with located reversals; the bound depends on whether the block sticks."""
    omega = 2 * np.pi * p["f"]
    if p["mu"] * p["g"] < STICKS * p["D"] * omega**2:
        return Tolerance(
            2e-9,
            "the block slips all the time, and its velocity is linear between reversals, which are "
            "located within the step: the tolerance of their location remains",
        )
    return Tolerance(
        float(np.clip((omega * STEP) ** 2 / 8, 2e-9, LARGEST_TOLERANCE)),
        "where the block sticks it follows the sine of the base, with an error of (w dt)^2/12",
        dt=STEP,
        order=2,
        floor=2e-9,
    )


def _rotating(p: Parameters) -> Tolerance:
    """For slip whose direction rotates."""
    omega = 2 * np.pi * max(p["f"], p["fy"], p["fz"] if p["Dz"] else 0.0)
    return Tolerance(
        float(np.clip(0.6 * (omega * STEP) ** 2, 1e-7, LARGEST_TOLERANCE)),
        "friction acts along the mean direction of slip over a step. Where the slip is slow its "
        "direction turns by more than w dt of the fastest sine, and the error is the square of "
        "that angle",
        dt=STEP,
        order=2,
        floor=1e-7,
    )


def _late_reversals(rate: float, by_springs: float, by_steps: float, more: str = "") -> Tolerance:
    """For late reversals of slip; rate: mu g T over the displacement [1/s]."""
    value = rate * by_springs * np.sqrt(MASS / SPRING)
    return Tolerance(
        float(np.clip(value, 1e-9, LARGEST_TOLERANCE)),
        "springs delay each reversal of slip by a fraction of 1/w, w^2 = kn/m, and reversals fall "
        "on whole steps; over the duration T the delays add up to mu g T "
        f"({by_springs:g}/w + {by_steps:g} dt){more}",
        kn=SPRING,
        softness=0.5,
        late=by_steps * rate,
    )


def _vertical_bounds(p: Parameters) -> dict[Method, Tolerance]:
    """For the vertical motion: the block follows the base, and sinks into springs that lift it."""
    omega = 2 * np.pi * p["fz"]
    way = np.hypot(2 * p["Dz"], p["D"])
    sinks = Tolerance(
        float(np.clip(2 * MASS * p["Dz"] * omega**2 / SPRING / way, 1e-9, LARGEST_TOLERANCE)),
        "the block sinks by m z''/kn as the base lifts it, and twice as far where it oscillates",
        kn=SPRING,
        softness=1,
        late=2e-2,
    )
    rests = Tolerance(
        1e-7, "contact is rigid: the block has the velocity of the base at the end of a step"
    )
    return {
        Method.EXACT: Tolerance(1e-12, LOCATED),
        Method.SECOND_ORDER: rests,
        Method.FIRST_ORDER: Tolerance(
            1e-9,
            "the block follows the base half a step late",
            late=float(omega) / 2,
            slack="some schemes have velocities at half steps, and no such delay",
        ),
        Method.PENALTY: sinks,
        Method.LAGGING: sinks,
    }


LOST = {
    Method.FIRST_ORDER: "friction that reverses on whole steps leaves an error of speed of up to "
    "what the base gains in a step, D w^2 dt. That is a large part of what friction gives the "
    "block in half a period, so that the result depends on how steps fit into the period"
}
LOCATED = "rounding errors of a few hundred located events"
EPS = float(np.finfo(float).eps)
STEP, SPRING, MASS = 1e-3, 1e8, DENSITY * SIDE**3  # s, N/m, kg
CHANCE = 0.2  # of the displacement: what may depend on how steps fit into the period
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
        "Secs. 3.4 and 4.5, Eqs. 11-13 and 16-18. The second line of Eq. 17 uses the direction of "
        "the base's acceleration, with which a slip begins; mu = 0.6 is chosen in 2D and 3D. g = "
        "9.81 m/s2.",
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
