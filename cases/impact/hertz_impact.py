"""Elastic spheres meet head-on, or a rigid wall: force, overlap and duration are Hertz's."""

from __future__ import annotations

import functools

import numpy as np

from cases._energy_balance import balance
from cases.impact.parts._materials import (
    CHUNG_OOI_2011,
    defaults,
    mass,
    moduli,
    require_shallow,
)
from cases.impact.parts._peaks import growth, smooth_maximum
from reference_solutions.impact import hertz
from vv.ask import Displacement, History, Knobs, Method, Run, Velocity
from vv.case import (
    Case,
    ComponentAlong,
    Exact,
    Ladder,
    Level,
    Parameter,
    Parameters,
    Scalar,
    Series,
    Tolerance,
    Trial,
    Variant,
)
from vv.scene import Contact, Hertz, Scene, Spheres, Vector, Wall

X = np.array([1.0, 0.0, 0.0])
STEPS = (100, 200, 400, 1600)  # in the duration of the contact
SEEN, LASTS = 100, 1.5  # outputs in that duration; duration of the run over it
PAIRS = ("glass", "limestone")


def _scene(pair: bool, p: Parameters) -> Scene:
    """Two spheres that approach each other, or one and a wall; they touch at t = 0."""
    spheres = Spheres(
        position=np.outer([1.0, -1.0] if pair else [1.0], p["R"] * X),
        velocity=np.outer([-1.0, 1.0] if pair else [-1.0], p["v"] * X),
        radius=np.full(1 + pair, p["R"]),
        mass=np.full(1 + pair, mass(p)),
        free=np.tile([True, False, False], (1 + pair, 1)),
    )
    bodies = (spheres,) if pair else (spheres, Wall(np.zeros(3), X))
    law = moduli(p, 1 + pair)
    return Scene(bodies, Contact(0.0, hertz=Hertz(law.modulus)))


def _law(pair: bool, p: Parameters) -> dict[str, float]:
    """m, K and v as `reference_solutions.impact.hertz` takes them."""
    share = 1 + pair
    factor = hertz.normal_factor(modulus=moduli(p, share).modulus, radius=p["R"] / share)
    return {"m": mass(p) / share, "K": factor, "v": p["v"] * share}


def _approach(pair: bool, kind: type[Displacement] | type[Velocity], run: Run) -> Vector:
    """The approach of the bodies, or its rate (k,)."""
    away = run.values[kind(0)] @ X
    return np.asarray(run.values[kind(1)] @ X - away if pair else -away)


def _deceleration(pair: bool, run: Run) -> Vector:
    """The rate at which the approach slows down, by differences of fourth order."""
    return -growth(_approach(pair, Velocity, run), run.times[1])


def _separation(pair: bool, run: Run) -> float:
    """The time of separation, from the distance and the speed of the bodies at the end."""
    gap, speed = (_approach(pair, kind, run)[-1] for kind in (Displacement, Velocity))
    return float(run.times[-1] - gap / speed) if speed < 0 else float("nan")


def _declare(variant: str, p: Parameters) -> Trial:
    pair = variant in PAIRS
    law, judge = _law(pair, p), _judge(hertz.contact_time(**_law(pair, p)))
    unit = hertz.contact_time(**law)
    require_shallow(hertz.deepest(**law), p["R"])
    goal = History(LASTS * unit, unit / SEEN)
    seen = tuple(kind(body) for kind in (Displacement, Velocity) for body in range(1 + pair))
    rungs = tuple(Knobs(dt=unit / n) for n in STEPS)
    levels = {Level.QUICK: rungs[:2], Level.DEFAULT: rungs[:3], Level.PAPER: rungs}
    overlap = Series(
        "overlap", "U", "m", "overlap, negative after the contact",
        (functools.partial(_approach, pair, Displacement) if pair
         else ComponentAlong(Displacement(0), -X)),
        functools.partial(hertz.overlap, **law), judge,
    )  # fmt: skip
    figures = {
        "deepest": (
            lambda run: smooth_maximum(_approach(pair, Displacement, run)),
            hertz.deepest(**law),
        ),
        "force": (
            lambda run: law["m"] * smooth_maximum(_deceleration(pair, run)),
            hertz.largest_force(**law),
        ),
        "lasting": (lambda run: _separation(pair, run), unit),
    }
    scalars = [
        Scalar(name, symbol, unit_of, meaning, *figures[name], figures[name][1], judge)
        for name, symbol, unit_of, meaning in (
            ("deepest", "U_max", "m", "largest overlap"),
            ("force", "F_max", "N", "largest force, from the deceleration of the bodies"),
            ("lasting", "tc", "s", "duration of the contact, from the positions at the end"),
        )
    ]
    study = Ladder(_scene(pair, p), goal, seen, levels)
    return Trial(study, (overlap, *scalars, _balance(unit)))


def _judge(unit: float) -> Exact:
    """unit: duration of the contact [s]."""
    return Exact({
        Method.SECOND_ORDER: Tolerance(
            5.0 / STEPS[0] ** 2,
            "an error of (w dt)^2/24 of the phase, with the largest w of the contact, 1.2 times "
            "pi/tc; and as much for the steps in which contact begins and ends",
            dt=unit / STEPS[0], order=2, floor=1e-6,
        ),
    })  # fmt: skip


def _balance(unit: float) -> Scalar:
    step = Tolerance(
        5.0 / STEPS[0] ** 2, "the bound of the path: energy oscillates by (w dt)^2/4 at most",
        dt=unit / STEPS[0], order=2,
    )  # fmt: skip
    return balance({Method.SECOND_ORDER: step})


PAIR = "m/2 U'' = -K U^(3/2), U' = 2 v at first; K = 4/3 E sqrt(R/2), 1/E = 2 (1 - nu^2)/Y"
ON_WALL = "m U'' = -K U^(3/2), U' = v at first; K = 4/3 E sqrt(R), E = Y/(1 - nu^2)"
CASE = Case(
    name="hertz-impact",
    title="Elastic spheres meet head-on, and a rigid wall",
    source=CHUNG_OOI_2011,
    parameters=(
        Parameter("young", 48e9, "Pa", "Young's modulus of the spheres"),
        Parameter("poisson", 0.2, "", "Poisson's ratio of the spheres"),
        Parameter("rho", 2800.0, "kg/m3", "density of the spheres"),
        Parameter("R", 0.01, "m", "radius of the spheres"),
        Parameter("v", 10.0, "m/s", "speed of each sphere"),
    ),
    variants=(
        Variant("glass", "test 1: two spheres of glass", PAIR, defaults("glass")),
        Variant("limestone", "test 1: two spheres of limestone", PAIR, defaults("limestone")),
        Variant(
            "aluminium", "test 2: a sphere of aluminium alloy and a rigid wall", ON_WALL,
            {**defaults("aluminium"), "R": 0.1, "v": 0.2},
        ),
        Variant(
            "magnesium", "test 2: a sphere of magnesium alloy and a rigid wall", ON_WALL,
            {**defaults("magnesium"), "R": 0.1, "v": 0.2},
        ),
    ),
    declare=_declare,
)  # fmt: skip
