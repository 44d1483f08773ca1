"""Sweeps over the contacts of many blocks, with leaps along their slow drift.

Where sweeps seem to stall they drift: impulses of a few blocks change by the same small amount in
each of thousands of sweeps, until a contact opens, slips or sticks. A leap extrapolates many such
changes at once; some sweeps then correct its errors elsewhere. A leap that increases the residual
is undone.
"""

from __future__ import annotations

import numpy as np

from vv.engines.kernels.arrays import rows, smaller
from vv.engines.kernels.compiled import called, lent
from vv.engines.kernels.triples import NOWHERE, add_scaled, at, dot, put
from vv.engines.rigid.solver.assembly import apply_nonzero
from vv.engines.rigid.solver.cone import limit
from vv.engines.rigid.solver.momentum import momentum_sweeps
from vv.engines.rigid.solver.problem import Problem, copy_rows, keep, restore
from vv.scene import Vector

CARRIED, WATCHED, SETTLED = 600, 200, 100  # sweeps at first, to measure drift, after a leap
AHEAD, LONGER, SHORTER = 4.0, 2.0, 0.25  # first leap over the drift; factors after good, bad ones
WORSE = 2.0  # largest ratio of the residual after a leap to the least one so far


@called
def leap_sweeps(problem: Problem, tolerance: float, fewest: int, most: int) -> tuple[int, float]:
    """Iterate impulses with leaps; arguments and results are those of `momentum_sweeps`."""
    p, v, w = problem.p, problem.v, problem.w
    few = smaller(CARRIED, most)
    sweeps, left = momentum_sweeps(problem, tolerance, fewest, few)
    before, here, here_v, here_w = rows(len(p)), rows(len(p)), rows(len(v)), rows(len(w))
    ahead, least = AHEAD, left
    for part in range(1, 2 + 2 * most // WATCHED):
        if left <= tolerance or sweeps >= most:
            break
        watching = part % 2 == 1
        if watching:
            copy_rows(before, p)
        few = smaller(WATCHED if watching else SETTLED, most - sweeps)
        more, now = momentum_sweeps(problem, tolerance, fewest, few)
        sweeps += more
        if watching and now > tolerance:
            keep(problem, here, here_v, here_w)
            leap(problem, before, ahead)
        elif now > WORSE * least:
            restore(problem, here, here_v, here_w)
            ahead, now = SHORTER * ahead, left
        elif not watching:
            ahead *= LONGER
        left = now
        least = smaller(least, now)
    return sweeps, left


@lent
def leap(problem: Problem, before: Vector, ahead: float) -> None:
    """Extrapolate impulses by `ahead` times their change since `before`, within friction limits."""
    p, joints, bodies, friction = problem.p, problem.joints, problem.bodies, problem.friction
    v, w = problem.v, problem.w
    for c in range(len(p)):
        if joints.across[c] <= 0.0:
            continue
        now, n = at(p, c), at(joints.normal, c)
        on = add_scaled(now, ahead, add_scaled(now, -1.0, at(before, c)))
        normal, after = dot(on, n), NOWHERE
        if normal > 0.0:
            centre, radius = limit(friction.mu * normal, at(friction.d, c), at(friction.turn, c))
            left = add_scaled(add_scaled(on, -normal, n), -1.0, centre)
            size = np.sqrt(dot(left, left))
            share = radius / size if size > radius else 1.0
            after = add_scaled(add_scaled(centre, share, left), normal, n)
        put(p, c, after)
        apply_nonzero(joints, c, bodies, v, w, add_scaled(after, -1.0, now))
