"""Kernels that find when, within a step of rigid blocks, slip begins or ends."""

from __future__ import annotations

import numpy as np

from vv.engines.blocks.contacts import Contacts, matched
from vv.engines.kernels.arrays import (
    marked,
    rows,
    same_rows,
    smaller,
    square_of,
    unmarked,
    zero_rows,
)
from vv.engines.kernels.compiled import called, lent
from vv.engines.kernels.triples import add_scaled, at, dot, put
from vv.engines.rigid.general.setting import (
    Past,
    Setting,
    State,
    copy_of,
    least_impact_speed,
    rates,
)
from vv.engines.rigid.general.step import Trial, attempt
from vv.engines.rigid.general.turning import orthonormal, turn_by
from vv.engines.rigid.limits import BEGINS, CLOSE, ENDS, GLIMPSE, GRIP
from vv.engines.rigid.slip import least_slip_speed, zero_after
from vv.engines.rigid.solver.assembly import relative
from vv.scene import Vector

ZERO = (0.0, 0.0, 0.0)


@called
def move(setting: Setting, state: State, trial: Trial, span: float) -> None:
    """Update the state to the end of a trial: positions by the trapezoidal rule."""
    for i in range(len(setting.mass)):
        v, w = at(trial.v, i), at(trial.w, i)
        put(state.centre, i, add_scaled(add_scaled(at(state.centre, i), 0.5 * span, at(state.v, i)),
                                  0.5 * span, v))  # fmt: skip
        both = add_scaled(at(state.v, i), 1.0, v)
        put(state.moved, i, add_scaled(at(state.moved, i), 0.5 * span, both))
        angle = add_scaled(add_scaled(ZERO, 0.5 * span, at(state.w, i)), 0.5 * span, w)
        if dot(angle, angle) > 0.0:
            turn_by(angle, same_rows(state.rotation[i], 3), state.rotation[i])
            orthonormal(state.rotation[i])
        put(state.v, i, v)
        put(state.w, i, w)


@called
def time_to_slip_end(
    setting: Setting, state: State, past: Past, now: float, whole: float, dt: float,
    contacts: Contacts, trial: Trial,
) -> float:  # fmt: skip
    """The time [s] from `now` during which all slip continues, in the step of length `whole` [s].

    trial: that of the whole step. The time is zero if a slip ends at once, which is then marked in
    past.still, and -infinity if it ends at once from a finite speed: the contact jams, which needs
    an impact. The end is bracketed. A trial that ends too late does not tell by how much: guesses
    follow from the speeds of the slowest slip before the end, along a parabola, and step back from
    a late one by a distance that grows from the accuracy asked. The bracket is halved where a guess
    is outside, or has not halved the speed.
    """
    v, w = zero_rows(len(trial.v)), zero_rows(len(trial.v))
    rates(setting, state, now, v, w)
    low, high, late, speed = 0.0, whole, trial, slowest_slip(trial, v, w)
    earlier, faster, guess, back = 0.0, speed, np.inf, 0.0
    if speed > least_impact_speed(setting, dt):
        brief = CLOSE * dt
        jam = attempt(
            setting, state, now, brief, contacts, past_with_impulses(trial, brief), trial.gaps.slack
        )
        if marked(jam.ended):
            return -np.inf
    for _ in range(ENDS):
        if high - low <= CLOSE * dt:
            break
        if not low < guess < high:
            guess = np.inf
        span = guess if guess < np.inf else 0.5 * (low + high)
        trial = attempt(setting, state, now, span, contacts, past, trial.gaps.slack)
        if marked(trial.ended):
            back = np.sqrt(back * (span - low)) if back > 0.0 else 0.5 * CLOSE * dt
            high, late, guess = span, trial, guess - back
        else:
            left, guess = slowest_slip(trial, trial.v, trial.w), np.inf
            if left <= 0.5 * speed:
                guess = zero_after(earlier, faster, low, speed, span, left) + 0.25 * CLOSE * dt
            earlier, faster, low, speed, back = low, speed, span, left, 0.0
    if low <= CLOSE * dt:
        row = matched(late.key, len(late.key), past.key)
        for c in range(len(row)):
            if late.ended[c] and row[c] >= 0:
                past.still[row[c]] = True
        return 0.0
    return low


