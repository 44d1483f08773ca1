"""Sweeps over the contacts of many blocks, and leaps along what these drift by.

Where sweeps seem to stand still they drift: impulses of a few blocks change by the same little in
each, for thousands of sweeps, until a contact opens, slips or sticks. A leap takes many such steps
at once; what it upsets elsewhere some sweeps put right. One after which more is left is undone.
"""

from __future__ import annotations

import numpy as np

from vv.engines.kernels.arrays import rows, smaller
from vv.engines.kernels.compiled import called, lent
from vv.engines.kernels.triples import NOWHERE, add_scaled, at, dot, put
from vv.engines.rigid.solver.assembly import Bodies, Joints, load_on
from vv.engines.rigid.solver.cone import Friction, keep, limit
from vv.engines.rigid.solver.momentum import carried
from vv.scene import Vector

CARRIED, WATCHED, SETTLED = 600, 200, 100  # sweeps at first, by which drift is told, after a leap
AHEAD, LONGER, SHORTER = 4.0, 2.0, 0.25  # of the drift watched: a leap, after one that went well
WORSE = 2.0  # times the least left so far: sweeps after a leap that goes well may have more left


@called
def drifted(
    p: Vector, joints: Joints, bodies: Bodies, friction: Friction, v: Vector, w: Vector,
    tolerance: float, fewest: int, most: int,
) -> tuple[int, float]:  # fmt: skip
    """Improve p (c, 3), whose effect is in v and w, until the residual [m/s] is met: `carried`."""
    few = smaller(CARRIED, most)
    sweeps, left = carried(p, joints, bodies, friction, v, w, tolerance, fewest, few)
    before, here, here_v, here_w = rows(len(p)), rows(len(p)), rows(len(v)), rows(len(w))
    ahead, least = AHEAD, left
    for part in range(1, 2 + 2 * most // WATCHED):
        if left <= tolerance or sweeps >= most:
            break
        watching = part % 2 == 1
        if watching:
            keep(before, p)
        few = smaller(WATCHED if watching else SETTLED, most - sweeps)
        more, now = carried(p, joints, bodies, friction, v, w, tolerance, fewest, few)
        sweeps += more
        if watching and now > tolerance:
            keep(here, p)
            keep(here_v, v)
            keep(here_w, w)
            leap(p, before, joints, bodies, friction, v, w, ahead)
        elif now > WORSE * least:
            keep(p, here)
            keep(v, here_v)
            keep(w, here_w)
            ahead, now = SHORTER * ahead, left
        elif not watching:
            ahead *= LONGER
        left = now
        least = smaller(least, now)
    return sweeps, left


@lent
def leap(
    p: Vector, before: Vector, joints: Joints, bodies: Bodies, friction: Friction,
    v: Vector, w: Vector, ahead: float,
) -> None:  # fmt: skip
    """Take p (c, 3) on by so many times what it changed by, as far as contacts allow."""
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
        load_on(joints, c, bodies, v, w, add_scaled(after, -1.0, now))
