"""The compiled kernel for one block that cannot rotate, on one wall: a point mass."""

from __future__ import annotations

import numpy as np

from vv.engines.kernels.compiled import called, compiled, lent
from vv.engines.kernels.drive import mean, rate
from vv.engines.kernels.triples import Triple, add_scaled, dot
from vv.engines.rigid.limits import BEGINS, CUTS, ENDS, GLIMPSE, GRIP, NEARLY, PARTS
from vv.engines.rigid.point.trial import (
    ZERO,
    Ground,
    Touch,
    gap_at,
    in_flight,
    landing_time,
    resolved_part,
    tangential,
    trial_step,
    with_contact,
)
from vv.engines.rigid.slip import least_slip_speed
from vv.scene import Vector


@lent
def slip_ended(ground: Ground, touch: Touch, touched: bool, d: Triple, span: float) -> bool:
    """Whether a slip along d ended or reversed within a trial of `span` [s]."""
    slips = touched and touch.p > 0.0 and dot(d, d) > 0.0
    return slips and dot(touch.u, d) <= least_slip_speed(span, ground.braking, ground.fine)


@lent
def least_begun_slip(ground: Ground, span: float) -> float:
    """The least speed [m/s] of a slip that has begun within a trial of `span` [s]."""
    return max(NEARLY * ground.pull * span, least_slip_speed(span, ground.braking, ground.fine))


@lent
def slip_began(ground: Ground, touch: Touch, touched: bool, d: Triple, span: float) -> bool:
    """Whether slip began within a trial that started without slip."""
    along = tangential(ground, touch.u)
    return (
        touched
        and touch.p > 0.0
        and dot(d, d) == 0.0
        and np.sqrt(dot(along, along)) > least_begun_slip(ground, span)
    )


@lent
def may_slip(ground: Ground, touch: Touch, touched: bool, d: Triple) -> bool:
    """Whether a sticking mass may begin to slip within the step because of prescribed motions."""
    driven = len(ground.base.omega) + len(ground.shaking.omega) > 0
    sticks = touched and dot(d, d) == 0.0
    return driven and sticks and dot(touch.rub, touch.rub) > (GRIP * ground.mu * touch.p) ** 2


@called
def slips_after(ground: Ground, x: Triple, v: Triple, now: float, after: float, dt: float) -> bool:
    """Whether a mass that sticks from `now` on begins to slip by a time `after` [s] later."""
    if after > 0.0:
        touch = trial_step(ground, x, v, now, after, ZERO)
        if slip_began(ground, touch, True, ZERO, after):
            return True
        end = add_scaled(touch.u, 1.0, rate(ground.base, now + after))
        x, v = add_scaled(add_scaled(x, 0.5 * after, v), 0.5 * after, end), end
    glimpse = GLIMPSE * dt
    return slip_began(
        ground, trial_step(ground, x, v, now + after, glimpse, ZERO), True, ZERO, glimpse
    )


@called
def time_to_event(
    ground: Ground, x: Triple, v: Triple, now: float, whole: float, dt: float, d: Triple,
    begun: bool,
) -> float:  # fmt: skip
    """The time [s] from `now` until slip begins or ends, within `whole` [s]; zero if at once."""
    low, high = 0.0, whole
    if begun and slips_after(ground, x, v, now, 0.0, dt):
        return 0.0
    for _ in range(BEGINS if begun else ENDS):
        span = 0.5 * (low + high)
        if begun:
            late = slips_after(ground, x, v, now, span, dt)
        else:
            late = slip_ended(ground, trial_step(ground, x, v, now, span, d), True, d, span)
        low, high = (low, span) if late else (span, high)
    return low if low > CUTS * dt else 0.0


@lent
def add_works(spent: Vector, touch: Touch, u: Triple, base: Triple, normal: Triple) -> None:
    """Add to spent, per mass, the energies lost by friction and impact and the work of the base.

    u: velocity relative to the base at the start of the step [m/s]; base: its mean velocity.
    """
    slid = add_scaled(add_scaled(ZERO, 0.5, u), 0.5, touch.u)
    spent[0] -= dot(touch.rub, slid)
    spent[1] -= touch.p * dot(normal, slid)
    spent[2] += dot(add_scaled(touch.rub, touch.p, normal), base)


