"""Kernels that find when, within a step of rigid blocks, a contact closes at a finite velocity."""

from __future__ import annotations

import numpy as np

from vv.engines.blocks.contacts import Contacts
from vv.engines.kernels.arrays import larger, smaller
from vv.engines.kernels.compiled import called, lent
from vv.engines.kernels.triples import at, dot
from vv.engines.rigid.general.setting import Past, Setting, State, least_impact_speed
from vv.engines.rigid.general.step import Trial, attempt
from vv.engines.rigid.limits import APART, CLOSELY, GENTLY, LANDED, LANDINGS, SHORTLY, SLOWLY
from vv.engines.rigid.slip import first_root
from vv.engines.rigid.solver.assembly import relative


@called
def time_to_landing(
    setting: Setting, state: State, past: Past, now: float, whole: float, dt: float,
    contacts: Contacts, trial: Trial,
) -> tuple[float, bool]:  # fmt: skip
    """The time [s] from `now` until a contact closes at a finite velocity, at most `whole` [s].

    trial: that of the whole step. The time is zero if a closed contact is approaching. A velocity
    that is finite beside what all forces give in a step counts at once; a slower one if it is
    finite beside what the contact gains itself, which takes a trial without it. Also returns
    whether a contact closes in this step or soon after. It must not act earlier: positions follow
    the mean of the velocities before and after an impact, so that blocks would go on penetrating
    for up to half a step.
    """
    fast = least_impact_speed(setting, dt)
    span = earliest_landing(setting, trial, dt, fast)
    if span == np.inf and speed_of_closing(setting, trial) > 0.0:
        free = attempt(setting, state, now, whole, contacts, past, APART * setting.slack)
        gained = gain_of_closing(setting, trial, free) * dt / whole
        fast = smaller(fast, larger(SLOWLY * gained, GENTLY * setting.tolerance))
        span = earliest_landing(setting, trial, dt, fast)
    there, span = span < np.inf, smaller(span, whole)
    if there and span == 0.0:  # the gap of the trial has an error of second order in the rotation
        brief = SHORTLY * whole
        trial = attempt(setting, state, now, brief, contacts, past, APART * setting.slack)
        soon = brief + time_to_closing(trial, brief)
        span = soon if LANDED * dt < soon < whole else 0.0
    for _ in range(LANDINGS if there and 0.0 < span < whole else 0):
        trial = attempt(setting, state, now, span, contacts, past, APART * setting.slack)
        more = time_to_closing(trial, span)
        span = larger(0.0, smaller(whole, span + more))
        if abs(more) <= LANDED * dt or span == 0.0 or (span == whole and more > whole):
            break
    if span > whole - LANDED * dt:
        return whole, there
    return span if span > LANDED * dt else 0.0, there


@lent
def earliest_landing(setting: Setting, trial: Trial, dt: float, fast: float) -> float:
    """A lower bound on the time [s] until a contact that acts in a trial closes, or infinity.

    Only contacts that close at a finite velocity count, faster than `fast` [m/s] or from afar;
    those that were pressed in the step before remain closed.
    """
    first, near = np.inf, CLOSELY * setting.pull * dt * dt
    for c in range(len(trial.p)):
        if not trial.gaps.known[c] and dot(at(trial.p, c), at(trial.joints.normal, c)) > 0.0:
            gap, opens = larger(trial.gaps.gap[c] - setting.slack, 0.0), trial.gaps.opens[c]
            if abs(opens) > fast or gap > near:
                first = smaller(first, first_root(gap, opens, -0.5 * setting.pull))
    return first


@lent
def begins(setting: Setting, trial: Trial, c: int) -> bool:
    """Whether a contact begins to act in a trial and approached faster than the residual."""
    acts = not trial.gaps.known[c] and dot(at(trial.p, c), at(trial.joints.normal, c)) > 0.0
    return acts and trial.gaps.opens[c] < -GENTLY * setting.tolerance


@lent
def speed_of_closing(setting: Setting, trial: Trial) -> float:
    """The largest velocity [m/s] with which a contact that `begins` approached, or zero."""
    most = 0.0
    for c in range(len(trial.p)):
        if begins(setting, trial, c):
            most = larger(most, -trial.gaps.opens[c])
    return most


@lent
def gain_of_closing(setting: Setting, trial: Trial, free: Trial) -> float:
    """The most by which the velocity [m/s] of a contact that `begins` changes without it.

    free: the same trial in which no new contact may act.
    """
    most = 0.0
    for c in range(len(trial.p)):
        if begins(setting, trial, c):
            late = dot(at(free.joints.normal, c), relative(free.joints, c, free.v, free.w))
            most = larger(most, abs(late - trial.gaps.opens[c]))
    return most


@lent
def impact_acted(setting: Setting, trial: Trial, dt: float) -> bool:
    """Whether an impact changed any normal velocity by half of `least_impact_speed` or more."""
    hardest = 0.0
    for c in range(len(trial.p)):
        normal = dot(at(trial.p, c), at(trial.joints.normal, c))
        hardest = larger(hardest, normal * trial.joints.across[c])
    return hardest > 0.5 * least_impact_speed(setting, dt)


@lent
def time_to_closing(trial: Trial, span: float) -> float:
    """The time [s] after a trial at which the first open gap closes, extrapolated by a parabola.

    Negative if a gap has closed within the trial, of length `span` [s].
    """
    first = np.inf
    for c in range(len(trial.p)):
        if not trial.gaps.known[c]:
            one = trial.gaps.opens[c]
            two = dot(at(trial.joints.normal, c), relative(trial.joints, c, trial.v, trial.w))
            gap = trial.gaps.gap[c] + 0.5 * span * (one + two)
            if gap >= 0.0:
                first = smaller(first, first_root(gap, two, 0.5 * (two - one) / span))
            elif two < 0.0:
                first = smaller(first, -gap / two)
    return first
