"""Kernels that find where within a step of rigid blocks a contact closes at a speed."""

from __future__ import annotations

import numpy as np

from vv.engines.blocks.contacts import Contacts
from vv.engines.kernels.arrays import larger, smaller
from vv.engines.kernels.compiled import called, lent
from vv.engines.kernels.triples import at, dot
from vv.engines.rigid.general.setting import Past, Setting, State, felt
from vv.engines.rigid.general.step import Trial, attempt
from vv.engines.rigid.limits import APART, CLOSELY, LANDED, LANDINGS, SHORTLY
from vv.engines.rigid.slip import first_root
from vv.engines.rigid.solver.assembly import relative


@called
def lands_after(
    setting: Setting, state: State, past: Past, now: float, whole: float, dt: float,
    contacts: Contacts, trial: Trial,
) -> tuple[float, bool]:  # fmt: skip
    """How long [s] of a step, whose trial this is, until a contact closes at a speed.

    And whether one does so in this step or soon after, which must not act before: moved at the
    mean of the velocities before and after a blow, blocks would go on into one another for up to
    half a step. Nil where one that is closed already does; the whole step where none does in it.
    """
    span = landing(setting, trial, dt)
    there, span = span < np.inf, smaller(span, whole)
    if there and span == 0.0:  # as told from the end, off by the square of what turns until then
        brief = SHORTLY * whole
        trial = attempt(setting, state, now, brief, contacts, past, APART * setting.slack)
        soon = brief + closing(trial, brief)
        span = soon if LANDED * dt < soon < whole else 0.0
    for _ in range(LANDINGS if there and 0.0 < span < whole else 0):
        trial = attempt(setting, state, now, span, contacts, past, APART * setting.slack)
        more = closing(trial, span)
        span = larger(0.0, smaller(whole, span + more))
        if abs(more) <= LANDED * dt or span == 0.0 or (span == whole and more > whole):
            break
    if span > whole - LANDED * dt:
        return whole, there
    return span if span > LANDED * dt else 0.0, there


@lent
def landing(setting: Setting, trial: Trial, dt: float) -> float:
    """The earliest [s] that a contact may close at a speed, if a trial says that one does.

    Else infinite. What has pressed before is closed and stays so.
    """
    first, near, fast = np.inf, CLOSELY * setting.pull * dt * dt, felt(setting, dt)
    for c in range(len(trial.p)):
        if not trial.gaps.known[c] and dot(at(trial.p, c), at(trial.joints.normal, c)) > 0.0:
            gap, opens = larger(trial.gaps.gap[c] - setting.slack, 0.0), trial.gaps.opens[c]
            if abs(opens) > fast or gap > near:
                first = smaller(first, first_root(gap, opens, -0.5 * setting.pull))
    return first


@lent
def struck(setting: Setting, trial: Trial, dt: float) -> bool:
    """Whether a blow stopped anything."""
    hardest = 0.0
    for c in range(len(trial.p)):
        normal = dot(at(trial.p, c), at(trial.joints.normal, c))
        hardest = larger(hardest, normal * trial.joints.across[c])
    return hardest > 0.5 * felt(setting, dt)


@lent
def closing(trial: Trial, span: float) -> float:
    """How long [s] after a trial of a span the first of its gaps closes, each by a parabola.

    Negative if one has closed within.
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