@compiled
def move_point(  # noqa: PLR0912, PLR0915 - one loop, whose parts share all its variables
    path: Vector, energy: Vector, report: Vector, reaction: Vector,
    stride: int, dt: float, velocity: Triple, ground: Ground,
) -> int:  # fmt: skip
    """Advance a unit mass on a plane from a velocity [m/s] at t = 0; return the rows filled.

    v+ = v + h (gravity + load + mean shaking) + p and x+ = x + h (v + v+)/2, where u.n + gap/h >= 0
    at the end of the step is complementary to p.n >= 0. A step is divided where the mass lands,
    where slip begins, ends or reverses, and where it turns sharply (`resolved_part`). An impact
    takes no time.

    Every `stride` steps a row is written. path (k, 6): displacement and velocity. energy (k, 8),
    per mass: kinetic, lost by friction, lost by impact, work of the base, of shaking, of gravity,
    of the load, by removal of penetration. report (k, 4): residual, sweeps, deepest penetration [m]
    and number of divisions since the row before. reaction (k, 1, 3): force of the plane per mass at
    the row. It is one function since a step, and the decision to divide it, share its variables.
    """
    x, v, force, normal = ZERO, velocity, ZERO, ground.normal
    spent = np.zeros(7)
    touched, steps = False, 0
    for row in range(len(path)):
        deepest, cuts = 0.0, 0
        for _ in range(stride if row else 0):
            elapsed, stopped, start_sought = 0.0, False, False
            for part in range(PARTS):
                now, whole = steps * dt + elapsed, dt - elapsed
                w_old = rate(ground.base, now)
                u_old = add_scaled(v, -1.0, w_old)
                in_air, span = not touched and part + 1 < PARTS, whole
                if in_air:
                    span = landing_time(ground, x, v, now, whole)
                    if span <= CUTS * dt:
                        touch = with_contact(ground, u_old, 0.0, ZERO, ZERO)
                        add_works(spent, touch, u_old, w_old, normal)
                        v, touched = add_scaled(touch.u, 1.0, w_old), True
                        continue
                slip = tangential(ground, u_old)
                speed, d = np.sqrt(dot(slip, slip)), ZERO
                if speed > least_slip_speed(whole, ground.braking, ground.fine) and not stopped:
                    d = add_scaled(ZERO, 1.0 / speed, slip)
                ended = False
                touch = (
                    in_flight(ground, v, now, span)
                    if in_air
                    else trial_step(ground, x, v, now, span, d)
                )
                if touched and part + 1 < PARTS:
                    span = straight = resolved_part(ground, x, v, now, whole, dt, d, touch)
                    if span < whole:
                        touch = trial_step(ground, x, v, now, span, d)
                    ended = slip_ended(ground, touch, touched, d, span)
                    begun = not start_sought and (
                        slip_began(ground, touch, touched, d, span)
                        or (
                            may_slip(ground, touch, touched, d)
                            and slips_after(ground, x, v, now, whole, dt)
                        )
                    )
                    start_sought = start_sought or (begun and not ended)
                    if ended or begun:
                        span = time_to_event(ground, x, v, now, straight, dt, d, not ended)
                        if span == 0.0 and ended:
                            stopped = True
                            continue
                        span = span if span > 0.0 else straight
                        touch = trial_step(ground, x, v, now, span, d)
                w_new = rate(ground.base, now + span)
                v_new = add_scaled(touch.u, 1.0, w_new)
                middle = add_scaled(add_scaled(ZERO, 0.5, v), 0.5, v_new)
                force = add_scaled(add_scaled(ZERO, touch.p / span, normal), 1.0 / span, touch.rub)
                add_works(
                    spent,
                    touch,
                    u_old,
                    add_scaled(add_scaled(ZERO, 0.5, w_old), 0.5, w_new),
                    normal,
                )
                spent[3] += span * dot(mean(ground.shaking, now, span), middle)
                x = add_scaled(x, span, middle)
                deep = -gap_at(ground, x, now + span)
                if not (in_air and span < whole):
                    deep = max(0.0, deep)
                x = add_scaled(x, deep, normal)
                deepest = max(deepest, deep)
                moved = add_scaled(add_scaled(ZERO, span, middle), deep, normal)
                spent[4] += dot(ground.gravity, moved)
                spent[5] += dot(ground.load, moved)
                spent[6] += deep * dot(normal, add_scaled(ground.gravity, 1.0, ground.load))
                v, touched = v_new, touch.p > 0.0
                elapsed += span
                if span == whole:
                    break
                along = tangential(ground, touch.u)
                stopped = ended and np.sqrt(dot(along, along)) <= NEARLY * ground.pull * whole
                cuts += 1
            steps += 1
        for c in range(3):
            path[row, c], path[row, 3 + c] = x[c], v[c]
            reaction[row, 0, c] = force[c]
        energy[row, 0] = 0.5 * dot(v, v)
        for c in range(len(spent)):
            energy[row, 1 + c] = spent[c]
        report[row, 0], report[row, 1], report[row, 2] = 0.0, 1.0, deepest
        report[row, 3] = cuts
        if not np.isfinite(energy[row].sum()):
            return row
    return len(path)
