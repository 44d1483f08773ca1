"""Kernels that find where within a step of rigid blocks a slip begins or ends."""

from __future__ import annotations

import numpy as np

from vv.engines.blocks.contacts import Contacts, matched
from vv.engines.kernels.arrays import (
    marked,
    nil_rows,
    rows,
    same_rows,
    smaller,
    square_of,
    unmarked,
)
from vv.engines.kernels.compiled import called, lent
from vv.engines.kernels.triples import add_scaled, at, dot, put
from vv.engines.rigid.general.setting import Past, Setting, State, copied, felt, rates
from vv.engines.rigid.general.step import Trial, attempt
from vv.engines.rigid.general.turning import orthonormal, turn_by
from vv.engines.rigid.limits import BEGINS, CLOSE, ENDS, GLIMPSE, GRIP
from vv.engines.rigid.slip import slow
from vv.engines.rigid.solver.assembly import relative
from vv.scene import Vector

NIL = (0.0, 0.0, 0.0)


@called
def move(setting: Setting, state: State, trial: Trial, span: float) -> None:
    """Put the trial's end into the state: positions by the trapezoidal rule."""
    for i in range(len(setting.mass)):
        v, w = at(trial.v, i), at(trial.w, i)
        put(state.centre, i, add_scaled(add_scaled(at(state.centre, i), 0.5 * span, at(state.v, i)),
                                  0.5 * span, v))  # fmt: skip
        angle = add_scaled(add_scaled(NIL, 0.5 * span, at(state.w, i)), 0.5 * span, w)
        if dot(angle, angle) > 0.0:
            turn_by(angle, same_rows(state.rotation[i], 3), state.rotation[i])
            orthonormal(state.rotation[i])
        put(state.v, i, v)
        put(state.w, i, w)


@called
def ends_after(
    setting: Setting, state: State, past: Past, now: float, whole: float, dt: float,
    contacts: Contacts, trial: Trial,
) -> float:  # fmt: skip
    """How long [s] of a step, whose trial this is, all slip goes on.

    Nil if some ends at once: then `past` is told that it has. Negative if it does so from a speed:
    then it jams, by a blow. The end is enclosed from both
    sides; where to look is told by how the slowest slip slows down.
    """
    v, w = nil_rows(len(trial.v)), nil_rows(len(trial.v))
    rates(setting, state, now, v, w)
    low, high, late, speed, guess = 0.0, whole, trial, slowest(trial, v, w), -1.0
    if speed > felt(setting, dt):
        brief = CLOSE * dt
        jam = attempt(setting, state, now, brief, contacts, hinted(trial, brief), trial.gaps.slack)
        if marked(jam.ended):
            return -1.0
    for look in range(ENDS):
        if high - low <= CLOSE * dt:
            break
        span = guess
        if not low < span < high or look % 4 == 3:
            span = 0.5 * (low + high)
        trial = attempt(setting, state, now, span, contacts, past, trial.gaps.slack)
        if marked(trial.ended):
            high, late, guess = span, trial, guess - 0.5 * CLOSE * dt
        else:
            left = slowest(trial, trial.v, trial.w)
            guess = span + left * (span - low) / (speed - left) + 0.25 * CLOSE * dt
            low, speed = span, left
    if low <= CLOSE * dt:
        row = matched(late.key, len(late.key), past.key)
        for c in range(len(row)):
            if late.ended[c] and row[c] >= 0:
                past.still[row[c]] = True
        return 0.0
    return low


@called
def shared_out(impulse: Vector, span: float) -> Vector:
    """The mean forces (c, 3) [N] of impulses within a span [s]."""
    force = rows(len(impulse))
    for c in range(len(impulse)):
        for k in range(3):
            force[c, k] = impulse[c, k] / span
    return force


@called
def hinted(trial: Trial, span: float) -> Past:
    """What a step of this span must know to begin with the impulses of a trial.

    A rod that is about to jam takes ever more sweeps to find, from nothing, the impulse that does.
    """
    return Past(trial.key, shared_out(trial.p, span), unmarked(len(trial.p)), trial.joints)


@lent
def slowest(trial: Trial, v: Vector, w: Vector) -> float:
    """The least speed [m/s], under velocities v, w (b, 3), along any slip there was at first."""
    least = np.inf
    for c in range(len(trial.p)):
        d = at(trial.friction.d, c)
        if dot(d, d) > 0.0 and dot(at(trial.p, c), at(trial.joints.normal, c)) > 0.0:
            least = smaller(least, dot(d, relative(trial.joints, c, v, w)))
    return least


@lent
def strained(setting: Setting, trial: Trial) -> bool:
    """Whether a contact that sticks under a drive may slip before the step's end."""
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
def rests_for(
    setting: Setting, state: State, past: Past, now: float, whole: float, dt: float,
    contacts: Contacts, trial: Trial,
) -> float:  # fmt: skip
    """How long [s] of a step, whose trial this is, no contact that sticks begins to slip.

    The whole step if one does at once: where slip would begin in a glimpse of a step, whose mean
    force is the one of now.
    """
    low, high, span = 0.0, whole, whole
    for look in range(2 + BEGINS):
        then, known, late = state, past, False
        if span > 0.0:
            if look > 0:
                trial = attempt(setting, state, now, span, contacts, past, trial.gaps.slack)
            late = marked(trial.begun)
            then = copied(state)
            move(setting, then, trial, span)
            known = remembered(trial, span, slow(span, setting.pull, setting.tolerance))
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
def remembered(trial: Trial, span: float, least: float) -> Past:
    """What the next step must know of this one; slower slip than `least` [m/s] is none."""
    still = unmarked(len(trial.p))
    for c in range(len(still)):
        n = at(trial.joints.normal, c)
        u = relative(trial.joints, c, trial.v, trial.w)
        slip = add_scaled(u, -dot(u, n), n)
        still[c] = dot(slip, slip) <= least * least and dot(at(trial.p, c), n) > 0.0
    return Past(trial.key, shared_out(trial.p, span), still, trial.joints)
