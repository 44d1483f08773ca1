"""A block oscillates on its contact with steps of second order that damp unresolved motion."""

from __future__ import annotations

import cmath
from collections.abc import Callable

import numpy as np

from cases.stability.parts._tip import PARAMETERS, Z, frequency, rounded, scene
from reference_solutions.blocks import generalised_alpha as theory
from vv.ask import Displacement, History, Knobs, Method, Run, Velocity
from vv.case import (
    Case,
    Exact,
    Ladder,
    Level,
    Parameters,
    Scalar,
    Source,
    Tolerance,
    Trial,
    Variant,
)

MOVED, MOVING = Displacement(1), Velocity(1)
ANGLES = {"resolved": (0.1, 0.3, 1.0), "unresolved": (3.0, 10.0, 30.0)}
RADIUS = 0.5  # at an infinite angle: that of the class
STEPS = 12  # in the largest steps of a variant
NOISE = 1e-11  # relative to the fitted data: two roots explain a third one only to this
LAST = 4.5e-12  # effect of rounding on the roots at the largest angle
FADED = 1e-6  # of the first oscillation: what has decayed further is rounding


def _declare(variant: str, p: Parameters) -> Trial:
    w = frequency(p)
    dt = [angle / w for angle in ANGLES[variant]]
    rungs = tuple(Knobs(one, p["kn"]) for one in dt[::-1])
    levels = {Level.QUICK: rungs[:2], Level.DEFAULT: rungs, Level.PAPER: rungs}
    study = Ladder(scene(p), History(STEPS * dt[-1], dt[0]), (MOVED, MOVING), levels)
    resolved = Tolerance(RESOLVED * rounded(p), LINEAR_MAP)
    judge = _judge(resolved if variant == "resolved" else _close_roots(dt[-1], rounded(p)))
    radius = _over_theory(
        "radius", "rho/rho_O", "factor by which a step multiplies an oscillation",
        w, abs, theory.spectral_radius, judge,
    )  # fmt: skip
    period = _over_theory(
        "period",
        "T/T_O",
        "period of an oscillation in steps",
        w,
        _steps_per_radian,
        theory.slowing,
        judge,
        1.0,
    )
    return Trial(study, (radius, period))


def _over_theory(
    name: str,
    symbol: str,
    meaning: str,
    w: float,
    seen: Callable[[complex], float],
    due: Callable[[float, float], float],
    judge: Exact,
    power: float = 0.0,
) -> Scalar:
    """The value from the root of a run's step, over that of theory at its angle w dt."""

    def observe(run: Run) -> float:
        angle = w * float(run.times[1])
        return float(seen(_root(run, w)) * angle**power / due(angle, RADIUS))

    return Scalar(name, symbol, "", f"{meaning}, over theory", observe, 1.0, 1.0, judge)


def _steps_per_radian(root: complex) -> float:
    """Steps per radian; zero for a root that does not rotate."""
    return 1.0 / cmath.phase(root) if root.imag else 0.0


def _root(run: Run, w: float) -> complex:
    """The root of largest imaginary part of the recurrence over three outputs, fitted.

    A step maps positions, velocities and accelerations, and has three roots. The first output is
    left out, since a code need not report the initial acceleration.
    """
    both = w * (run.values[MOVED] @ Z)[1:], (run.values[MOVING] @ Z)[1:]
    size = np.hypot(*both)
    last = max(6, int(np.argmax(np.append(size < FADED * size[0], True))))
    known = np.concatenate([np.stack([x[k : last - 3 + k] for k in (2, 1, 0)], 1) for x in both])
    ahead = np.concatenate([x[3:last] for x in both])
    roots = np.roots([1.0, *-np.linalg.lstsq(known, ahead, rcond=NOISE)[0]])
    return complex(roots[np.argmax(roots.imag)])


OTHERS = "the step of this class has another damping; implicit-swing judges that of DDA"
RIGID = "rigid contact has no spring: the block rises, falls, and stays on its base"
RESOLVED = 1e-12  # effect of rounding on roots that are far apart
LINEAR_MAP = (
    "the step is a linear map, fitted to a dozen outputs; places of 1 m are rounded, which changes "
    "roots as the inverse of the amplitude where this is below 5e-4 m"
)


def _close_roots(dt: float, factor: float) -> Tolerance:
    """The effect of rounding on roots, which are closer to each other the larger the angle.

    dt: the largest step [s], of w dt = 30; factor: of rounding, over that at the defaults. The
    product of a root's distances from the other two is
    0.38 at w dt = 10 and 0.085 at 30: the same rounding moves it 4.5 times as far.
    """
    reason = (
        f"{LINEAR_MAP}; its three roots approach each other as w dt grows, so that rounding moves "
        "them further"
    )
    return Tolerance(LAST * factor, reason, dt=dt, order=1, floor=RESOLVED * factor)


def _judge(tolerance: Tolerance) -> Exact:
    return Exact(
        {Method.DAMPED: tolerance},
        not_judged={
            **dict.fromkeys((Method.PENALTY, Method.LAGGING), OTHERS),
            **dict.fromkeys((Method.EXACT, Method.SECOND_ORDER, Method.FIRST_ORDER), RIGID),
        },
    )


# a linear map does not depend on the amplitude, and weight only shifts it
LINEAR = frozenset({"g", "v"})
CUBIC = (
    "(1 - am) a+ + am a = -w^2 ((1 - af) x+ + af x), x+ = x + v dt + dt^2 ((1/2 - b) a + b a+), "
    "v+ = v + dt ((1 - c) a + c a+); am = 0, af = 1/3, b = 4/9, c = 5/6"
)
CASE = Case(
    name="damped-swing",
    title="Numerical damping of second order",
    source=Source(
        "Chung and Hulbert (1993), A time integration algorithm for structural dynamics with "
        "improved numerical dissipation: the generalized-alpha method, Journal of Applied "
        "Mechanics 60(2), 371-375",
        "10.1115/1.2900803",
        "The step is theirs, with a spectral radius of 1/2 at infinite w dt. Contact is rigid; "
        "what oscillates is the penalty spring that represents it.",
    ),
    parameters=PARAMETERS,
    variants=(
        Variant("resolved", "w dt from 0.1 to 1", CUBIC, inert=LINEAR),
        Variant("unresolved", "w dt from 3 to 30", CUBIC, inert=LINEAR),
    ),
    declare=_declare,
)
