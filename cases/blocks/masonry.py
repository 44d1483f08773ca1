"""A facade of blocks with a door, a window, lintels and an arch: at rest, sliding, shaken."""

from __future__ import annotations

import functools
import math

import numpy as np

from cases._papers import YAGODA_BIRAN_2016
from cases.blocks.parts import _balance, _sliding_wall
from cases.blocks.parts._sliding_wall import DEEP, DENSITY, HEIGHT, LENGTH
from reference_solutions.blocks import facade
from reference_solutions.hard import arch
from vv.ask import Displacement, History, Knobs, Method, Observable, Reaction, Run
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
    Shown,
    Source,
    Tolerance,
    Trial,
    Variant,
)
from vv.scene import Block, Contact, Harmonic, Scene, Vector, polyhedron_inertia

OUTLINE = ((0, 1, 2, 3), (7, 6, 5, 4), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0))
X, Y, Z = np.eye(3)
# columns courses min(columns, courses)^2 from which codes that solve equations take over a minute
COSTLIEST = 1.2e5
BED = 0  # the bedstone, on which all stands


def _prism(name: str, corners: Vector, held: bool = False) -> Block:
    """A prism from corners (4, 2) in the plane of x and z, in which alone it can move."""
    flat = np.insert(corners, 1, 0.0, axis=1)
    vertices = np.concatenate([flat - DEEP * Y, flat + DEEP * Y])
    mass, inertia = polyhedron_inertia(vertices, OUTLINE, DENSITY)
    free, turns = (Y > 1, Y > 1) if held else (Y == 0, Y != 0)
    return Block(name, vertices, OUTLINE, mass, inertia, np.zeros(3), free=free, free_spin=turns)


def _check_size(p: Parameters) -> None:
    """Raise ValueError for a facade without room for its openings, or too large to be solved."""
    columns, courses = int(p["columns"]), int(p["courses"])
    facade.openings(columns, courses)
    cost = float(columns) * courses * min(columns, courses) ** 2
    if not cost <= COSTLIEST:
        raise ValueError(
            f"columns = {p['columns']!r}, courses = {p['courses']!r}; equations of so many blocks "
            f"along and across have the size columns courses min(columns, courses)^2 = {cost:.3g}; "
            f"at most {COSTLIEST:g} are solved, in about a minute of calculation"
        )


def _check_friction(p: Parameters) -> None:
    """Raise ValueError if the arch slides apart on its joints."""
    inner, outer = facade.rings(int(p["columns"]), LENGTH)
    if not arch.stands(facade.VOUSSOIRS, 2 * (outer - inner) / (outer + inner), p["mu"]):
        raise ValueError(f"mu = {p['mu']!r}; whatever the thrust of the arch, a joint slides")


def _blocks(p: Parameters, arched: bool) -> list[Block]:
    """The bedstone, the courses from below, and the arch on top, from right to left."""
    columns, courses = int(p["columns"]), int(p["courses"])
    half = columns * LENGTH / 2
    bed = np.array([[-half, -HEIGHT], [half, -HEIGHT], [half, 0.0], [-half, 0.0]])
    blocks = [_prism("bedstone", bed, held=True)]
    for course, left, right in facade.courses(columns, courses, LENGTH):
        low, high = course * HEIGHT, (course + 1) * HEIGHT
        corners = np.array([[left, low], [right, low], [right, high], [left, high]])
        blocks.append(_prism(f"{course}-{left:g}", corners))
    for number, corners in enumerate(facade.arch(columns, LENGTH) if arched else ()):
        blocks.append(_prism(f"arch-{number}", corners + np.array([0.0, courses * HEIGHT])))
    return blocks


def _declare(variant: str, p: Parameters) -> Trial:
    still, slides = variant in STILL, variant in SLIDING
    _check_size(p)
    if still:
        _check_friction(p)
    blocks = _blocks(p, arched=not slides)
    w = 2 * math.pi * p["f"]
    shaking = Harmonic(-p["D"] * w**2 * X, p["f"] * X, np.full(3, math.pi / 2))
    scene = Scene(
        tuple(blocks), Contact(np.inf, mu=p["mu"]), gravity=-p["g"] * Z,
        shaking=None if still else shaking,
    )  # fmt: skip
    moving = tuple(Displacement(body) for body in range(len(blocks)) if body != BED)
    seen: tuple[Observable, ...] = moving
    borne = sum(block.mass for block in blocks) * p["g"]
    if variant in BORNE_BY:
        seen = (*moving, Reaction(BED), *_balance.watched(scene, BED))
    if still:
        quantities = _at_rest(moving, p, blocks)
    elif slides:
        quantities = _slides(moving, p, p == CASE.defaults(variant))
    else:
        quantities = (_farthest(moving, None, Shown(PATHS)),)
    if variant in BORNE_BY:
        quantities += () if still else (_base_shear(borne),)
        quantities += _balance.balance(scene, BED, p)
    lags = Tolerance(1e-4 if variant in SHAKEN else 1e-7, LAGS)
    allowed = {Method.SECOND_ORDER: CREEP, Method.LAGGING: lags}
    unexplained = EnergyAllowance(borne * LENGTH, allowed) if borne else None
    # only at the finer steps does an error of 1 % of friction show in a wall that slides
    fine = variant in (*SHAKEN, "slides")
    rungs: dict[Level, tuple[Knobs, ...]] = dict.fromkeys(Level, FINE if fine else RUNGS)
    if variant == "shaken":  # its path is only shown, and each step has its energy judged
        rungs |= {Level.QUICK: FINE[:1], Level.DEFAULT: FINE[:1]}
    goal = History(p["duration"], p["duration"] / 10)
    return Trial(Ladder(scene, goal, seen, rungs), quantities, unexplained)


