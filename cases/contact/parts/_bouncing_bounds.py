"""Bounds of the errors of bouncing spheres: by ends of contacts, late loads and last slips."""

from __future__ import annotations

import math

import numpy as np

from cases.contact.parts._bouncing import GOAL, mass_of
from vv.ask import Method
from vv.case import Exact, Judge, Motion, Parameters, Tolerance

Why = tuple[str, str] | tuple[()]  # why the bounds of second and of first order


def error_of_ends(motion: Motion, step: float, p: Parameters) -> float:
    """The largest error by ends of contacts within steps [s], over the displacement.

    A leapfrog conserves v^2/2 + k^2 x x*/2, x and x* the overlaps before and after a step. In the
    steps in which a contact begins and ends, x x* is between -(v dt)^2/4 and 0: a contact changes
    the speed by up to (k dt)^2/8 of it, for the time that is left.
    """
    speed = closing_speed(p) * p["kn"] / mass_of(p, p["r1"]) * step**2 / 8
    return speed * left_on_floor(p) / farthest(motion)


def left_on_floor(p: Parameters) -> float:
    """The time that is left after a contact with the floor closes, summed over all [s]."""
    return _left(p, p["g"], closing_speed(p), math.sqrt(p["kn"] / mass_of(p, p["r1"])))


def _left(p: Parameters, pull: float, closing: float, swing: float) -> float:
    """The time that is left after a contact closes, summed over all [s].

    pull: what presses the bodies together [m/s2]; closing: the speed at which they meet [m/s];
    swing: the rate of the contact [1/s].
    """
    first = 2 * p["gap"] / (closing + p["v_n"])
    apart = max(np.pi / swing, 2 * closing / pull if pull > 0 else GOAL.duration)
    return float((GOAL.duration - np.arange(first, GOAL.duration, apart)).sum())


def error_of_late_weight(motion: Motion, step: float, p: Parameters) -> float:
    """The error of a weight that acts half a step [s] late or early, over the displacement.

    It changes the speed at the start by g dt/2. All happens up to dt/2 earlier or later, at speeds
    of at most sqrt(c^2 + g^2/k^2) and v + g T, and the speed c of impact changes by g dt/2 v/c, for
    the whole time T; so do the durations of all flights, which are as c: that is as much again.
    """
    closing, pressed = closing_speed(p), p["g"] * math.sqrt(mass_of(p, p["r1"]) / p["kn"])
    fastest = min(math.hypot(closing, pressed), p["v_n"] + p["g"] * GOAL.duration)
    faster = p["g"] * step / 2 * p["v_n"] / closing
    return (fastest * step / 2 + 2 * faster * GOAL.duration) / farthest(motion)


def rubbing(p: Parameters) -> float:
    """The largest change [m/s] of the speed along the floor.

    Friction is at most mu times a normal force, whose impulse over the mass is g T and, as the
    sphere comes and goes, twice the speed at which it meets the floor. It does not do more than
    turn round the slip, of which 2/7 is the motion of the centre.
    """
    pushed = p["g"] * GOAL.duration + 2 * closing_speed(p)
    return min(p["mu"] * pushed, 4 / 7 * _slip(p))


def _slip(p: Parameters) -> float:
    """The largest slip at the start [m/s]."""
    return abs(p["v_t"]) + abs(p["r1"] * p["w1"]) + abs(p["r2"] * p["w2"])


def closing_speed(p: Parameters) -> float:
    """The speed [m/s] at which the sphere meets the floor."""
    return math.sqrt(p["v_n"] ** 2 + 2 * p["g"] * p["gap"])


def farthest(motion: Motion) -> float:
    """The largest displacement [m]."""
    return float(np.linalg.norm(motion.path(GOAL.times(None)), axis=1).max())


def pair_errors(p: Parameters, n: int, step: float) -> tuple[float, float]:
    """Errors of the displacement [m] by ends of contacts within steps [s], and by a late load.

    Where the load lets the spheres meet again and again, the changes of speed by all contacts add.
    """
    light = 1 / mass_of(p, p["r1"]), 1 / mass_of(p, p["r2"])
    pull, share = p["load"] * sum(light), light[n - 1] / sum(light)
    closing = np.sqrt(p["v_n"] ** 2 + 2 * pull * p["gap"])
    square = p["kn"] * sum(light)
    left = max(2 * GOAL.duration, _left(p, pull, closing, math.sqrt(square)))
    second = float(closing * square * step**2 / 8) * share * left
    return second, pull * step / 2 * share * GOAL.duration


def released(p: Parameters, mass: float, late: float, second: float) -> tuple[float, int]:
    """The error [m] by the last slip before bodies part, and its order.

    A shear force F falls to zero with mu kn U: an error of mu times `second`, that of the normal
    force. Where it falls within less than a step, it ends anywhere in that and changes the speed by
    up to F dt/m; F is at most what springs make of all slip at the start, s sqrt(ks m/3.5), and
    less where both bodies move. late: dt times the time that is left [s2].
    """
    jump = _slip(p) * math.sqrt(p["ks"] / (3.5 * mass)) * late
    resolved = max(p["mu"] - 1.0, 0.0) * second
    return (resolved, 2) if resolved < jump else (jump, 1)


def judge(
    step: float, second: float, first: float, arm: float = 0.0, why: Why = (), order: int = 2
) -> Judge:
    """second, first: bounds at the coarsest step [s]; arm: the effect of U/(2 r) on the force."""
    rubbed, late = why or ON_FLOOR
    return Exact({
        Method.EXACT: Tolerance(
            1e-11,
            "two independent routes to the answer agree to 1e-12, over a dozen located events",
        ),
        Method.SECOND_ORDER: Tolerance(second, rubbed, dt=step, order=order, floor=arm),
        Method.FIRST_ORDER: Tolerance(first, late, dt=step, order=1),
    })  # fmt: skip


ON_FLOOR = (
    "a contact lasts for more than a hundred steps: an error of (k dt)^2/24 = 3e-5 for its "
    "oscillation, and as much for each of its ends and for those of slip, over four bounces. At "
    "most (k dt)^2/8 of the speed is lost or gained in a contact, for the time that is left, and "
    "friction turns this into tangential speed. Codes differ in the arm of the shear force, r - "
    "U/2 or r, with U/r = 1e-5",
    "weight and load act half a step late at the start: this changes the speed v of the first "
    "impact by g dt/2v, 6e-5, and everything after it by as much; speeds along the floor are late "
    "by as much",
)
OF_PAIR = (
    "each end of a contact falls within a step, and costs up to (k dt)^2/8 of the closing speed, "
    "k^2 = kn (1/m1 + 1/m2); the errors of both ends of one contact may add, for the whole time, "
    "and those of all contacts, for the time that is left after each. "
    "Across the line of centres it is the part by friction or, if that is more, pi/24 (kt dt)^2 mu "
    "of the closing speed by the phase of shear springs, kt^2 = 3.5 ks (1/m1 + 1/m2)",
    "the load acts half a step late at the start: the closing speed is too small by a dt/2 for the "
    "whole time, a = P (1/m1 + 1/m2)",
)
