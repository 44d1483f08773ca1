"""Bounds of a sphere in a shaken corner, and the steps at which they are smaller than allowed."""

from __future__ import annotations

import math

import numpy as np

from cases._energy_balance import balance as unexplained
from vv.ask import Method
from vv.case import LARGEST_TOLERANCE, Exact, Parameters, Scalar, Tolerance

EPS, RADIUS = float(np.finfo(float).eps), 1e-3  # m; it does not enter the answer
LASTS = 40.0  # duration times w
SPEED = np.array([0.2, -0.15, 0.25])  # v/(w u)
DRAGGED = (
    ", drag among them, whose work in that time is z w dt m v^2 of the energy kn u^2/2 in each "
    "wall and m v^2/2"
)
SLOWED = (
    ", and m a^2 dt^2/8 of the acceleration a = 2 z w v by drag, of the energy kn u^2/2 in each "
    "wall and m v^2/2"
)
STRONG = (
    "; drag changes frequency and decay by sqrt(1 + 8 z^2)/s (w dt)^2/24, s^2 = 1 - z^2, and an "
    "amplitude v/(w s) reaches only v/w exp(-z acos(z)/s); axes reach their largest displacements "
    "at different times, so that a length is off by up to sqrt(3) times as much"
)
STEPS = (0.2, 0.1, 0.05, 0.025)  # times w


def _late(p: Parameters, step: float) -> float:
    """The error of drag with the velocity half a step before; step: times w."""
    return step / (2 * math.e) + (p["z"] + p["zn"]) * step * (3 / 2 + 1 / math.e)


def _damped(p: Parameters) -> float:
    """How many times larger drag makes the error of the free oscillation.

    With drag at its middle a step has the roots of r^2 + 2 z r + 1 = -(w dt)^2 (r^4/12 + z r^3/3).
    """
    z = p["z"] + p["zn"]
    slower = math.sqrt(1 - z * z)
    peak = math.exp(-z * math.acos(z) / slower)
    return math.sqrt(1 + 8 * z * z) / slower / (slower * peak)


def coarsest(p: Parameters) -> float:
    """The coarsest step times w, by halving, at which late drag is no larger error than allowed."""
    step = STEPS[0]
    while _late(p, step) > LARGEST_TOLERANCE:
        step /= 2
    return step


def judge(p: Parameters, unit: float, step: float, own: bool, axes: int = 1) -> Exact:
    """unit: 1/w [s]; step: the coarsest, times w; own: whether the parameters are the case's, at
    which errors of late drag partly cancel; axes: how many of them the error is the length of, each
    with an error relative to its own largest displacement."""
    strong = 1.0 if own else _damped(p) * math.sqrt(axes)
    damping = max(p["z"] + p["zn"], 1 / (math.e * LASTS))
    return Exact({
        Method.EXACT: Tolerance(
            max(1e-12, 3 * EPS * RADIUS / float(p["u"] * np.abs(SPEED).min())),
            "no event occurs: only rounding errors over a time of 40/w remain, and of the position "
            "at the start, by 3/2 of the last digit of the radius, about which the sphere then "
            "oscillates; it moves by 0.15 u at least",
        ),
        Method.SECOND_ORDER: Tolerance(
            step**2 * strong / (24 * math.e * damping) + step**2 / 8,
            "the phase of the oscillation has a relative error of (w dt)^2/24, which counts most "
            "when the amplitude has decayed by a factor of e; drag and steady motion have errors "
            f"of some (w dt)^2/8{'' if own else STRONG}",
            dt=step * unit, order=2,
        ),
        Method.FIRST_ORDER: Tolerance(
            step / math.e if own else max(step / math.e, _late(p, step)),
            "drag with the velocity half a step before changes the mass by z w dt, and the "
            "oscillation by w dt/(2 e) at most; forces that start half a step late add as much, "
            "and such drag z w dt of the speed at the start, and z w dt/e as the motion decays"
            f"{'' if own else ', and z w dt/2 of the amplitude'}",
            dt=step * unit, order=1,
        ),
    })  # fmt: skip


def balance(p: Parameters, unit: float, step: float, own: bool, one: bool) -> Scalar:
    """unit: 1/w [s]; step: the coarsest, times w; own: see `judge`; one: there is one wall."""
    exact = Tolerance(1e-12, "no event: only rounding errors remain")
    late = "the error of the first half step, since no contact opens or slips"
    square = float(SPEED[: 2 if one else 3] @ SPEED[: 2 if one else 3])
    drag, moving = p["z"] + p["zn"], square / ((1 if one else 3) + square)
    slowed = 0.0 if own else drag**2 * moving
    second = Tolerance(
        step**2 * (1 / 200 + slowed),
        f"{late}: some (w dt)^2/200{'' if own else SLOWED}",
        dt=step * unit, order=2,
    )  # fmt: skip
    dragged = 0.0 if own else drag * 2 * moving
    first = Tolerance(
        step * (1 / 40 + dragged),
        f"{late}; forces start half a step late{'' if own else DRAGGED}",
        dt=step * unit, order=1,
    )  # fmt: skip
    return unexplained(
        {Method.EXACT: exact, Method.SECOND_ORDER: second, Method.FIRST_ORDER: first}
    )