def _at_rest(
    moving: tuple[Displacement, ...], p: Parameters, blocks: list[Block]
) -> tuple[Quantity, ...]:
    """For masonry at rest: its bedstone bears its weight, and nothing moves."""
    areas = facade.areas(int(p["columns"]), int(p["courses"]), LENGTH, HEIGHT)
    weight = (sum(areas) * 2 * DEEP * DENSITY + blocks[BED].mass) * p["g"]
    bears = Exact({Method.SECOND_ORDER: BORNE}, not_judged=SWINGS)
    return (
        Series(
            "borne", "R", "N", "vertical force that holds the bedstone",
            lambda run: run.values[Reaction(BED)][:, 2],
            lambda t: np.full(len(t), weight), bears,
        ),
        Series(
            "thrust", "T", "N", "horizontal force that holds the bedstone",
            lambda run: run.values[Reaction(BED)][:, 0],
            lambda t: np.zeros(len(t)), bears, still=weight,
        ),
        _farthest(moving, 0.0, Exact({Method.SECOND_ORDER: _creep(p), **_sagging(weight)})),
    )  # fmt: skip


def _creep(p: Parameters) -> Tolerance:
    """The displacement of masonry at rest on rigid contact."""
    return Tolerance(
        max(SOLVED * p["g"] * STEP * p["duration"] / LENGTH, ROUNDING),
        "at rest, contacts are solved to 5e-8 of the speed g dt that weight gains in a step, which "
        "lasts for the whole duration",
        dt=STEP,
        order=1,
        floor=ROUNDING,
        slack="what residuals move in one step they mostly move back in another",
    )


def _sagging(weight: float) -> dict[Method, Tolerance]:
    """The displacement of masonry at rest on springs."""
    sags = Tolerance(
        weight / 1e9 / LENGTH, "less than the rebound of one spring that is released from the "
        "whole weight",
        kn=1e9, softness=1.0, slack="slip at the start releases springs from a part of the weight "
        "only",
    )  # fmt: skip
    return {Method.PENALTY: sags, Method.LAGGING: sags}


def _slides(moving: tuple[Displacement, ...], p: Parameters, own: bool) -> tuple[Quantity, ...]:
    """For a wall without an arch: all of it slides on the bedstone as a single block does.

    own: the parameters are the case's, at which the wall is known to slide.
    """
    bounds = _sliding_wall.bounds(p, own)

    def slid(name: str, what: str, body: Displacement) -> Quantity:
        return Series(
            name, "u", "m", f"displacement along the base of the {what}",
            ComponentAlong(body, X), functools.partial(_sliding_wall.slid, p=p), bounds,
            still=2 * p["D"],
        )  # fmt: skip

    return (
        slid("lowest", "first block of the lowest course", moving[0]),
        slid("highest", "last block of the highest course", moving[-1]),
    )


def _farthest(
    moving: tuple[Displacement, ...], reference: float | None, judge: Exact | Shown
) -> Quantity:
    def farthest(run: Run) -> float:
        return max(float(np.linalg.norm(run.values[body], axis=1).max()) for body in moving)

    return Scalar(
        "moved", "max|u|", "m", "largest displacement of a block's centre",
        farthest, reference, LENGTH, judge,
    )  # fmt: skip


def _base_shear(weight: float) -> Quantity:
    return Scalar(
        "sheared", "max|T|", "N", "largest horizontal force on the bedstone at the ten output "
        "times",
        lambda run: float(np.abs(run.values[Reaction(BED)][:, 0]).max()), None, weight or 1.0,
        Shown(PATHS),
    )  # fmt: skip


