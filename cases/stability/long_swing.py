"""T1's spring bound both ways: an oscillation without loss over thousands of periods."""

from __future__ import annotations

import dataclasses
import math
from typing import NamedTuple

import numpy as np

from cases._papers import LI_2018
from cases.contact.single_contact import CASE as SINGLE_CONTACT
from reference_solutions.contact import leapfrog
from reference_solutions.contact import single_contact as closed
from vv.ask import Displacement, History, Knobs, Method, Run, Velocity
from vv.case import (
    Case,
    Exact,
    Invariant,
    Ladder,
    Level,
    Parameters,
    Quantity,
    Scalar,
    Source,
    Tolerance,
    Trial,
    Variant,
)
from vv.scene import Bonds, Contact, Scene, Spheres, Vector, Wall

MOVED, MOVING = Displacement(1), Velocity(1)
OWN = ("rho", "r", "kn", "v_a")
X = np.array([1.0, 0.0, 0.0])
SUNK = 2.0  # overlap at rest over the amplitude: the contact stays closed
FREE = X > 0


def _pressed(p: Parameters, m: float, amplitude: float) -> Scene:
    """A sphere that a dead load presses into a wall, with an initial velocity along the normal."""
    depth = SUNK * amplitude
    sphere = Spheres(
        position=np.zeros((1, 3)),
        velocity=p["v_a"] * X[None],
        radius=np.array([p["r"]]),
        mass=np.array([m]),
        free=FREE[None],
        load=-p["kn"] * depth * X[None],
    )
    return Scene((Wall((depth - p["r"]) * X, X), sphere), Contact(p["kn"]))


def _bonded(p: Parameters, m: float, amplitude: float) -> Scene:
    """A sphere on a bond to another, which is fixed."""
    spheres = Spheres(
        position=np.array([np.zeros(3), 2 * p["r"] * X]),
        velocity=np.array([np.zeros(3), p["v_a"] * X]),
        radius=np.full(2, p["r"]),
        mass=np.full(2, m),
        free=np.array([~FREE & FREE, FREE]),
    )
    bond = Bonds(np.array([[0, 1]]), 2 * p["r"], p["kn"], 0.0)  # type: ignore[arg-type]  # for all
    return Scene((spheres,), Contact(p["kn"]), bonds=bond)


def _declare(variant: str, p: Parameters) -> Trial:
    if p["v_a"] == 0:
        raise ValueError("v_a = 0.0 m/s; the speed must not be 0, or the sphere does not oscillate")
    m = closed.mass(p["rho"], p["r"])
    w = math.sqrt(p["kn"] / m)
    scene = (_pressed if variant == "pressed" else _bonded)(p, m, abs(p["v_a"]) / w)
    rungs = tuple(Knobs(angle / w) for angle in ANGLES)
    levels = {Level.QUICK: rungs[:2], Level.DEFAULT: rungs[:2], Level.PAPER: rungs}
    period = 2 * math.pi / w
    goal = History(PERIODS[variant] * period, BETWEEN * period)
    return Trial(Ladder(scene, goal, (MOVED, MOVING), levels), _quantities(w))


def _quantities(w: float) -> tuple[Quantity, ...]:
    rate = Scalar(
        "rate", "phase/wt", "", "phase over that of the exact oscillation",
        lambda run: _swing(run, w).phase / (w * float(run.times[-1])), 1.0, 1.0,
        _phase_bounds(SWIFT, w),
    )  # fmt: skip
    return (
        Scalar(
            "drift", "max|I/I_0 - 1|", "", "variation of v^2 + kappa w^2 x^2, with kappa fitted",
            lambda run: _swing(run, w).drift, 0.0, 1.0, KEPT,
        ),
        Scalar(
            "kappa", "kappa", "", "stiffness in the conserved energy, over that of the spring",
            lambda run: _swing(run, w).kappa, 1.0, 1.0, _phase_bounds(SOFT, w),
        ),
        rate,
        dataclasses.replace(
            rate, name="leapfrog", symbol="phase/(2 n asin(w dt/2))",
            meaning="phase over that of a leapfrog of as many steps",
            observe=lambda run: _swing(run, w).phase / _theory(run, w), judge=TURNS,
        ),
        Scalar(
            "damping", "zeta", "", "damping ratio: decrement of the invariant over its phase",
            lambda run: _damping(run, w), 0.0, 1.0, NONE,
        ),
    )  # fmt: skip


class Swing(NamedTuple):
    """Phase at the end [rad], kappa, and the drift of conserved quantities, from the outputs."""

    phase: float
    kappa: float
    drift: float


def _swing(run: Run, w: float) -> Swing:
    """The oscillation, from outputs between which its phase strays from wt by under half a turn."""
    x, v = w * (run.values[MOVED] @ X), run.values[MOVING] @ X
    rows = np.stack([np.ones_like(x), -(x**2)], axis=1)
    kept, kappa = np.linalg.lstsq(rows, v**2, rcond=None)[0].tolist()
    strayed = np.abs(v**2 + kappa * x**2 - kept).max() / kept
    ahead = np.unwrap(_phase(x, v, kappa) - w * run.times)
    return Swing(float(ahead[-1] - ahead[0] + w * run.times[-1]), kappa, float(strayed))


