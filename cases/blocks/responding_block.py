"""A block on a shaking foundation, dragged along by friction in one, two and three directions."""

from __future__ import annotations

import functools
from collections.abc import Mapping

import numpy as np

from cases._papers import YAGODA_BIRAN_2016
from cases._penalty import RUNGS, levels
from cases.blocks.parts.responding import _bounds, _lift
from cases.blocks.parts.responding._bounds import DENSITY, SIDE, directions
from cases.blocks.parts.responding._slow import Path
from reference_solutions.blocks import responding_block
from vv.ask import Displacement, History, Knobs
from vv.case import (
    Case,
    Ladder,
    Level,
    Motion,
    Parameter,
    Parameters,
    Shown,
    Source,
    Trial,
    Variant,
    knob_grid,
)
from vv.scene import Block, Contact, Harmonic, Scene, Wall, box_geometry, polyhedron_inertia

FREE, FLAT = "3d-turning", 0.2  # a plate [m high] that can turn
SWUNG = 3.0  # how far springs swing where a moment reverses, over how far they bear it at rest
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
        free=np.array([True, directions(p) > 1, True]),
        free_spin=np.full(3, variant == FREE),
    )  # fmt: skip
    wall = Wall(np.zeros(3), UP, motion)
    return Scene((wall, block), Contact(np.inf, mu=p["mu"]), gravity=-p["g"] * UP)


def _path(p: Parameters) -> Path:
    """The exact motion, solved in as many directions as there are."""
    law = {"mu": p["mu"], "g": p["g"]}
    if directions(p) == 1:
        one = {"D": p["D"], "f": p["f"], **law}
        return lambda t: responding_block.one_direction(t, **one)[:, None]
    level = {"Dx": p["D"], "fx": p["f"], "Dy": p["Dy"], "fy": p["fy"], **law}
    if directions(p) == 2:
        return functools.partial(responding_block.two_directions, **level)
    return functools.partial(responding_block.three_directions, Dz=p["Dz"], fz=p["fz"], **level)


def _declare(variant: str, p: Parameters) -> Trial:
    if variant == FREE and not SWUNG * p["mu"] * FLAT < SIDE:
        raise ValueError(
            f"mu = {p['mu']!r}; the plate would tip on springs where friction reverses, "
            f"from {SIDE / FLAT / SWUNG:.3g} on"
        )
    _bounds.require_slow(p)
    goal, path = History(p["duration"], p["duration"] / SAMPLES), _path(p)
    axes = np.eye(3)[: directions(p)]
    motion = Motion(BLOCK, axes, path, goal.times(None), "m", _bounds.free_fall(p))
    if variant == "map":
        return Trial(Ladder(_scene(variant, p), goal, (BLOCK,), MAP), (motion.distance(EXPLORED),))
    judge = _bounds.in_plane(p, path, motion.size)
    along = {2: _lift.vertical(p, motion.size)} if len(axes) > 2 else {}
    parts = tuple(
        motion.component(
            i, f"d2{axis}", f"displacement of the block along {axis}", along.get(i, judge)
        )
        for i, axis in enumerate("xyz"[: len(axes)])
    )
    anywhere = _lift.in_space(p, path, motion.size)
    whole = (motion.distance(anywhere),) if len(axes) > 1 else ()
    timed = (RUNGS[0], STIFFER) if variant in ("1d", "2d", "3d") else ()
    stiffest = {FREE: TURNING, "1d": STIFFER_YET}.get(variant, STIFFEST)
    rungs = _resolved_levels(levels(STIFFER, stiffest), stiffest, p)
    if variant in ALIKE:
        rungs[Level.QUICK] = tuple(rung for rung in rungs[Level.QUICK] if rung != stiffest)
    return Trial(Ladder(_scene(variant, p), goal, (BLOCK,), rungs, timed), (*parts, *whole))


CHANCE = 0.2  # of the displacement: what may depend on how steps fit into the period
STIFFER, STIFFEST = Knobs(2.5e-4, 1e9), Knobs(2e-5, 1e11)
STIFFER_YET = Knobs(2e-5, 2e11)  # where friction that lags hides what 1 % less of it changes
TURNING = Knobs(4e-5, 1e11)  # where the block may turn, as that costs much more in each step
ALIKE = ("1d-mu-1", "2d", "3d")  # 1d and 3d-turning show their stiff springs at level quick
RESOLVED = (Knobs(1e-4, 1e9), Knobs(5e-5, 1e9))  # where one step at most is left
STIFFNESSES = (1e7, 2.4e7, 5.6e7, 1.3e8, 3.2e8, 7.5e8, 1.8e9, 4.2e9, 1e10)
STEPS = (5e-4, 2e-4, 1e-4, 5e-5, 2e-5, 1e-5)  # at 1e-3 explicit codes diverge on the stiffest
THIN = knob_grid((5e-4, 2e-4), (1e7, 7.5e8))  # its corners, stable in explicit codes too
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
    levels: Mapping[Level, tuple[Knobs, ...]], stiffest: Knobs, p: Parameters
) -> dict[Level, tuple[Knobs, ...]]:
    """The levels without steps so long that the answer depends on where reversals of slip fall.

    Every level has springs so stiff and steps so short that an error of 1 % of friction exceeds
    the bound of what they delay.
    """
    lost = _bounds.reversal_error(p) if directions(p) == 1 else 0.0
    fine = {
        level: tuple(
            rung for rung in dict.fromkeys((*rungs, stiffest)) if lost * (rung.dt or 0.0) <= CHANCE
        )
        for level, rungs in levels.items()
    }
    return {
        level: rungs if len(rungs) > 1 else (*RESOLVED, stiffest) for level, rungs in fine.items()
    }


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
