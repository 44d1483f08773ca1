"""Kernels for a trial step of rigid blocks: contacts at its end, solved to a residual."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vv.engines.blocks.contacts import Contacts, detect, empty_contacts, matched
from vv.engines.blocks.geometry import Index
from vv.engines.blocks.placement import place_rigid
from vv.engines.kernels.arrays import (
    counts,
    larger,
    least_of,
    numbers,
    rows,
    same_counts,
    squares,
    unmarked,
    zero_numbers,
    zero_rows,
    zero_squares,
)
from vv.engines.kernels.bundles import bundle
from vv.engines.kernels.compiled import called
from vv.engines.kernels.triples import add_scaled, at, dot, put
from vv.engines.rigid.general.bends import set_turns
from vv.engines.rigid.general.converge import converged
from vv.engines.rigid.general.lever_arms import act_at_midstep, halfway
from vv.engines.rigid.general.setting import (
    Past,
    Setting,
    State,
    fastest_speed,
    forecast,
    free_velocities,
    residual_asked,
    shift_at,
    wall_rates,
)
from vv.engines.rigid.limits import NEARLY, SMALL, UNHINTED
from vv.engines.rigid.slip import least_slip_speed
from vv.engines.rigid.solver.assembly import Bodies, Joints, apply_nonzero, assemble, relative
from vv.engines.rigid.solver.problem import Friction, Problem
from vv.scene import Mask, Vector

ZERO = (0.0, 0.0, 0.0)
EPS = 2.0**-52


@bundle
class Gaps(NamedTuple):
    """The c contacts at the start of a step.

    gap: (c,) [m], of which those up to `slack` [m] count as zero; opens: (c,) their rates [m/s];
    known: (c,) whether the contact was pressed in the step before.
    """

    gap: Vector
    slack: float
    opens: Vector
    known: Mask


@bundle
class Trial(NamedTuple):
    """The result of a step of a given length.

    joints: at its end; middle, turn: see `halfway`; v, w: (b, 3) at its end; p: (c, 3) impulses
    [N s], of which `acted` acts at mid-step and the negligible rest at the end; begun: (c,) whether
    a sticking contact began to slip; ended: (c,) whether slip ended or reversed; friction holds
    the directions of slip at the start of the step.
    """

    joints: Joints
    middle: Joints
    turn: Vector
    bodies: Bodies
    friction: Friction
    key: Index
    p: Vector
    acted: Vector
    gaps: Gaps
    v: Vector
    w: Vector
    begun: Mask
    ended: Mask
    sweeps: int
    residual: float


@called
def detected(
    contacts: Contacts, setting: Setting, vertex: Vector, normal: Vector, shift: Vector,
    margin: float,
) -> tuple[Contacts, int]:  # fmt: skip
    """All contacts with gaps up to `margin` [m], in arrays long enough, and their number."""
    found, s = contacts, setting
    count = detect(found, s.shapes, vertex, normal, s.moves, s.planes, shift, s.depth, margin)
    while count > len(found.gap):
        found = empty_contacts(2 * count)
        count = detect(found, s.shapes, vertex, normal, s.moves, s.planes, shift, s.depth, margin)
    return found, count


@called
def no_past(contacts: Contacts, setting: Setting) -> Past:
    """The past before the first step: no contacts."""
    none = squares(0)
    joints = assemble(contacts, 0 * len(setting.mass), Bodies(none, none, rows(0)))
    return Past(counts(0), rows(0), unmarked(0), joints)


@called
def attempt(
    setting: Setting, state: State, now: float, span: float, contacts: Contacts, past: Past,
    slack: float,
) -> Trial:  # fmt: skip
    """The trial of a step from `state` at `now` over `span` [s]; the state is not changed.

    slack [m]: gaps of new contacts up to this count as zero, so that contacts are sought as far as
    this. In a part of a step, contacts that were pressed before count as closed: their gaps are of
    second order, and closing them in less than a step would give the block an impulse. If slack is
    larger than the setting's, the trial is an impact. New contacts then have no initial direction
    of friction, since they hardly move before it and may do so in any direction. It is one function
    since it only prepares arrays, each for the next, for one call of `solved`.
    """
    n, b = len(setting.mass), len(setting.inverse)
    rotation, turned = squares(n), zero_squares(b)
    centre, w, w_old = zero_rows(b), zero_rows(b), zero_rows(b)
    v, v_old, v_mean = zero_rows(b), zero_rows(b), zero_rows(b)
    forecast(setting, state, span, rotation, w, turned)
    free_velocities(setting, state, now, span, v)
    shift, here = shift_at(setting, now + span), shift_at(setting, now)
    wall_rates(setting, now, v_old)
    for i in range(n):
        put(centre, i, add_scaled(at(state.centre, i), span, at(state.v, i)))
        put(v_old, i, at(state.v, i))
        put(v_mean, i, at(state.v, i))
        put(w_old, i, add_scaled(add_scaled(ZERO, 0.5, at(state.w, i)), 0.5, at(w, i)))
    for k in range(b - n):
        put(
            v_mean,
            n + k,
            add_scaled(add_scaled(ZERO, 1.0 / span, at(shift, k)), -1.0 / span, at(here, k)),
        )
    vertex, normal = rows(len(setting.shapes.vertex)), rows(len(setting.shapes.normal))
    place_rigid(vertex, normal, setting.shapes, centre[:n], rotation)
    fastest = fastest_speed(setting, state, now, span)
    smallest = least_of(setting.shapes.size)
    margin = larger(2.0 * span * fastest + 1e-6 * smallest, slack)
    found, count = detected(contacts, setting, vertex, normal, shift, margin)
    bodies = Bodies(setting.inverse, turned, centre)
    joints = assemble(found, count, bodies)
    before = matched(found.key, count, past.key)
    friction = Friction(setting.mu, zero_numbers(count), zero_rows(count), zero_rows(count))
    p, gap, opens = zero_rows(count), numbers(count), numbers(count)
    known, apart = unmarked(count), 0.0
    for c in range(count):
        m = at(joints.normal, c)
        gap[c] = found.gap[c] - span * dot(m, relative(joints, c, v_mean, w_old))
        u = relative(joints, c, v_old, w_old)
        opens[c] = dot(u, m)
        slip = add_scaled(u, -opens[c], m)
        speed = np.sqrt(dot(slip, slip))
        if before[c] >= 0:
            was = at(past.joints.normal, before[c])
            opens[c] = dot(was, relative(past.joints, before[c], v_old, w_old))
            put(p, c, add_scaled(ZERO, span, at(past.force, before[c])))
            known[c] = dot(at(p, c), m) > 0.0
        begun = gap[c] - (setting.slack if known[c] else slack)
        if begun > 0.0 and not (known[c] and span < setting.step):
            friction.need[c], apart = -begun / span, EPS * smallest / span
        held = (slack > setting.slack and not known[c]) or (
            before[c] >= 0 and past.still[before[c]]
        )
        if speed > least_slip_speed(span, setting.braking, setting.tolerance) and not held:
            put(friction.d, c, add_scaled(ZERO, 1.0 / speed, slip))
    middle, turn = halfway(joints, before, past.joints)
    tolerance = residual_asked(setting, fastest, apart)
    if n > SMALL:
        tolerance = setting.tolerance * (UNHINTED if len(past.key) == 0 else 1.0)
    return solved(
        setting, now, span, Problem(joints, bodies, friction, p, v, w), middle, turn,
        same_counts(found.key, count), Gaps(gap, slack, opens, known), v_old, w_old, tolerance,
    )  # fmt: skip


@called
def solved(
    setting: Setting, now: float, span: float, problem: Problem, middle: Joints, turn: Vector,
    key: Index, gaps: Gaps, v_old: Vector, w_old: Vector, tolerance: float,
) -> Trial:  # fmt: skip
    """Solve the contacts of a trial; the direction of friction follows the resulting slip.

    A slip ends at what the residual of this trial may leave, since it keeps that to the end of the
    step. It is one function, of many parameters, since a trial holds most of them.
    """
    p, joints, bodies, friction = problem.p, problem.joints, problem.bodies, problem.friction
    v, w = problem.v, problem.w
    count, acted = len(p), zero_rows(len(p))
    for c in range(count):
        apply_nonzero(joints, c, bodies, v, w, at(p, c))
    act_at_midstep(problem, acted, middle, turn)
    sweeps, left = converged(setting, problem, setting.fewest, tolerance)
    begun, ended = unmarked(count), unmarked(count)
    any_ended, least = False, least_slip_speed(span, setting.braking, larger(tolerance, left))
    most = least_slip_speed(span, setting.braking, setting.tolerance)
    most = larger(most, NEARLY * setting.pull * span)
    for c in range(count):
        n, d = at(joints.normal, c), at(friction.d, c)
        if (gaps.known[c] or gaps.gap[c] <= setting.slack) and dot(at(p, c), n) > 0.0:
            u = relative(joints, c, v, w)
            slip = add_scaled(u, -dot(u, n), n)
            slips = dot(d, d) > 0.0
            begun[c] = gaps.known[c] and not slips and dot(slip, slip) > most * most
            ended[c] = slips and dot(u, d) <= least
            any_ended = any_ended or ended[c]
    for _ in range(0 if any_ended else setting.bends):
        turns = set_turns(setting, now, span, problem, v_old, w_old)
        moved = act_at_midstep(problem, acted, middle, turn)
        if not turns and moved <= tolerance:
            break
        few = 0 * sweeps  # numba would compile the solver once more for a literal 0
        more, left = converged(setting, problem, few, tolerance)
        sweeps += more
        if more == 0:
            break
    return Trial(
        joints,
        middle,
        turn,
        bodies,
        friction,
        key,
        p,
        acted,
        gaps,
        v,
        w,
        begun,
        ended,
        sweeps,
        left,
    )
