"""Kernels for a trial step of a point mass on a plane."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vv.engines.kernels.arrays import smaller, square_of
from vv.engines.kernels.bundles import bundle
from vv.engines.kernels.compiled import called, lent
from vv.engines.kernels.drive import Drive, mean, rate, travel
from vv.engines.kernels.triples import Triple, add_scaled, cross, dot
from vv.engines.rigid.limits import AGREE, BENDS, CUTS, HALVINGS, LOOKS, MOSTLY, VEERED
from vv.engines.rigid.slip import STRAIGHT, bend, first_root, least_slip_speed
from vv.scene import Vector

ZERO = (0.0, 0.0, 0.0)


@bundle
class Ground(NamedTuple):
    """A plane and the fields that act on a unit mass.

    gravity, load: accelerations [m/s2]; normal, gap [m]: of the plane at t = 0; mu; base: the
    motion of the plane; shaking: an acceleration; hold: (3, 3) projector on the free directions,
    which contain the normal and the motion of the base; pull, braking, quick: see
    `vv.engines.rigid.scales`; fine: an upper bound on the rounding of slip velocities [m/s].
    """

    gravity: Triple
    load: Triple
    normal: Triple
    gap: float
    mu: float
    base: Drive
    shaking: Drive
    hold: Vector
    pull: float
    braking: float
    fine: float
    quick: float


class Touch(NamedTuple):
    """The end of a trial: relative velocity u, normal impulse p, tangential impulse rub [m/s]."""

    u: Triple
    p: float
    rub: Triple


@lent
def gap_at(ground: Ground, x: Triple, time: float) -> float:
    """The gap [m] at a displacement x and a time [s]."""
    return ground.gap + dot(ground.normal, add_scaled(x, -1.0, travel(ground.base, time)))


@lent
def tangential(ground: Ground, u: Triple) -> Triple:
    """The part of a velocity parallel to the plane."""
    return add_scaled(u, -dot(u, ground.normal), ground.normal)


@called
def with_contact(ground: Ground, u: Triple, need: float, d: Triple, turn: Triple) -> Touch:
    """The end of a step with contact, from the relative velocity u without contact.

    need: least value of u . normal [m/s]; d: unit direction of slip at the start of the step, or
    zero; turn: see `bend`. The tangential impulse lies in -mu p (d/2 + turn) + disc(mu p/2) and
    opposes the remaining slip; with d = 0 it lies in disc(mu p).
    """
    p = max(0.0, need - dot(u, ground.normal))
    along = tangential(ground, u)
    cap = ground.mu * p
    radius = 0.5 * cap if dot(d, d) > 0.0 else cap
    left = add_scaled(add_scaled(along, -0.5 * cap, d), -cap, turn)
    speed = np.sqrt(dot(left, left))
    kept = 1.0 - radius / speed if speed > radius else 0.0
    rub = add_scaled(add_scaled(ZERO, kept, left), -1.0, along)
    return Touch(add_scaled(add_scaled(u, p, ground.normal), 1.0, rub), p, rub)


@lent
def project_free(ground: Ground, a: Triple) -> Triple:
    """The part of a vector in the free directions."""
    hold = ground.hold
    return (
        hold[0, 0] * a[0] + hold[0, 1] * a[1] + hold[0, 2] * a[2],
        hold[1, 0] * a[0] + hold[1, 1] * a[1] + hold[1, 2] * a[2],
        hold[2, 0] * a[0] + hold[2, 1] * a[1] + hold[2, 2] * a[2],
    )


@lent
def free_velocity(ground: Ground, v: Triple, now: float, span: float) -> Triple:
    """The velocity after a step of `span` [s] without contact."""
    push = add_scaled(
        add_scaled(ground.gravity, 1.0, ground.load), 1.0, mean(ground.shaking, now, span)
    )
    return add_scaled(v, span, project_free(ground, push))


@called
def landing_time(ground: Ground, x: Triple, v: Triple, now: float, whole: float) -> float:
    """The time [s] until a mass in flight meets the plane, or `whole` if it does not.

    The gap is approximated by a parabola through its value at the end of a trial; its first root is
    the end of the next trial. Under constant forces and over a plane at rest it is exact at once.
    """
    gap = max(gap_at(ground, x, now), 0.0)
    speed = dot(ground.normal, add_scaled(v, -1.0, rate(ground.base, now)))
    span = whole
    for _ in range(LOOKS):
        middle = add_scaled(add_scaled(ZERO, 0.5, v), 0.5, free_velocity(ground, v, now, span))
        bent = gap_at(ground, add_scaled(x, span, middle), now + span) - gap - span * speed
        meets = first_root(gap, speed, bent / (span * span))
        if not meets < (1.0 - CUTS) * whole:
            return whole
        if abs(meets - span) <= CUTS * meets or meets <= CUTS * whole:
            return meets
        span = meets
    return span


@lent
def in_flight(ground: Ground, v: Triple, now: float, span: float) -> Touch:
    """The end of a step of `span` [s] without contact."""
    return Touch(
        add_scaled(free_velocity(ground, v, now, span), -1.0, rate(ground.base, now + span)),
        0.0,
        ZERO,
    )


@called
def trial_step(ground: Ground, x: Triple, v: Triple, now: float, span: float, d: Triple) -> Touch:
    """The end of a step of `span` [s] from x, v at `now`, with slip along d at its start."""
    free = add_scaled(free_velocity(ground, v, now, span), -1.0, rate(ground.base, now + span))
    need = -max(gap_at(ground, x, now), 0.0) / span
    touch = with_contact(ground, free, need, d, ZERO)
    if touch.p > 0.0 and dot(d, d) > 0.0 and dot(touch.u, d) > 0.0:
        before = tangential(ground, add_scaled(v, -1.0, rate(ground.base, now)))
        sag = sag_by_motions(ground, now, span)
        for _ in range(BENDS):
            turn = bend(before, sag, tangential(ground, touch.u), ground.mu * touch.p)
            if dot(turn, turn) == 0.0:
                break
            touch = with_contact(ground, free, need, d, turn)
    return touch


@called
def resolved_part(
    ground: Ground, x: Triple, v: Triple, now: float, whole: float, dt: float, d: Triple,
    touch: Touch,
) -> float:  # fmt: skip
    """The longest part [s] of a step, by halving, for which one step agrees with two half steps.

    touch: the trial of the whole step. Where slip almost stops, its direction turns within a
    fraction of a step and friction changes the path. Elsewhere steps resolve the turn, and no half
    steps are tried.
    """
    before = tangential(ground, add_scaled(v, -1.0, rate(ground.base, now)))
    after, span = tangential(ground, touch.u), whole
    for _ in range(HALVINGS if touch.p > 0.0 and dot(d, d) > 0.0 else 0):
        if not slip_turns(ground, now, span, before, after):
            break
        off = add_scaled(
            after, -1.0, tangential(ground, two_half_steps(ground, x, v, now, span, d).u)
        )
        part = smaller(AGREE * square_of(ground.quick * dt), MOSTLY)
        if not dot(off, off) > square_of(part * ground.mu * touch.p * dt / span):
            break
        span *= 0.5
        touch = trial_step(ground, x, v, now, span, d)
        after = tangential(ground, touch.u)
    return span


@lent
def slip_turns(ground: Ground, now: float, span: float, before: Triple, after: Triple) -> bool:
    """Whether slip changes its direction in a step, other than by reversal along the same line."""
    out, square = cross(before, after), dot(before, before) * dot(after, after)
    if dot(before, after) > 0.0:
        return dot(out, out) > VEERED * square
    bulge = cross(before, sag_by_motions(ground, now, span))
    return dot(out, out) + dot(bulge, bulge) > STRAIGHT * square


@called
def two_half_steps(
    ground: Ground, x: Triple, v: Triple, now: float, span: float, d: Triple
) -> Touch:
    """The end of two half steps in place of one of `span` [s]."""
    half = 0.5 * span
    touch = trial_step(ground, x, v, now, half, d)
    end = add_scaled(touch.u, 1.0, rate(ground.base, now + half))
    there = add_scaled(add_scaled(x, 0.5 * half, v), 0.5 * half, end)
    slip = tangential(ground, touch.u)
    speed, d = np.sqrt(dot(slip, slip)), ZERO
    if speed > least_slip_speed(half, ground.braking, ground.fine):
        d = add_scaled(ZERO, 1.0 / speed, slip)
    return trial_step(ground, there, end, now + half, half, d)


@lent
def sag_by_motions(ground: Ground, now: float, span: float) -> Triple:
    """The slip at mid-step minus the mean of those at its ends, by prescribed motions [m/s]."""
    sag = add_scaled(ZERO, 0.5 * span, mean(ground.shaking, now, 0.5 * span))
    sag = project_free(ground, add_scaled(sag, -0.5 * span, mean(ground.shaking, now, span)))
    sag = add_scaled(sag, -1.0, rate(ground.base, now + 0.5 * span))
    sag = add_scaled(
        add_scaled(sag, 0.5, rate(ground.base, now)), 0.5, rate(ground.base, now + span)
    )
    return tangential(ground, sag)
