"""Bounds of the errors of T1-T4, and steps that are short enough for them."""

from __future__ import annotations

import dataclasses
import math

import numpy as np

from reference_solutions.contact import single_contact as closed
from vv.ask import Method
from vv.case import LARGEST_TOLERANCE, Exact, Parameters, Tolerance

# what decides the overlap of the shear tests
OVERLAP = ("rho", "r", "kn", "ks", "mu", "eta", "v_b")
COARSEST, STEP, DURATION = 4e-3, 1e-3, 0.4  # s


def parts(test: str, p: Parameters) -> int:
    """How many steps replace one, a power of two: so many that first order may be judged."""
    most = _first_order(*rates(test, p)) * COARSEST / LARGEST_TOLERANCE
    return 1 << math.ceil(math.log2(max(most, 1.0)))


def rates(test: str, p: Parameters) -> tuple[float, float]:
    """The rates k of the spring and n of the drag [1/s]."""
    mass = closed.mass(p["rho"], p["r"])
    k = math.sqrt(p["kn" if test in ("T1", "T2") else "ks"] / mass)
    return k, p["eta"] / (2 * mass) if test in ("T2", "T4") else 0.0


def _first_order(k: float, n: float) -> float:
    """The error of methods of first order over the step [1/s]."""
    return max(3.6 * n, 0.5 * k)


def judge(test: str, p: Parameters) -> Exact:
    """The bounds from the rates k of the spring and n of the drag [1/s], over the step."""
    k, n = rates(test, p)
    step = STEP / parts(test, p)
    phase = (k * step) ** 2 * _ahead(test, k, n)
    shallow = SHALLOW * _rounding(p) if test in ("T3", "T4") else 0.0
    rounded = ROUNDED_STEPS + shallow
    second = Tolerance(
        max(float(phase), rounded),
        "the phase error of a leapfrog, (k dt)^2/24 per period, is 2e-5 at 1e-3 s and grows with "
        "drag; where contact and slip begin or end within a step, errors of the same order are "
        "added. Below it each of 4e4 steps rounds by eps, and the overlap of T3 and T4 is rounded "
        "as for exact methods",
        dt=step,
        order=2,
        floor=rounded,
    )
    balanced = {} if n else {Method.LATE_LEAPFROG: dataclasses.replace(second, reason=BALANCED)}
    return Exact({
        Method.EXACT: Tolerance(
            1e-13 + shallow,
            "rounding errors of about a hundred operations, eps = 2.2e-16 each. In T3 and T4 the "
            "overlap is rounded too, as a difference of coordinates as large as r: an error of eps "
            "r/dx of the limit of friction, and of at most 1 + sqrt 2 times that of the largest "
            "displacement",
            slack="T1 and T2 are exact to a few eps, T3 and T4 where coordinates are round",
        ),
        Method.SECOND_ORDER: second,
        Method.FIRST_ORDER: Tolerance(
            max(float(_first_order(k, n) * step), rounded),
            "drag that is half a step late changes its coefficient by n dt = 0.7 % at 1e-3 s; a "
            "start half a step late changes the velocity by as much, or by a part of k dt. Both "
            "errors add up over the three stages of T4",
            dt=step,
            order=1,
            floor=rounded,
        ),
        **balanced,
    })  # fmt: skip


def _ahead(test: str, k: float, n: float) -> float:
    """The error of methods of second order over (k dt)^2.

    In T3 and T4 the sphere swings by a quarter of its largest displacement until the end or until
    drag has ended it, and the phase is ahead by (k dt)^2/24 of the angle: beyond the 6.4 rad of the
    case's own parameters this is added.
    """
    swung = k * DURATION if not n else min(k * DURATION, k / (math.e * n))
    beyond = max(0.0, swung - 6.4) if test in ("T3", "T4") else 0.0
    return max(0.4, 0.25 * (1 + (2 * n / k) ** 2)) + 0.257 / 24 * beyond


def _rounding(p: Parameters) -> float:
    """The rounding error of the coordinates over the overlap, at most 1 %."""
    dx = closed.overlap(**{name: p[name] for name in OVERLAP})
    error = float(np.finfo(float).eps) * p["r"] / dx
    if error > 0.01:
        rule = f"an overlap so small is lost as coordinates of r = {p['r']:g} m are rounded"
        raise ValueError(f"dx = {dx:.4g} m; {rule}")
    return error


BALANCED = (
    "without drag the only force that is half a step late is the dead load. It is constant, and "
    "the contact balances it at the start, so that the error of a leapfrog remains: (k dt)^2/24 "
    "per period, and errors of the same order where slip begins or ends within a step"
)
ROUNDED_STEPS = 1e-11  # of 4e4 steps, as many as the finest setting takes
SHALLOW = 1 + np.sqrt(2)
"""By what part of the largest displacement T3 and T4 change with the limit of friction y1.

With s = k y1/v_b, in units of v_b/k: the slip (1 - s^2)/2s changes by (1 + s^2)/2s, which is the
largest displacement, the swing about it by s, and its phase by sqrt(1 - s^2)/s of a circle of s.
"""
