"""Sweeps over the contacts of many blocks, carried on by momentum that grows while it helps.

After each sweep, impulses and velocities go on along what that sweep and the one before differ by
(Nesterov 1983), times a share that rises to a cap below 1. Friction makes the sweeps' map
unsymmetric, so that no cap suits all: near 1 most scenes converge several times as fast, and a few
drift away. So the cap is raised while changes shrink slowly, and lowered where they grow.
"""

from __future__ import annotations

import numpy as np

from vv.engines.kernels.arrays import larger, rows, same_rows, smaller
from vv.engines.kernels.compiled import called, lent
from vv.engines.kernels.triples import add_scaled, at, put
from vv.engines.rigid.solver.assembly import Bodies, Joints
from vv.engines.rigid.solver.cone import Friction, changed, keep, residual, sweep
from vv.scene import Vector

CAP, LEAST, MOST = 0.85, 0.5, 0.98  # of the share: at first, and its bounds
WINDOW = 12  # sweeps whose changes are summed before the cap is judged
GREW, SLOWLY = 4.0, 0.85  # of the least sum so far, and of the last: it drifts away, it creeps
LOWERED, RAISED = 1.6, 0.75  # what the cap's distance to 1 is multiplied by


@called
def carried(
    p: Vector, joints: Joints, bodies: Bodies, friction: Friction, v: Vector, w: Vector,
    tolerance: float, fewest: int, most: int,
) -> tuple[int, float]:  # fmt: skip
    """Improve p (c, 3), whose effect is in v and w, until the residual [m/s] is met.

    At least `fewest` sweeps are made, unless there is nothing left to improve. Returns the sweeps
    made and the residual reached, which is larger if `most` sweeps were not enough.
    """
    b = len(v)
    before, last = rows(len(p)), same_rows(p, len(p))
    last_v, last_w = same_rows(v, b), same_rows(w, b)
    sweeps, left = 0 * most, residual(p, joints, friction, v, w)
    cap, pace, total, least, former = CAP, 1.0, 0.0, np.inf, np.inf
    while (left > tolerance or (sweeps < fewest and left > 0.0)) and sweeps < most:
        keep(before, p)
        sweep(p, joints, bodies, friction, v, w)
        sweeps += 1
        size, largest = changed(p, before, joints)
        if (largest <= 2.0 * tolerance and sweeps >= fewest) or sweeps == most:
            left = residual(p, joints, friction, v, w)
            if left <= tolerance or sweeps == most:
                break
        total += size
        faster = 0.5 * (1.0 + np.sqrt(1.0 + 4.0 * pace * pace))
        share = smaller(cap, (pace - 1.0) / faster)
        pace = faster
        if sweeps % WINDOW == 0:
            if total > GREW * least:
                cap = larger(LEAST, 1.0 - LOWERED * (1.0 - cap))
                pace, share, least = 1.0, 0.0, np.inf
            else:
                if total > SLOWLY * former:
                    cap = smaller(MOST, 1.0 - RAISED * (1.0 - cap))
                least = smaller(least, total)
            former, total = total, 0.0
        carry(p, last, share)
        carry(v, last_v, share)
        carry(w, last_w, share)
    return sweeps, left


@lent
def carry(now: Vector, last: Vector, share: float) -> None:
    """Take rows (k, 3) on by a share of what they differ by from the last, which they replace."""
    for k in range(len(now)):
        here = at(now, k)
        put(now, k, add_scaled(here, share, add_scaled(here, -1.0, at(last, k))))
        put(last, k, here)
