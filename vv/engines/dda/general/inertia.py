"""The inertia terms of a step, the velocities after it, and when a slide stops in it; kernels.

A rule holds alpha_m, alpha_f, beta and gamma, see `Stepping`. A step is solved for the unknowns u =
(1 - alpha_f) d at the time at which forces are evaluated; d are those at its end.
"""

from __future__ import annotations

from vv.engines.dda.general.bodies import Bodies, Motion, times_blocks
from vv.engines.dda.general.contact import States, Touch
from vv.engines.dda.general.setting import Part, Rule, Setting
from vv.engines.dda.law import SLIDE, share_to_stop
from vv.engines.kernels.arrays import numbers, smaller, square_of
from vv.engines.kernels.compiled import called, lent
from vv.engines.kernels.drive import one_of, rate
from vv.engines.kernels.triples import NOWHERE, add_scaled, at, dot
from vv.scene import Vector


@lent
def inertia_terms(
    predictor: Vector, velocity: Vector, rate: Vector, rule: Rule, step: float
) -> float:
    """Fill predictor (q,) from velocities and accelerations `rate` (q,); return inertia's weight.

    M ((1 - alpha_m) a1 + alpha_m a0) is then weight M (u/D - predictor)/D.
    """
    alpha_m, alpha_f, beta, _ = rule
    share = 1.0 - alpha_f
    lead = (0.5 - beta - alpha_m * beta / (1.0 - alpha_m)) * step
    for a in range(len(predictor)):
        predictor[a] = share * (velocity[a] + lead * rate[a])
    return (1.0 - alpha_m) / (share * beta)


@called
def update_velocities(
    velocity: Vector, rate: Vector, d: Vector, mass: Vector, bodies: Bodies, rule: Rule, step: float
) -> float:
    """Set velocities and accelerations (q,) to those after the step d (q,); return the loss [J].

    The loss is the work of M ((1 - alpha_m) a1 + alpha_m a0) over d minus the gain of kinetic
    energy. It is computed from the changes of accelerations, so that it is exactly zero for DDA's
    own rule.
    """
    alpha_m, _, beta, gamma = rule
    q, ahead = len(d), gamma / beta
    jump, flow = numbers(q), numbers(q)
    for a in range(q):
        after = (d[a] / step - velocity[a]) / (beta * step) - (0.5 / beta - 1.0) * rate[a]
        jump[a], rate[a] = after - rate[a], after
    times_blocks(flow, mass, bodies, jump)
    by_speed = step * (1.0 - gamma - alpha_m)
    by_rate = step * step * (beta + 0.5 - gamma - 0.5 * alpha_m)
    by_jump = step * step * (alpha_m * (0.5 - beta) - 0.5 * square_of(1.0 - gamma))
    lost = 0.0
    for a in range(q):
        lost += flow[a] * (by_speed * velocity[a] + by_rate * rate[a] + by_jump * jump[a])
        before = rate[a] - jump[a]
        kept = (1.0 - ahead) * velocity[a] + step * (1.0 - 0.5 * ahead) * before
        velocity[a] = ahead / step * d[a] + kept
    return lost


@called
def part_to_stop(
    touch: Touch, before: States, relative: Vector, setting: Setting, motion: Motion, part: Part
) -> float:
    """The fraction of a part of a step after which the first slide stops that it begins with, or 1.

    before: the contacts at its beginning; relative (c, 3): their relative displacements [m] in it;
    the time at its beginning is negative while walls are at rest.
    """
    base, starts, time = setting.base, setting.starts, part.time
    share = 1.0
    for k in range(len(touch.wall)):
        if before.state[k] == SLIDE:
            along = at(before.direction, k)
            speed = NOWHERE
            for m in range(touch.columns[k]):
                speed = add_scaled(
                    speed, motion.velocity[touch.column[k, m]], at(touch.field[k], m)
                )
            if touch.wall[k] >= 0 and time >= 0.0:
                speed = add_scaled(speed, -1.0, rate(one_of(base, starts, touch.wall[k]), time))
            slip = dot(at(relative, k), along)
            share = smaller(share, share_to_stop(part.length * dot(speed, along), slip))
    return share
