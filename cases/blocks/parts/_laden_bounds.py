"""Bounds of a loaded block on a shaking slope, at the parameters of the case."""

from __future__ import annotations

import dataclasses

import numpy as np

from vv.ask import Method
from vv.case import LARGEST_TOLERANCE, Tolerance
from vv.scene import Vector

SUNK = Tolerance(
    2e-4,
    "the block sinks into its springs as the pressure changes, by 1e-4 of its displacement, and "
    "twice as far where it oscillates",
    kn=1e8,
    softness=1,
)
SLOWED = Tolerance(
    5e-5,
    "friction is in proportion to the pressure, which changes as the block sinks and oscillates: "
    "an error of 3e-5 of the displacement",
    kn=1e8,
    softness=1,
)
RATES = Tolerance(
    1.5e-3,
    "the block sinks at 1e-3 of its speed as the pressure changes; with implicit "
    "steps its speed oscillates by 1e-4 on the stiffest springs",
    kn=1e8,
    softness=1,
    floor=1.5e-4,
)
SWINGING = Tolerance(
    1.5e-3,
    "the block sinks as the pressure changes. At t = 0 the accelerations of slope and block exceed "
    "by 1.3 m/s2 what their springs are charged for: this leaves an oscillation of 1.3 "
    "sqrt(m/(4 kn)), 1.1e-3 of the speed, which this step damps within some cycles",
    kn=1e8,
    softness=0.5,
)
LATE = dataclasses.replace(
    SLOWED,
    late=0.5,
    reason=f"{SLOWED.reason}. Steps may use the drives at their ends, half a step late; friction "
    "that lags by an iteration adds to it",
)
SOON = dataclasses.replace(
    RATES, late=0.3, reason=f"{RATES.reason}; friction that lags by an iteration adds to it"
)
WHOLE = Tolerance(
    1e-11,
    "a step that uses the forces at one of its ends has them half a step late, and drives at 5 Hz "
    "cause a tenth of the speed; the motion also starts half a step late",
    late=10.0,
    slack="a scheme whose forces are half a step before its velocities has no such error here",
)
FINEST = 3e-11  # bound of a ledger that uses the forces of the motion
EXACTLY = Tolerance(1e-13, "no event; only rounding errors of Taylor series remain")
ROUNDED = Tolerance(
    1e-11, "no force acts in this direction; only rounding over 40 000 steps remains"
)
BOOKED = Tolerance(
    FINEST,
    "the ledger uses the same forces as the motion: only rounding errors of 40 000 steps remain",
)
DRIFTS = dict.fromkeys(Method, ROUNDED) | {Method.EXACT: EXACTLY}
MEANS = Tolerance(
    1e-6,
    "a step uses the forces at its ends, or its middle: an error of (w dt)^2/12 in the part of the "
    "displacement that the drives cause, which is 1 %",
    dt=1e-3,
    order=2,
    floor=1e-11,
)
FOLLOWS = Tolerance(
    1.5e-8,
    "contact is rigid: the block follows the slope in all steps but the first. The gap of 1e-10 m "
    "at the start is 7e-11 of its displacement",
    dt=1e-3,
    order=2,
    floor=3e-10,
)
SLIPS = {
    Method.EXACT: EXACTLY,
    Method.SECOND_ORDER: MEANS,
    Method.STRAIGHT: MEANS,
    Method.FIRST_ORDER: WHOLE,
    Method.PENALTY: SLOWED,
    Method.LAGGING: LATE,
}
RISES = {
    Method.EXACT: EXACTLY,
    Method.SECOND_ORDER: FOLLOWS,
    Method.STRAIGHT: FOLLOWS,
    Method.FIRST_ORDER: WHOLE,
    Method.PENALTY: SUNK,
    Method.LAGGING: SUNK,
}
SPEEDS = {
    Method.EXACT: EXACTLY,
    Method.SECOND_ORDER: Tolerance(
        4e-6,
        "a velocity is the mean of two steps: an error of (w dt)^2/6 in the velocity of the lift, "
        "which is 2 % of the whole",
        dt=1e-3,
        order=2,
    ),
    Method.FIRST_ORDER: WHOLE,
    Method.PENALTY: RATES,
    Method.DAMPED: SWINGING,
    Method.LAGGING: SOON,
}
BOOKS = {
    Method.EXACT: EXACTLY,
    Method.SECOND_ORDER: Tolerance(
        1e-12, "the ledger uses the same forces as the motion: only rounding errors remain"
    ),
    Method.FIRST_ORDER: WHOLE,
    Method.DAMPED: BOOKED,
    Method.LAGGING: BOOKED,
    Method.STRAIGHT: BOOKED,
}


def booked(speed: Vector, pulled: Vector) -> dict[Method, Tolerance]:
    """The bounds of the ledger of a block with velocities and accelerations (k, 3)."""
    squares, step = (pulled**2).sum(axis=1), 1e-3
    change = float(np.abs(squares - squares[0]).max() / (speed**2).sum(axis=1).max())
    counted = Tolerance(
        min(max(change * step**2 / 4, FINEST), LARGEST_TOLERANCE),
        "explicit steps count the work of the mean of the forces at their ends, and have the mean "
        "of two velocities: energy over mass is off by (a^2 - a0^2) dt^2/8, a the acceleration now "
        "and a0 at the start, of the v^2/2 that is stored",
        dt=step,
        order=2,
        floor=FINEST,
        slack="implicit steps count the work of the forces that move the block",
    )
    return {**BOOKS, Method.PENALTY: counted}


def scaled(bound: Tolerance, times: float) -> Tolerance:
    """A bound that is `times` as large, up to the largest tolerance."""
    value = min(times * bound.value, LARGEST_TOLERANCE)
    floor, late = min(times * bound.floor, value), times * bound.late
    reason = f"{bound.reason}. The bound is scaled by the largest drive over the motion"
    return dataclasses.replace(bound, value=value, floor=floor, late=late, reason=reason)