@called
def mean_forces(impulse: Vector, span: float) -> Vector:
    """The mean forces (c, 3) [N] of impulses (c, 3) [N s] over a time `span` [s]."""
    force = rows(len(impulse))
    for c in range(len(impulse)):
        for k in range(3):
            force[c, k] = impulse[c, k] / span
    return force


@called
def past_with_impulses(trial: Trial, span: float) -> Past:
    """The past from which a step of length `span` [s] starts with the impulses of a trial.

    The closer a rod is to jamming, the more sweeps are needed to find the impulse from zero.
    """
    return Past(trial.key, mean_forces(trial.p, span), unmarked(len(trial.p)), trial.joints)


@lent
def slowest_slip(trial: Trial, v: Vector, w: Vector) -> float:
    """The least speed [m/s], at velocities v, w (b, 3), of contacts that slip at the trial's start.

    It is measured along the initial direction of slip.
    """
    least = np.inf
    for c in range(len(trial.p)):
        d = at(trial.friction.d, c)
        if dot(d, d) > 0.0 and dot(at(trial.p, c), at(trial.joints.normal, c)) > 0.0:
            least = smaller(least, dot(d, relative(trial.joints, c, v, w)))
    return least


@lent
def may_slip(setting: Setting, trial: Trial) -> bool:
    """Whether a sticking contact may begin to slip in a step because of prescribed motions."""
    if len(setting.drives.omega) + len(setting.shaking.omega) == 0:
        return False
    for c in range(len(trial.p)):
        p, n = at(trial.p, c), at(trial.joints.normal, c)
        normal = dot(p, n)
        square = dot(p, p) - normal * normal
        d = at(trial.friction.d, c)
        if dot(d, d) == 0.0 and normal > 0.0 and square > square_of(GRIP * setting.mu * normal):
            return True
    return False


@called
def time_to_slip_start(
    setting: Setting, state: State, past: Past, now: float, whole: float, dt: float,
    contacts: Contacts, trial: Trial,
) -> float:  # fmt: skip
    """The time [s] from `now` during which no sticking contact begins to slip, within `whole` [s].

    trial: that of the whole step. The time is the whole step if slip begins at once. Slip begins
    where it does so in a very short trial (GLIMPSE), whose mean force is the present one.
    """
    low, high, span = 0.0, whole, whole
    for look in range(2 + BEGINS):
        then, known, late = state, past, False
        if span > 0.0:
            if look > 0:
                trial = attempt(setting, state, now, span, contacts, past, trial.gaps.slack)
            late = marked(trial.begun)
            then = copy_of(state)
            move(setting, then, trial, span)
            least = least_slip_speed(span, setting.braking, setting.tolerance)
            known = past_after(trial, span, least)
        if not late:
            glimpse = attempt(
                setting, then, now + span, GLIMPSE * dt, contacts, known, setting.slack
            )
            late = marked(glimpse.begun)
        if look < 2 and late == (look == 1):
            return whole
        low, high = (low, span) if late else (span, high)
        span = 0.5 * (low + high) if look > 0 else 0.0
    return low if low > CLOSE * dt else whole


@called
def past_after(trial: Trial, span: float, least: float) -> Past:
    """The past of the step after a trial of `span` [s]; slip slower than `least` [m/s] is none."""
    still = unmarked(len(trial.p))
    for c in range(len(still)):
        n = at(trial.joints.normal, c)
        u = relative(trial.joints, c, trial.v, trial.w)
        slip = add_scaled(u, -dot(u, n), n)
        still[c] = dot(slip, slip) <= least * least and dot(at(trial.p, c), n) > 0.0
    return Past(trial.key, mean_forces(trial.p, span), still, trial.joints)
