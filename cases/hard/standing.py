"""Stacks and an arch that must stand still, and a slightly thinner arch that must fall."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Mapping

import numpy as np

from cases.hard.parts._standing_bounds import RESTS, SINKING, STANDS, fall_bounds, stack_bounds
from reference_solutions.hard import arch, falling_arch
from vv.ask import Displacement, History, Knobs, Method, Run
from vv.case import (
    Case,
    Check,
    ComponentAlong,
    EnergyAllowance,
    Exact,
    Ladder,
    Level,
    Parameter,
    Parameters,
    Quantity,
    Scalar,
    Series,
    Source,
    Trial,
    Variant,
)
from vv.scene import Block, Contact, Scene, Vector, Wall, polyhedron_inertia

MOST = 1000  # blocks: their shapes take less than a second
VOUSSOIRS, DEEP, DENSITY = 10, 0.25, 2500.0  # number, largest half depth [m], kg/m3
OUTLINE = ((0, 1, 2, 3), (7, 6, 5, 4), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0))
Y, Z = np.eye(3)[1:]
EPS = float(np.finfo(float).eps)


def _prism(name: str, corners: Vector, size: float) -> Block:
    """A prism from corners (4, 2) in the plane of x and z, in which alone it can move."""
    flat, deep = np.insert(corners, 1, 0.0, axis=1), DEEP * min(size, 1.0)
    vertices = np.concatenate([flat - deep * Y, flat + deep * Y])
    mass, inertia = polyhedron_inertia(vertices, OUTLINE, DENSITY)
    return Block(name, vertices, OUTLINE, mass, inertia, np.zeros(3), free=Y == 0, free_spin=Y != 0)


def _stack(p: Parameters) -> list[Block]:
    square = np.array([[-0.5, 0.0], [0.5, 0.0], [0.5, 1.0], [-0.5, 1.0]])
    up = np.array([0.0, 1.0])
    return [
        _prism(f"{k + 1}", p["size"] * (square + k * up), p["size"]) for k in range(int(p["n"]))
    ]


def _thickness(p: Parameters) -> float:
    """Thickness of the arch over its mean radius."""
    return p["part"] * arch.thinnest_of_chords(VOUSSOIRS)


def _arch(p: Parameters) -> list[Block]:
    t = _thickness(p)
    angle = np.linspace(0.0, np.pi, VOUSSOIRS + 1)
    edge = p["size"] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    inner, outer = (1 - t / 2) * edge, (1 + t / 2) * edge
    return [
        _prism(f"{k + 1}", np.array([inner[k], outer[k], outer[k + 1], inner[k + 1]]), p["size"])
        for k in range(VOUSSOIRS)
    ]


def _declare(variant: str, p: Parameters) -> Trial:
    if variant in ARCHES and not (p["part"] < 1.0 if variant == "arch-thin" else p["part"] > 1.0):
        rule = "below 1, where" if variant == "arch-thin" else "above 1, or"
        raise ValueError(f"part = {p['part']!r}; it must be {rule} the arch falls")
    if variant in ARCHES:
        _check_friction(p)
    elif not p["n"] <= MOST:
        raise ValueError(f"n = {p['n']!r}; at most {MOST} blocks are stacked")
    blocks = _arch(p) if variant in ARCHES else _stack(p)
    contact = Contact(np.inf, mu=p["mu"])
    scene = Scene((Wall(np.zeros(3), Z), *blocks), contact, gravity=-p["g"] * Z)
    seen = tuple(Displacement(body) for body in range(1, len(blocks) + 1))
    pace = _pace(p)
    goal = History(pace * GOALS[variant].duration, pace * GOALS[variant].interval)
    quantity = (
        _crown_sinking(p, goal)
        if variant == "arch-thin"
        else _moved(seen, p, STANDS if variant == "arch" else stack_bounds(p["n"]))
    )
    kn = _stiffness(p, pace)
    levels = dict.fromkeys(Level, tuple(Knobs(pace * dt, kn) for dt in STEPS[variant]))
    study = Ladder(scene, goal, seen, levels)
    weighed = sum(block.mass for block in blocks) * p["g"] * p["size"]
    least = SINKING if variant == "arch-thin" else RESTS
    unexplained = EnergyAllowance(weighed, {Method.SECOND_ORDER: least}) if weighed else None
    return Trial(study, (quantity,), unexplained)


def _pace(p: Parameters) -> float:
    """By what times are multiplied: a half or less where blocks are small, or their weight large.

    A step in which weight moves a block by its own size cannot tell which of its corners touch.
    """
    quick = p["g"] / 9.81 / p["size"]
    return 0.5 ** max(0, math.ceil(math.log2(max(quick, 1.0) / 1.2) / 2.0))


def _stiffness(p: Parameters, pace: float) -> float:
    """The stiffness [N/m] of springs on which blocks swing alike in each step, see `_pace`.

    It is in proportion to the mass of a block, which is at most half a metre deep.
    """
    return 1e9 * p["size"] ** 2 * min(p["size"], 1.0) / pace**2


def _check_friction(p: Parameters) -> None:
    """Raise ValueError where an arch slides apart; a thinner one counts as just thick enough."""
    thick = max(_thickness(p), JUST_STANDS * arch.thinnest_of_chords(VOUSSOIRS))
    if not arch.stands(VOUSSOIRS, thick, p["mu"]):
        raise ValueError(
            f"mu = {p['mu']!r}; whatever the thrust of an arch of this thickness, a joint slides"
        )


def _moved(seen: tuple[Displacement, ...], p: Parameters, judge: Exact) -> Quantity:
    return Scalar(
        "moved", "max|u|", "m", "largest displacement of a block's centre",
        lambda run: _farthest(run, seen), 0.0, p["size"], judge,
    )  # fmt: skip


def _crown_sinking(p: Parameters, goal: History) -> Quantity:
    falls = functools.partial(
        falling_arch.crown_drop, n=VOUSSOIRS, thick=_thickness(p), size=p["size"], g=p["g"]
    )
    judge = fall_bounds(_pace(p))
    _check_resolved(p, falls, goal, judge)
    return Series(
        "sunk", "d", "m", "downward displacement of the voussoir beside the crown",
        ComponentAlong(Displacement(VOUSSOIRS // 2), -Z),
        falls,
        judge,
    )  # fmt: skip


def _check_resolved(
    p: Parameters, falls: Callable[[Vector], Vector], goal: History, judge: Exact
) -> None:
    """Raise ValueError where rounding of positions exceeds the smallest tolerance of the fall."""
    finest = Knobs(_pace(p) * STEPS["arch-thin"][-1])
    allowed = judge.tolerance(Method.SECOND_ORDER).at(finest)
    drop = float(falls(np.array([goal.duration]))[-1])
    if not drop * allowed >= EPS * p["size"]:
        raise ValueError(
            f"g = {p['g']!r} m/s2; the crown falls by {drop:.3g} m, {allowed:.3g} of "
            f"which is below the rounding of positions, {EPS * p['size']:.3g} m"
        )


def _farthest(run: Run, seen: tuple[Displacement, ...]) -> float:
    return max(float(np.linalg.norm(run.values[what], axis=1).max()) for what in seen)


ARCHES = ("arch", "arch-thin")
JUST_STANDS = 1.0 + 1e-9  # of the smallest thickness, so that rounding does not decide
STEPS: Mapping[str, tuple[float, ...]] = {
    **dict.fromkeys(("stack-10", "stack-20"), (5e-2, 2e-2)),
    "stack-100": (1e-1, 5e-2),
    "arch": (1e-2, 5e-3),
    "arch-thin": (2.5e-3, 1.25e-3),
}  # s, as are these durations and intervals, all times `_pace`
GOALS = {
    **dict.fromkeys(("stack-10", "stack-20", "stack-100"), History(10.0, 1.0)),
    "arch": History(1.0, 0.1),
    "arch-thin": History(0.2, 0.02),
}
FOR_ARCHES = frozenset({"part"})
STEADY = "a structure that stands does so at any size and weight, and with any sufficient friction"
STACKED = dict.fromkeys(("size", "n", "mu", "g"), STEADY)
CASE = Case(
    name="standing",
    title="Stacks and an arch that stand, and one that falls",
    source=Source(
        "Heyman (1969), The safety of masonry arches, International Journal of Mechanical Sciences "
        "11(4), 363-385",
        "10.1016/0020-7403(69)90070-8",
        "The thinnest arch of ten voussoirs over a half circle is t/R = 0.1074601; with straight "
        "edges, as here, 0.1070114. The stacks are our choice: a contact solver that passes loads "
        "from block to block needs more sweeps for a taller stack.",
    ),
    parameters=(
        Parameter("size", 1.0, "m", "side of a block, mean radius of the arch"),
        Parameter("n", 10.0, "", "number of blocks in the stack", whole=True),
        Parameter("part", 1.01, "", "thickness of the arch over the smallest at which it stands"),
        Parameter("mu", 0.6, "", "friction coefficient"),
        Parameter("g", 9.81, "m/s2", "gravity"),
    ),
    variants=(
        Variant("stack-10", "ten cubes for 10 s", "u = 0", {}, FOR_ARCHES, unseen=STACKED),
        Variant(
            "stack-20", "twenty cubes for 10 s", "u = 0", {"n": 20.0}, FOR_ARCHES, Level.DEFAULT,
            STACKED,
        ),
        Variant(
            "arch", "ten voussoirs, t/R 1 % above the smallest that stands, for 1 s",
            "u = 0 for t > t_min",
            {"mu": 1.0}, frozenset({"n"}), unseen={
                **dict.fromkeys(("size", "mu", "g"), STEADY),
                "part": "a thicker arch stands too, and one that is 1 % thinner falls: arch-thin",
            },
        ),
        Variant(
            "arch-thin",
            "ten voussoirs, t/R 1 % below the smallest that stands: the arch falls, for 0.2 s",
            "a mechanism of five hinges, from rest", {"mu": 1.0, "part": 0.99},
            frozenset({"n", "mu"}), Level.DEFAULT,
        ),
        Variant(
            "stack-100", "a hundred cubes for 10 s", "u = 0", {"n": 100.0}, FOR_ARCHES, Level.PAPER,
            STACKED,
        ),
    ),
    declare=_declare,
    # rounding decides how far a stack creeps
    enforced=frozenset(Check) - {Check.REGRESSION},
)  # fmt: skip