def _damping(run: Run, w: float) -> float:
    """Minus half the slope of ln(v^2 + kappa w^2 x^2) over the phase w t."""
    x, v = w * (run.values[MOVED] @ X), run.values[MOVING] @ X
    kept = np.log(v**2 + _swing(run, w).kappa * x**2)
    return float(-np.polyfit(w * run.times, kept, 1)[0] / 2)


def _phase(x: Vector, v: Vector, kappa: float) -> Vector:
    return np.asarray(np.arctan2(math.sqrt(kappa) * x, v))


def _theory(run: Run, w: float) -> float:
    """The phase [rad] of a leapfrog, or of the exact oscillation if there are hardly any steps."""
    outputs, span = len(run.times) - 1, w * float(run.times[-1])
    steps = outputs * max(1, round(run.steps / outputs))  # a code may take one more at the end
    return steps * leapfrog.phase_per_step(span / steps) if span < steps else span


def _phase_bounds(reason: str, w: float) -> Exact:
    """Known errors at w dt = 0.4: phase (w dt)^2/24, kappa (w dt)^2/4; w in 1/s."""
    known = ANGLES[0] ** 2 / (24 if reason == SWIFT else 4)
    bound = Tolerance(1.02 * known, reason, dt=ANGLES[0] / w, order=2)
    return Exact({
        Method.EXACT: Tolerance(1e-11, "rounding errors of up to 3e5 pieces of the motion"),
        Method.LINEARISED: Tolerance(1e-11, "a bond that does not rotate is linear: only rounding "
                                     "errors remain"),
        Method.LEAPFROG: bound,
        Method.LATE_LEAPFROG: dataclasses.replace(bound, reason=BALANCED + reason),
    }, not_judged={**OTHERS, Method.PENALTY: ONLY_NEAR})  # fmt: skip


OTHERS = dict.fromkeys(
    (Method.SECOND_ORDER, Method.FIRST_ORDER),
    "the bounds are those of the phase and the energy of a leapfrog",
)
ONLY_NEAR = "springs that represent a bond do so for small stretches only"
ANGLES = (0.4, 0.2, 0.1, 0.05)  # w dt [rad]
PERIODS = {"pressed": 1000.25, "bonded": 2000.25, "bonded-long": 100_000.25}
BETWEEN = 5.05  # periods between two outputs
SWIFT = (
    "a leapfrog advances by 2 asin(w dt/2) a step, too much by (w dt)^2/24; 2 % is allowed for "
    "higher terms"
)
SOFT = "a leapfrog conserves m v^2/2 + k (1 - (w dt/2)^2) x^2/2 exactly"
BALANCED = "the load only balances the contact at the start, and does not lower the order; "
KEPT = Invariant(1e-11, "rounding errors of up to a million steps; nothing else changes the energy")
NONE = Exact(
    dict.fromkeys(
        (Method.EXACT, Method.LINEARISED, Method.LEAPFROG, Method.LATE_LEAPFROG),
        Tolerance(
            1e-14, "there is no damping; rounding of 1e-11 over thousands of radians remains"
        ),
    ),
    not_judged={**OTHERS, Method.PENALTY: ONLY_NEAR},
)
THEORY = Tolerance(1e-12, "the phase of a leapfrog is known; rounding moves it by 1e-14")
TURNS = Exact(
    {Method.LEAPFROG: THEORY, Method.LATE_LEAPFROG: THEORY},
    not_judged=dict.fromkeys(
        (Method.EXACT, Method.LINEARISED), "this class has no steps with a known phase"
    )
    | {**OTHERS, Method.PENALTY: ONLY_NEAR},
)
# m/s: the faster, the smaller is the part of an oscillation that rounding of positions loses
FAST, FASTER, FASTEST = ({"v_a": -v} for v in (1.0, 10.0, 100.0))
NO_SIZE = frozenset({"v_a"})  # the oscillation is linear
LAW = "x = (v_a/w) sin wt, w^2 = kn/m; a leapfrog: x_n = (v_a dt/sin a) sin na, a = 2 asin(w dt/2)"
CASE = Case(
    name="long-swing",
    title="Thousands of oscillations",
    source=Source(
        *LI_2018,
        "The spring of T1 is bound both ways here, by a load that keeps the contact closed or by a "
        "bond, and oscillates on. Hairer, Lubich and Wanner (2003), Acta Numerica 12, 399-450, "
        "derive how a leapfrog integrates it.",
    ),
    parameters=tuple(one for one in SINGLE_CONTACT.parameters if one.name in OWN),
    variants=(
        Variant("pressed", "a contact that a load keeps closed, 1000 periods", LAW, FAST, NO_SIZE),
        Variant("bonded", "a bond, 2000 periods", LAW, FASTER, NO_SIZE),
        Variant("bonded-long", "a bond, 100 000 periods", LAW, FASTEST, NO_SIZE, Level.PAPER),
    ),
    declare=_declare,
)
