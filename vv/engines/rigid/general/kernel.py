"""The compiled kernel for rigid blocks: steps, which are divided at impacts and ends of slip."""

from __future__ import annotations

import numpy as np

from vv.engines.blocks.contacts import empty_contacts
from vv.engines.blocks.geometry import Index
from vv.engines.kernels.arrays import (
    clear,
    larger,
    marked,
    numbers,
    same_rows,
    smaller,
    zero_numbers,
    zero_rows,
    zero_squares,
)
from vv.engines.kernels.compiled import called, compiled_to_branch, lent
from vv.engines.kernels.drive import mean
from vv.engines.kernels.triples import add_scaled, at, dot, put
from vv.engines.rigid.general.energy import DRIVEN, SHOVED, add_works, kinetic
from vv.engines.rigid.general.events import (
    may_slip,
    move,
    past_after,
    past_with_impulses,
    time_to_slip_end,
    time_to_slip_start,
)
from vv.engines.rigid.general.landing import impact_acted, time_to_landing
from vv.engines.rigid.general.lever_arms import turned_back
from vv.engines.rigid.general.setting import Setting, State, fastest_speed, shift_at
from vv.engines.rigid.general.step import Trial, attempt, no_past
from vv.engines.rigid.general.turning import turn_by
from vv.engines.rigid.general.veering import time_of_even_slip
from vv.engines.rigid.limits import (
    APART,
    BRIEF,
    CUTS,
    HITS,
    IMPACT_TIME,
    NEARLY,
    PUSHES,
    SMALL,
    SPLITS,
)
from vv.engines.rigid.slip import least_slip_speed
from vv.engines.rigid.solver.assembly import relative
from vv.engines.rigid.solver.cone import push_out
from vv.scene import Vector

ZERO = (0.0, 0.0, 0.0)


@called
def remove_penetration(
    account: Vector, setting: Setting, state: State, trial: Trial, before: State,
    now: float, span: float,
) -> float:  # fmt: skip
    """Remove penetration from positions; return the deepest penetration before that [m]."""
    n, b = len(setting.mass), len(trial.v)
    x, turn = zero_rows(b), zero_rows(b)
    start, end = shift_at(setting, now), shift_at(setting, now + span)
    for i in range(b):
        if i < n:
            put(x, i, add_scaled(at(state.centre, i), -1.0, at(before.centre, i)))
            put(
                turn,
                i,
                add_scaled(
                    add_scaled(ZERO, 0.5 * span, at(before.w, i)), 0.5 * span, at(trial.w, i)
                ),
            )
        else:
            put(x, i, add_scaled(at(end, i - n), -1.0, at(start, i - n)))
    gap, deepest = numbers(len(trial.gaps.gap)), 0.0
    for c in range(len(gap)):
        moved = relative(trial.joints, c, x, turn)
        gap[c] = trial.gaps.gap[c] + dot(at(trial.joints.normal, c), moved)
        if trial.joints.across[c] > 0.0:
            deepest = larger(deepest, -gap[c])
    if deepest > setting.slack:
        push_out(trial.joints, trial.bodies, gap, x, turn, PUSHES)
        for i in range(n):
            put(state.centre, i, add_scaled(at(state.centre, i), 1.0, at(x, i)))
            put(state.moved, i, add_scaled(at(state.moved, i), 1.0, at(x, i)))
            if dot(at(turn, i), at(turn, i)) > 0.0:
                turn_by(at(turn, i), same_rows(state.rotation[i], 3), state.rotation[i])
            account[DRIVEN] += dot(at(setting.force, i), at(x, i))
            account[SHOVED] += dot(at(setting.force, i), at(x, i))
    return deepest


@lent
def add_impulses(impulses: Vector, setting: Setting, trial: Trial, now: float, span: float) -> None:
    """Add the impulses (b, 3) [N s] of contacts and shaking on bodies in a step to `impulses`."""
    shake = mean(setting.shaking, now, span)
    for i in range(len(setting.mass)):
        put(impulses, i, add_scaled(at(impulses, i), span * setting.mass[i], shake))
    for c in range(len(trial.p)):
        a, b = trial.joints.first[c], trial.joints.second[c]
        late = add_scaled(at(trial.p, c), -1.0, at(trial.acted, c))
        p = add_scaled(turned_back(trial.turn, c, at(trial.acted, c)), 1.0, late)
        put(impulses, b, add_scaled(at(impulses, b), 1.0, p))
        put(impulses, a, add_scaled(at(impulses, a), -1.0, p))


@lent
def fill_forces(force: Vector, setting: Setting, trial: Trial, now: float, span: float) -> None:
    """Fill force (b, 3) [N] with the mean forces of contacts and shaking on bodies in a step."""
    clear(force)
    add_impulses(force, setting, trial, now, span)
    for i in range(len(force)):
        put(force, i, add_scaled(ZERO, 1.0 / span, at(force, i)))


@lent
def fill_reaction(row: Vector, force: Vector, impulses: Vector) -> None:
    """Fill row (b, 6) with forces and impulses (b, 3)."""
    for i in range(len(row)):
        for c in range(3):
            row[i, c], row[i, 3 + c] = force[i, c], impulses[i, c]


@lent
def fill_path(path: Vector, watched: Index, state: State) -> None:
    """Fill path (b, 9) with displacement, velocity and spin of the watched blocks."""
    for k in range(len(watched)):
        i = watched[k]
        for c in range(3):
            path[k, c] = state.moved[i, c]
            path[k, 3 + c] = state.v[i, c]
            path[k, 6 + c] = state.w[i, c]