RUNGS, FINE = (Knobs(2e-3, 1e9), Knobs(1e-3, 1e9)), (Knobs(1e-3, 1e9), Knobs(5e-4, 1e9))
STILL, SLIDING = ("rest", "rest-200"), ("slides", "slides-200")
SHAKEN = ("shaken", "borne", "shaken-200")
BORNE_BY = ("rest", "rest-200", "borne", "shaken-200")
SWINGS = dict.fromkeys(
    (Method.PENALTY, Method.LAGGING),
    "springs start as if friction held everything. Slip then releases some of them, and the force "
    "oscillates; on springs the integral of the force is judged instead",
)
# Of contacts at rest, over g dt: of nine walls at drawn parameters none left more than 8e-9 of that
# in a force, nor more than 2e-9 in a displacement.
SOLVED = 5e-8
STEP, ROUNDING = 2e-3, 1e-11  # s; of positions
BORNE = Tolerance(
    SOLVED,
    "contacts are solved to 5e-6 m/s or better, and at rest, where each step begins with the "
    "impulses of the last, to 5e-8 of the speed g dt that weight gains in a step",
    slack="weights are borne more exactly than the thrust, which friction shares among joints",
)
CREEP = Tolerance(1e-6, "rounding errors, and the work of contacts that are solved to 5e-6 m/s")
LAGS = (
    "with lagging friction, courses slip on one another and open-close iterations do not end: the "
    "step then uses contact forces of neither state, 3e-5 of m g L where stones separate, 5e-9 "
    "where they slide"
)
PATHS = (
    "how far shaken masonry falls apart depends on each impact before: converged runs differ by a "
    "hundredth, runs on springs by a tenth; the paper's geometry and record are not public"
)
LARGE, STRONG = {"columns": 16.0, "courses": 14.0}, {"D": 0.014, "f": 3.0}
NUMBERS = dict.fromkeys(
    ("columns", "courses"), "a number of blocks does not change when it grows by 1 %"
)
STEADY = {**NUMBERS, "mu": "masonry that stands does so with any friction that is large enough"}
FREE = dict.fromkeys(
    ("columns", "courses", "mu", "D", "f", "g"),
    "a variant without an exact answer is shown, not judged",
)
BORNE_ANYHOW = {
    **NUMBERS,
    "mu": "friction between blocks does not change the momentum of all",
}
CASE = Case(
    name="masonry",
    title="A facade with openings, lintels and an arch",
    source=Source(
        *YAGODA_BIRAN_2016,
        "The paper shakes a house of 197 blocks, whose geometry and record are not public. Here a "
        "plane facade of our own design takes its place.",
    ),
    parameters=(
        Parameter("columns", 6.0, "", "blocks along the facade", whole=True),
        Parameter("courses", 5.0, "", "courses of blocks", whole=True),
        Parameter("mu", 0.6, "", "friction coefficient"),
        Parameter("D", 0.05, "m", "amplitude of the base"),
        Parameter("f", 2.0, "Hz", "its frequency"),
        Parameter("g", 9.81, "m/s2", "gravity"),
        Parameter("duration", 0.1, "s", "time simulated"),
    ),
    variants=(
        Variant(
            "rest", "a small facade at rest", "R = sum of m g", {}, frozenset({"D", "f"}),
            unseen=STEADY,
        ),
        Variant(
            "slides", "a small facade without an arch slides on its base",
            "as one block on a base that moves, in the case responding-block",
            {"mu": 0.2, "duration": 0.5}, unseen=NUMBERS,
        ),
        Variant(
            "shaken", "a small facade shaken without damping", "no exact answer",
            {**STRONG, "duration": 0.5}, frozenset(), Level.DEFAULT, FREE,
        ),
        Variant(
            "borne", "the impulse that the bedstone gives a small facade that is shaken",
            "J = p + the integral of sum of m (g - a)",
            {"D": 0.02, "f": 4.0, "duration": 0.2}, frozenset(), Level.DEFAULT, BORNE_ANYHOW,
        ),
        Variant(
            "rest-200", "216 blocks at rest", "R = sum of m g",
            LARGE, frozenset({"D", "f"}), Level.PAPER, STEADY,
        ),
        Variant(
            "slides-200", "207 blocks without an arch slide on their base",
            "as one block on a base that moves, in the case responding-block",
            {**LARGE, "mu": 0.2, "duration": 0.5}, frozenset(), Level.PAPER, NUMBERS,
        ),
        Variant(
            "shaken-200", "216 blocks shaken without damping", "no exact answer",
            {**LARGE, **STRONG, "duration": 1.0}, frozenset(), Level.PAPER, FREE,
        ),
    ),
    declare=_declare,
    # rounding decides how far blocks creep
    enforced=frozenset(Check) - {Check.REGRESSION},
)  # fmt: skip
