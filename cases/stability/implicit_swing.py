"""A block oscillates on its contact in implicit steps of 1e-3 to 1e4 radians."""

from __future__ import annotations

import cmath
from collections.abc import Callable

import numpy as np

from cases._papers import YAGODA_BIRAN_2016
from cases.stability.parts._tip import PARAMETERS, Z, frequency, rounded, scene
from reference_solutions.blocks import implicit_step as theory
from vv.ask import Displacement, History, Knobs, Method, Run, Velocity
from vv.case import (
    Case,
    Exact,
    Ladder,
    Level,
    Parameters,
    Scalar,
    Shown,
    Source,
    Tolerance,
    Trial,
    Variant,
)
from vv.scene import Vector

MOVED, MOVING = Displacement(1), Velocity(1)
STEPS = 8  # in the largest steps of a variant
FADED = 1e-6  # of the first oscillation: what has decayed further is rounding


def _declare(variant: str, p: Parameters) -> Trial:
    w = frequency(p)
    dt = [angle / w for angle in ANGLES[variant]]
    rungs = tuple(Knobs(one, p["kn"]) for one in dt[::-1])
    levels = {Level.QUICK: rungs[:2], Level.DEFAULT: rungs, Level.PAPER: rungs}
    study = Ladder(scene(p), History(STEPS * dt[-1], dt[0]), (MOVED, MOVING), levels)
    radius = _over_theory(
        "radius", "rho/rho_O", "spectral radius of a step, over theory", w, _radius,
        theory.spectral_radius, _judge(1e-12 * rounded(p), LINEAR_MAP),
    )  # fmt: skip
    if variant == "real":
        return Trial(study, (radius, _ringing(w)))
    bound, told = TOLD[variant]
    ratio = _over_theory(
        "damping", "zeta/zeta_O", "damping ratio over theory, which is w dt/4 for small steps", w,
        _damping, theory.damping_ratio, _judge(bound * rounded(p), told),
    )  # fmt: skip
    return Trial(study, (radius, ratio))


def _over_theory(
    name: str,
    symbol: str,
    meaning: str,
    w: float,
    seen: Callable[[Vector], float],
    due: Callable[[float], float],
    judge: Exact,
) -> Scalar:
    """The value from the roots of a run's step, over that of theory at its w dt."""
    observe = lambda run: seen(_roots(run, w)) / due(w * float(run.times[1]))  # noqa: E731
    return Scalar(name, symbol, "", meaning, observe, 1.0, 1.0, judge)


def _ringing(w: float) -> Scalar:
    return Scalar(
        "ringing", "lambda", "", "the root of larger modulus",
        lambda run: float(max(_roots(run, w), key=abs).real), None, 1.0, RINGS,
    )  # fmt: skip


def _roots(run: Run, w: float) -> Vector:
    """The two roots of the linear map from one output's (w x, v) to the next, fitted."""
    state = np.array([w * (run.values[MOVED] @ Z), run.values[MOVING] @ Z])
    size = np.linalg.norm(state, axis=0)
    last = max(3, int(np.argmax(np.append(size < FADED * size[0], True))))
    made = np.linalg.lstsq(state[:, : last - 1].T, state[:, 1:last].T, rcond=None)[0]
    return np.asarray(np.linalg.eigvals(made))


def _radius(roots: Vector) -> float:
    return float(np.abs(roots).max())


def _damping(roots: Vector) -> float:
    """The damping ratio of motion with these roots; 1 for motion that ends within a step."""
    one = complex(roots[0])
    rate = cmath.log(one) if one else -1.0
    return -rate.real / abs(rate)


ANGLES = {
    "complex": (1e-3, 1e-2, 1e-1, 1.0),
    "near-four": (1.0, 2.0, 3.0, 3.9),
    "real": (4.1, 10.0, 1e2, 1e3, 1e4),
}
OTHERS = "rigid contact has no spring: the block rises, falls, and stays on its base"
SHOWN = dict.fromkeys((Method.EXACT, Method.SECOND_ORDER, Method.FIRST_ORDER), OTHERS)
SHOWN[Method.DAMPED] = "this class integrates by another scheme, which the case damped-swing judges"
BOTH = (Method.PENALTY, Method.LAGGING)
LINEAR_MAP = (
    "the step is a linear map, fitted to eight outputs; places of 1 m are rounded, which changes "
    "roots as the inverse of the amplitude where this is below 5e-4 m"
)
TOLD = {
    "complex": (
        1e-7,
        f"{LINEAR_MAP}; the damping ratio is w dt/4, and at w dt = 1e-3 the decay in a step is of "
        "the square of that, which costs six digits",
    ),
    "near-four": (1e-12, LINEAR_MAP),
}


def _judge(bound: float, reason: str) -> Exact:
    return Exact(dict.fromkeys(BOTH, Tolerance(bound, reason)), not_judged=SHOWN)


RINGS = Shown(
    "beyond w dt = 4 this root is real and negative, and tends to -1: a stiff contact is no longer "
    "damped, and changes sign at every step"
)
# a linear map does not depend on the amplitude, and weight only shifts it
LINEAR = frozenset({"g", "v"})
ROOTS = "2 (x+ - x - v dt)/dt^2 = -w^2 x+, v+ = 2 (x+ - x)/dt - v; "
CASE = Case(
    name="implicit-swing",
    title="Numerical damping of implicit steps",
    source=Source(
        *YAGODA_BIRAN_2016,
        "The step is Eq. 5, corrected: d'' = (2/D^2)(d - D v0). The paper does not give its roots, "
        "which explain why contacts that the step does not resolve neither diverge nor come to "
        "rest. Contact is rigid; what oscillates is the penalty spring that represents it.",
    ),
    parameters=PARAMETERS,
    variants=(
        Variant("complex", "w dt from 1e-3 to 1", ROOTS + "rho^2 = 1/(1 + (w dt)^2/2)",
                inert=LINEAR),
        Variant("near-four", "w dt from 1 to 3.9", ROOTS + "rho^2 = 1/(1 + (w dt)^2/2)",
                inert=LINEAR),
        Variant(
            "real", "w dt from 4.1 to 1e4",
            ROOTS + "rho = (O^2 - 4 + O sqrt(O^2 - 16))/(2 (2 + O^2)), O = w dt",
            inert=LINEAR,
        ),
    ),
    declare=_declare,
)  # fmt: skip