@compiled_to_branch
def move_rigid(  # noqa: PLR0912, PLR0915 - one loop, whose parts share all its variables
    path: Vector, energy: Vector, report: Vector, reaction: Vector, watched: Index,
    stride: int, dt: float, setting: Setting,
    centre: Vector, v: Vector, w: Vector,
) -> int:  # fmt: skip
    """Advance the blocks in time; return the number of rows filled.

    centre, v, w: (n, 3) at t = 0. Velocities follow from v+ = v + M^-1 (h f + J^T p), positions by
    the trapezoidal rule, contacts as in `vv.engines.rigid.solver.cone` with
    need = -max(gap - slack, 0)/h. Penetration is removed from positions alone, by the least
    displacement. With at most SMALL blocks, a step is divided where a contact closes at a finite
    velocity, where a slip ends and, once, where one begins; and it is halved where a slow slip
    turns.

    Every `stride` steps a row is written. path (k, b, 9): displacement, velocity and spin of the
    watched blocks. energy (k, 8) [J]: kinetic, lost by friction, lost by impact, work of walls, of
    shaking, of gravity and loads, by removal of penetration, by rotation of lever arms. report (k,
    4): the largest residual [m/s], number of sweeps and penetration [m] of a step since the row
    before, and the number of divisions since then. reaction (k, b, 6): forces [N] of contacts and
    shaking on bodies at the row, those of the first step in the first row, and their impulses since
    t = 0 [N s]. It is one function since a step, and the decision to divide it, share its
    variables.
    """
    n = len(setting.mass)
    rotation = zero_squares(n)
    for i in range(n):
        rotation[i, 0, 0] = rotation[i, 1, 1] = rotation[i, 2, 2] = 1.0
    here = same_rows(centre, n)
    state = State(here, zero_rows(n), rotation, same_rows(v, n), same_rows(w, n))
    account, contacts = zero_numbers(7), empty_contacts(64 + 0 * n)
    past = no_past(contacts, setting)
    parts = SPLITS if n <= SMALL else 1
    pressed, impulses, steps = zero_rows(reaction.shape[1]), zero_rows(reaction.shape[1]), 0
    for row in range(len(path)):
        for c in range(report.shape[1]):
            report[row, c] = 0.0
        for _ in range(stride if row else 0):
            elapsed, start_sought, impact, impact_ruled_out = 0.0, False, False, False
            for part in range(parts):
                now, remaining, divisible = steps * dt + elapsed, dt - elapsed, part + 1 < parts
                whole, lands_later = remaining, False
                if not impact:
                    trial = attempt(setting, state, now, remaining, contacts, past, setting.slack)
                    if divisible and not impact_ruled_out:
                        whole, lands_later = time_to_landing(
                            setting, state, past, now, remaining, dt, contacts, trial
                        )
                        impact = whole == 0.0
                if impact:
                    whole = smaller(IMPACT_TIME * dt, remaining)
                    wide = setting.slack + HITS * dt * fastest_speed(setting, state, now, dt)
                    trial = attempt(setting, state, now, whole, contacts, past, wide)
                    impact_ruled_out = not impact_acted(setting, trial, dt)
                elif lands_later:
                    trial = attempt(
                        setting, state, now, whole, contacts, past, APART * setting.slack
                    )
                span, least = whole, least_slip_speed(whole, setting.braking, setting.tolerance)
                if impact:
                    least = least_slip_speed(dt, setting.braking, setting.tolerance)
                elif divisible and marked(trial.ended):
                    span = time_to_slip_end(setting, state, past, now, whole, dt, contacts, trial)
                    least = larger(least, NEARLY * setting.pull * whole)
                    if span < 0.0:
                        impact, span = True, IMPACT_TIME * dt
                        past = past_with_impulses(trial, span)
                        trial = attempt(setting, state, now, span, contacts, past, setting.slack)
                        past, span = past_with_impulses(trial, span), 0.0
                    if span == 0.0:
                        continue
                elif (divisible and not start_sought) and (
                    marked(trial.begun) or may_slip(setting, trial)
                ):
                    start_sought = True
                    span = time_to_slip_start(setting, state, past, now, whole, dt, contacts, trial)
                if span < whole:
                    trial = attempt(setting, state, now, span, contacts, past, trial.gaps.slack)
                if divisible and not impact:
                    whole = span
                    span = time_of_even_slip(setting, state, past, now, whole, dt, contacts, trial)
                    if span < whole:
                        trial = attempt(setting, state, now, span, contacts, past, trial.gaps.slack)
                from_here = same_rows(state.centre, n)
                before = State(
                    from_here, state.moved, state.rotation, state.v, same_rows(state.w, n)
                )
                add_works(account, setting, state, trial, now, span, impact)
                move(setting, state, trial, span)
                deepest = remove_penetration(account, setting, state, trial, before, now, span)
                # the impulse of an impact does not act on
                averaged = dt / CUTS if impact else larger(span, BRIEF * dt)
                past = past_after(trial, averaged, least)
                add_impulses(impulses, setting, trial, now, span)
                if not impact:
                    fill_forces(pressed, setting, trial, now, span)
                impact = False
                report[row, 0] = larger(report[row, 0], trial.residual)
                report[row, 1] = larger(report[row, 1], float(trial.sweeps))
                report[row, 2] = larger(report[row, 2], deepest)
                if not np.isfinite(kinetic(setting, state)):  # contacts cannot be detected
                    return row
                elapsed += span
                if span == remaining:
                    break
                report[row, 3] += 1.0
            steps += 1
            if steps == 1:
                fill_reaction(reaction[0], pressed, zero_rows(len(impulses)))
        if row > 0:
            fill_reaction(reaction[row], pressed, impulses)
        fill_path(path[row], watched, state)
        energy[row, 0] = total = kinetic(setting, state)
        for c in range(len(account)):
            energy[row, 1 + c] = account[c]
            total += account[c]
        if not np.isfinite(total):
            return row
    return len(path)
