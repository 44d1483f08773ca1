"""Bounds of a block on a shaking foundation: reversals of slip located, or late."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from cases.blocks.parts._vibrating import resounding
from cases.blocks.parts.responding._slow import (
    Path,
    kept,
    late_springs,
    sharp_turns,
    turned_back,
)
from vv.ask import Method
from vv.case import LARGEST_TOLERANCE, Exact, Parameters, Tolerance

Biased = Callable[[float], float] | None  # a step [s] -> an error

SIDE, DENSITY = 1.0, 2500.0  # m, kg/m3: neither enters the answer
LOST = {
    Method.FIRST_ORDER: "friction that reverses on whole steps leaves an error of speed of up to "
    "what the base gains in a step, D w^2 dt. That is a large part of what friction gives the "
    "block in half a period, so that the result depends on how steps fit into the period"
}
LOCATED = "rounding errors of a few hundred located events"
EPS = float(np.finfo(float).eps)
STEP, SPRING, MASS = 1e-3, 1e8, DENSITY * SIDE**3  # s, N/m, kg
GAP = 1e-10  # of the displacement: a gap at t = 0 that is too small for codes to see
LEAST = 2e-9  # a bound: the tolerance with which reversals are located
EVEN = 1e-9  # of a number of steps: it is whole but for rounding
STICKS = 0.45  # of the base's acceleration: with less friction than that the block always slips
# of the same: with more friction than that the error of slip that turns is so many times (w dt)^2
PASSES, SLOWER = 0.35, 2.4


def directions(p: Parameters) -> int:
    """Number of axes along which the block is free: up to the last one that is shaken."""
    for name in ("Dy", "Dz"):
        if p[name] < 0:
            raise ValueError(f"{name} = {p[name]!r} m; an amplitude must be zero or more")
    return 3 if p["Dz"] > 0 else 2 if p["Dy"] > 0 else 1


def require_slow(p: Parameters) -> None:
    """Raise ValueError where the softest springs cannot follow a base along two directions.

    It then shakes as fast as they swing, or faster.
    """
    own = float(np.sqrt(SPRING / MASS) / (2 * np.pi))
    for size, name in (("D", "f"), ("Dy", "fy")):
        if directions(p) > 1 and p[size] and not p[name] < own:
            raise ValueError(
                f"{name} = {p[name]!r} Hz; the base must shake more slowly than the softest "
                f"springs swing, at {own:.4g} Hz"
            )


def free_fall(p: Parameters) -> float:
    """The height of a free fall [m], which scales errors where nothing drags the block."""
    return 0.5 * p["g"] * p["duration"] ** 2


def reversal_error(p: Parameters) -> float:
    """The error by reversals on whole steps, over the displacement [1/s]; see `_whole_steps`."""
    omega, friction = 2 * np.pi * p["f"], p["mu"] * p["g"]
    ends = np.pi * p["D"] * omega / (2 * friction) if friction else np.inf
    return float(0.5 * omega**2 * min(ends, p["duration"]))


def in_plane(p: Parameters, path: Path, way: float) -> Exact:
    """Along the base; codes of first order are not judged where chance would decide.

    way: the largest displacement [m].
    """
    stops = _stops(p, path)
    first = _whole_steps(p, way, stops)
    within = _within_steps(p) if directions(p) == 1 else {}
    return Exact(
        _tolerances(p, path, way, stops) | first | within, not_judged={} if first else LOST
    )


def _tolerances(p: Parameters, path: Path, way: float, stops: float) -> dict[Method, Tolerance]:
    """The tolerances: reversals of slip are located, or late by a part of a step or of 1/w."""
    one_way = directions(p) == 1
    rate = p["mu"] * p["g"] * p["duration"] / way
    # f in Hz: delays add up faster at higher frequencies
    fastest = 2 * np.pi * max(p["f"] if p["D"] else 0.0, p["fy"])
    quick = 1 + p["f"] / 3 if one_way else resounding(fastest, SPRING / MASS)
    biased = _biased(p, rate)
    slips_on = _always_slips(p) or not one_way
    springs, whole = (late_springs(p), kept(p) / p["duration"]) if slips_on else (0.0, 0.0)
    return {
        Method.EXACT: _located(p, rate) if one_way else _rounding(p, path),
        Method.SECOND_ORDER: _second(p) if one_way else _rotating(p, path, way),
        Method.PENALTY: _late_reversals(
            rate, max(0.07 * quick, springs), max(0.8, whole, stops), biased
        ),
        Method.LAGGING: _late_reversals(
            rate,
            max(0.1 * quick, springs),
            max(2.0, 2 * stops),
            biased,
            "; lagging friction adds to it",
        ),
    }


def _largest_acceleration(p: Parameters) -> float:
    """The largest acceleration of the base along x and y [m/s2], at most."""
    rates = 2 * np.pi * np.array([p["f"], p["fy"]])
    return float(np.hypot(*(np.array([p["D"], p["Dy"]]) * rates**2)))


def _stops(p: Parameters, path: Path) -> float:
    """The steps by which slip is late because the base stops along both axes, over the run.

    Slip is then that of the block alone, some mu g/w. Where the base gains half of that in a step,
    the direction of slip turns within it, and friction of that step is wrong by up to mu g dt. This
    happens twice a period of the slower axis at most, and moves the block for half the run on
    average. Slip that passes near rest elsewhere, since the block moves too, is counted.
    """
    if directions(p) == 1:
        return 0.0
    rates = 2 * np.pi * np.array([p["f"], p["fy"]])
    gained = _largest_acceleration(p) * STEP
    slow = float(rates.min())
    if p["mu"] * p["g"] / slow < 2 * gained:
        return p["duration"] * slow / (2 * np.pi)
    return turned_back(p, path, gained)


def _located(p: Parameters, rate: float) -> Tolerance:
    """For reversals along x, located to rounding; rate: mu g T over the displacement [1/s]."""
    lost = rate * EPS * kept(p) * np.sqrt(2 * p["f"] * p["duration"])
    return Tolerance(
        max(float(lost), 1e-13),
        f"{LOCATED}. A time of the order of T is rounded by eps T, so that each of 2 f T reversals "
        "changes the speed by up to mu g eps T, with either sign, until friction has removed it",
    )


def _rounding(p: Parameters, path: Path) -> Tolerance:
    """For slip that rotates: displacements of base and slip are summed, and may nearly cancel."""
    turned = 2 * np.pi * max(p["f"], p["fy"]) * p["duration"]
    ways = np.abs(path(np.linspace(0.0, p["duration"], 101))).max(axis=0)[:2]
    lost = 0.1 * EPS * turned**2 * np.hypot(p["D"], p["Dy"])
    return Tolerance(
        max(float(lost / ways.min()), 1e-13) if ways.min() > 0 else 1e-13,
        f"{LOCATED}, and of the phases w T of the base, which add up in a slip that does not stop",
    )


def _whole_steps(p: Parameters, way: float, stops: float) -> dict[Method, Tolerance]:
    """For first order: friction acts at ends of steps; empty if the bound at STEP is too large."""
    omega = 2 * np.pi * np.array([p["f"], p["fy"], p["fz"]][: directions(p)])
    stopped = p["mu"] * p["g"] * p["duration"] / way * stops
    late = reversal_error(p) if len(omega) == 1 else float(omega.max()) + stopped
    bound = Tolerance(
        1e-9,
        "slip reverses on whole steps: the block keeps an error of speed of up to D w^2 dt for pi "
        "D w/(2 mu g), the time in which friction removes it. Where the direction of slip rotates, "
        "friction is late by up to w dt, and where the base stops along both axes by mu g dt",
        late=late,
        slack="reversals fall on whole steps only if steps divide the period",
    )
    return {Method.FIRST_ORDER: bound} if late * STEP < LARGEST_TOLERANCE else {}


def _within_steps(p: Parameters) -> dict[Method, Tolerance]:
    """For friction that reverses within a step; empty if the bound at STEP is too large."""
    value = max(reversal_error(p) * 2 * np.pi * p["f"] * _found_late(p) * STEP**2, LEAST)
    if value > LARGEST_TOLERANCE:
        return {}
    bound = Tolerance(
        float(value),
        "slip reverses within a step whose other forces are taken as constant, at their middle: "
        "an error of the relative speed of up to D w^3 dt^2/2, and of the time of the reversal by "
        "that over the relative acceleration a + mu g, a of the base. The block keeps the error of "
        "speed, 2 mu g times as large, for pi D w/(2 mu g), the time in which friction removes it",
        dt=STEP,
        order=2,
        floor=LEAST,
    )
    return {Method.STRAIGHT: bound}


def _found_late(p: Parameters) -> float:
    """2 mu g/(a + mu g), a: acceleration of the base where slip reverses, mu g at least.

    A block that always slips has there the largest speed that friction gives it, pi mu g/(2 w).
    """
    part = p["mu"] * p["g"] / (p["D"] * (2 * np.pi * p["f"]) ** 2) if p["D"] else 1.0
    steep = np.sqrt(max(0.0, 1.0 - (np.pi * part / 2) ** 2))
    return float(min(1.0, 2 * part / (steep + part)))


def _always_slips(p: Parameters) -> bool:
    """Whether a block that moves along x never sticks to the base."""
    return bool(p["mu"] * p["g"] < STICKS * p["D"] * (2 * np.pi * p["f"]) ** 2)


def _second(p: Parameters) -> Tolerance:
    """For motion along x with located reversals; the bound depends on whether the block sticks."""
    omega = 2 * np.pi * p["f"]
    if _always_slips(p):
        return Tolerance(
            2e-9,
            "the block slips all the time, and its velocity is linear between reversals, which are "
            "located within the step: the tolerance of their location remains",
            slack="on straight lines a search ends at rounding",
        )
    return Tolerance(
        max(float((omega * STEP) ** 2 / 8), 2e-9),
        "where the block sticks it follows the sine of the base, with an error of (w dt)^2/12",
        dt=STEP,
        order=2,
        floor=2e-9,
    )


def _rotating(p: Parameters, path: Path, way: float) -> Tolerance:
    """For slip whose direction rotates."""
    omega = 2 * np.pi * max(p["f"], p["fy"], p["fz"] if p["Dz"] else 0.0)
    turns = SLOWER if p["mu"] * p["g"] > PASSES * _largest_acceleration(p) else 0.6
    dragged = float(np.sqrt(p["D"] ** 2 + p["Dy"] ** 2 + (2 * p["Dz"]) ** 2))
    return Tolerance(
        max(turns * (omega * STEP) ** 2 * max(dragged / way, 1.0), 1e-7),
        "friction acts along the mean direction of slip over a step. Where the slip is slow its "
        "direction turns by more than w dt of the fastest sine, and the error is the square of "
        "that angle, four times as much (by trial) with friction of more than a third of the "
        "base's acceleration, with which slip comes near to rest again and again. Where slip "
        "passes within a time b of rest, friction is lost for pi dt^2/(48 b), or for 1.2 sqrt(b "
        "dt) if that is less, and the speed is wrong by half of this until friction has removed "
        "that of the base",
        dt=STEP,
        order=2,
        floor=1e-7,
        least=sharp_turns(p, path, way),
    )


def _biased(p: Parameters, rate: float) -> Callable[[float], float] | None:
    """The error at a step [s] because friction acts for a step longer in one direction.

    rate: mu g T over the displacement [1/s]. Where a period is no even number of steps, a slip that
    reverses on whole steps lasts for a step longer in one half of each period. The speed of the
    block drifts by that, until friction on the base that is faster than it makes up for it.
    """
    if directions(p) > 1 or not _always_slips(p):
        return None

    def error(dt: float) -> float:
        halves = 0.5 / (p["f"] * dt)
        even = abs(halves - round(halves)) < EVEN * halves
        return 0.0 if even else rate * dt * p["f"] * kept(p) / 2

    return error


def _late_reversals(
    rate: float, by_springs: float, by_steps: float, biased: Biased, more: str = ""
) -> Tolerance:
    """For late reversals of slip; rate: mu g T over the displacement [1/s]."""
    value = rate * by_springs * np.sqrt(MASS / SPRING)
    return Tolerance(
        max(float(value), 1e-9),
        "springs delay each reversal of slip by a fraction of 1/w, w^2 = kn/m, or by 4/3 sqrt(mu "
        "g/a)/w where the block slips on while the base accelerates by a; and reversals fall on "
        "whole steps; over the duration T the delays add up to mu g T "
        f"({by_springs:g}/w + {by_steps:g} dt){more}. Along two directions the part of springs "
        "contains that the base shakes them, over 1 - (base's frequency/w)^2. Where a period is "
        "no even number of steps, friction acts for a step longer in one direction in each of them",
        kn=SPRING,
        softness=0.5,
        late=by_steps * rate,
        slack="slip that rotates between two directions hardly reverses",
        least=biased,
    )
