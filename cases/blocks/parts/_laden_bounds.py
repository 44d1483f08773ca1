"""Bounds of a loaded block on a shaking slope, from its accelerations and how they change."""

from __future__ import annotations

from typing import Any

import numpy as np

from cases.blocks.parts._laden_drives import SOFT, STEP, Driven
from vv.ask import Method
from vv.case import Exact, Tolerance

LEAST = 1e-12
EXACTLY = Tolerance(1e-13, "no event; only rounding errors of Taylor series remain")
ROUNDED = Tolerance(
    1e-11, "no force acts in this direction; only rounding over 40 000 steps remains"
)
DRIFTS = Exact(dict.fromkeys(Method, ROUNDED) | {Method.EXACT: EXACTLY})
FINEST = 3e-11  # bound of a ledger that uses the forces of the motion
BOOKED = Tolerance(
    FINEST,
    "the ledger uses the same forces as the motion: only rounding errors of 40 000 steps remain",
)
SINKS = (
    "a spring that carries all loads at the start sinks by (p - p0)/w^2 more as the pressure p "
    "changes, and oscillates by p'(0)/w^3 and p''/w^4, and by a(0) dt/(2 w) where the motion "
    "starts half a step late, w^2 = kn/m; four springs that carry the dead loads alone sink by "
    "(p - p_s)/(2 w)^2 and oscillate by the sudden part (p0 - p_s)/(2 w)^2 as well"
)
SWINGS = (
    "a spring that carries all loads at the start sinks at p'/w^2 as the pressure p changes, and "
    "oscillates at p'(0)/w^2 and p''/w^3, and at a(0) dt/2 where the motion starts half a step "
    "late, w^2 = kn/m; four springs that carry the dead loads alone oscillate by the sudden part "
    "(p0 - p_s)/(2 w) as well"
)
RUBS = "; friction is mu times the pressure, and so is what it adds to the motion"
LAGS = (
    "; drives may be those at an end of a step, half a step late, and friction that lags by an "
    "iteration a whole step: their change since the start times dt/2 and dt is missing. The first "
    "step has no earlier iteration: friction may be wrong by mu p0 in half of it"
)


def slips(by: Driven) -> Exact:
    """The bounds of the displacement along the slip."""
    means = _bound(
        by.means / by.way,
        "a step uses the mean of the forces at its ends, the force in its middle or, of a lift, "
        "its positions: each drive a has an error of (a - a0 + a0' t) dt^2/12 at most",
        dt=STEP, order=2, floor=LEAST,
    )  # fmt: skip
    own = (by.mu * by.sinks[0] + by.means) / by.way
    late = by.lags[0] / by.way
    return Exact({
        Method.EXACT: EXACTLY,
        Method.SECOND_ORDER: means,
        Method.STRAIGHT: means,
        Method.FIRST_ORDER: _whole(by, 0, by.times[-1] / by.way),
        Method.PENALTY: _bound(own, SINKS + RUBS, kn=SOFT, softness=1),
        Method.LAGGING: _bound(own, SINKS + RUBS + LAGS, kn=SOFT, softness=1, late=late),
    })  # fmt: skip


def rises(by: Driven) -> Exact:
    """The bounds of the displacement along the normal."""
    gap = 3 * by.gap / by.way
    follows = _bound(
        max(np.abs(by.jerks[:, 1]).max() * STEP**3 / 6 / by.way, gap),
        "contact is rigid: the block follows the slope in all steps but the first, in which its "
        "acceleration changes by a' dt: an error of a' dt^3/6 at most, and the gap at the start",
        dt=STEP, order=3, floor=gap,
    )  # fmt: skip
    sunk = _bound(by.sinks[0] / by.way, SINKS, kn=SOFT, softness=1)
    return Exact({
        Method.EXACT: EXACTLY,
        Method.SECOND_ORDER: follows,
        Method.STRAIGHT: follows,
        Method.FIRST_ORDER: _whole(by, 1, by.times[-1] / by.way),
        Method.PENALTY: sunk,
        Method.LAGGING: sunk,
    })  # fmt: skip


def speeds(by: Driven, axis: int) -> Exact:
    """The bounds of the velocity along the slip, axis 0, or the normal, axis 1."""
    means = np.abs(by.jerks[:, axis]).max() * STEP**2 / 6 / by.speed
    own = (1.0, by.mu)[axis == 0] * by.sinks[1] / by.speed + means
    reason, late = (SWINGS + RUBS, by.lags[1] / by.speed) if axis == 0 else (SWINGS, 0.0)
    return Exact({
        Method.EXACT: EXACTLY,
        Method.SECOND_ORDER: _bound(
            means, "a velocity is the mean of two steps: an error of a' dt^2/6 at most",
            dt=STEP, order=2,
        ),
        Method.FIRST_ORDER: _whole(by, axis, 1 / by.speed),
        Method.PENALTY: _bound(own, reason, kn=SOFT, softness=0.5),
        Method.LAGGING: _bound(
            own, reason + (LAGS if late else ""), kn=SOFT, softness=0.5, late=late
        ),
    })  # fmt: skip


def books(by: Driven) -> dict[Method, Tolerance]:
    """The bounds of the ledger."""
    swings = np.array([by.mu, 1.0]) * max(by.rate / by.w, by.begins * by.w)
    started, sizes = (by.pulled[0] ** 2).sum(), np.abs(by.pulled)
    most = ((sizes + swings) ** 2).sum(axis=1).max()
    least = (np.maximum(sizes - swings, 0.0) ** 2).sum(axis=1).min()
    change = (most if by.late else max(most - started, started - least)) / by.speed**2
    counted = _bound(
        max(change * STEP**2 / 4, FINEST),
        "explicit steps count the work of the mean of the forces at their ends, and have the mean "
        "of two velocities: energy over mass is off by (a^2 - a0^2) dt^2/8, a the acceleration now "
        "and a0 at the start, of the v^2/2 that is stored, or by a^2 dt^2/8 where its first "
        "velocity is given; a oscillates by p'/w on the spring, and by a0 w dt/2 there",
        dt=STEP, order=2, floor=FINEST,
        slack="implicit steps count the work of the forces that move the block",
    )  # fmt: skip
    return {
        Method.EXACT: EXACTLY,
        Method.SECOND_ORDER: Tolerance(
            1e-12, "the ledger uses the same forces as the motion: only rounding errors remain"
        ),
        Method.FIRST_ORDER: _whole(by, 0, 2 / by.speed),
        Method.DAMPED: BOOKED,
        Method.LAGGING: BOOKED,
        Method.STRAIGHT: BOOKED,
        Method.PENALTY: counted,
    }


def _whole(by: Driven, axis: int, scale: float) -> Tolerance:
    """The bound of a scheme of first order; scale: what a speed of 1 m/s does to the quantity."""
    return _bound(
        1e-11,
        "a step that uses the forces at one of its ends has them half a step late, and the motion "
        "may start half a step late: an error of a dt of the speed",
        late=float(np.abs(by.pulled[:, axis]).max()) * scale,
        slack="a scheme whose forces are half a step before its velocities has no such error here",
    )  # fmt: skip


def _bound(value: float, reason: str, **scaling: Any) -> Tolerance:
    """A tolerance of at least rounding."""
    return Tolerance(max(float(value), LEAST), reason, **scaling)
