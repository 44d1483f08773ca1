"""Sweeps over the contacts of many blocks, accelerated by momentum.

After each sweep, impulses and velocities are extrapolated by a share of their change since the
sweep before (Nesterov 1983); the share rises to a cap below 1. Friction makes the map of a sweep
unsymmetric, so that no cap suits all scenes: near 1 most converge several times as fast, and a few
diverge. So the cap is raised while changes decrease slowly, and lowered when they grow.
"""

from __future__ import annotations

import numpy as np

from vv.engines.kernels.arrays import larger, smaller, table
from vv.engines.kernels.compiled import called, lent
from vv.engines.rigid.solver.batches import packed, pairs_room, unpacked
from vv.engines.rigid.solver.cone import residual
from vv.engines.rigid.solver.lanes import sweep_batches
from vv.engines.rigid.solver.problem import Problem
from vv.scene import Vector

CAP, LEAST, MOST = 0.93, 0.5, 0.98  # the cap at first, and its bounds
LOOKS = 4  # least number of sweeps between residuals, each of which costs as much as two sweeps
WINDOW = 8  # sweeps whose changes are summed before the cap is adapted
GREW, SLOWLY = 4.0, 0.85  # growth over the least sum: diverges; decrease since the last: is slow
LOWERED, RAISED = 1.6, 0.75  # factors on 1 - cap in these two cases


@called
def momentum_sweeps(
    problem: Problem, tolerance: float, fewest: int, most: int
) -> tuple[int, float]:
    """Iterate impulses until the residual is at most `tolerance` [m/s].

    At least `fewest` sweeps are made, unless the residual is zero. Returns the number of sweeps and
    the residual, which exceeds the tolerance if `most` sweeps were not enough. It is one function
    since the weight of momentum depends on all sweeps before.
    """
    p, joints, bodies, friction = problem.p, problem.joints, problem.bodies, problem.friction
    v, w = problem.v, problem.w
    batches, layers, place = packed(p, joints, bodies, friction)
    pairs = pairs_room(1)
    now, last = joined(v, w), joined(v, w)
    sweeps, left = 0 * most, residual(p, joints, friction, v, w)
    cap, pace, total, least, former, looked = CAP, 1.0, 0.0, np.inf, np.inf, -LOOKS
    while (left > tolerance or (sweeps < fewest and left > 0.0)) and sweeps < most:
        size, largest = sweep_batches(pairs[0], batches, layers, now)
        sweeps += 1
        close = largest <= 2.0 * tolerance and sweeps >= fewest and sweeps >= looked + LOOKS
        if close or sweeps == most:
            looked = sweeps
            unpacked(p, layers, place)
            separated(now, v, w)
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
        extrapolate(now, last, share)
        for k in range(len(layers)):
            extrapolate(layers[k].p, layers[k].last, share)
    return sweeps, left


@called
def joined(v: Vector, w: Vector) -> Vector:
    """An array (b, 6) of the velocities and spins."""
    made = table(len(v), 6)
    for i in range(len(v)):
        for k in range(3):
            made[i, k], made[i, 3 + k] = v[i, k], w[i, k]
    return made


@lent
def separated(velocities: Vector, v: Vector, w: Vector) -> None:
    """Fill v, w (b, 3) from an array of both (b, 6)."""
    for i in range(len(v)):
        for k in range(3):
            v[i, k], w[i, k] = velocities[i, k], velocities[i, 3 + k]


@lent
def extrapolate(now: Vector, last: Vector, share: float) -> None:
    """Extrapolate `now` (k, m) by a share of its change since `last`, which becomes the old now."""
    for k in range(now.shape[0]):
        for m in range(now.shape[1]):
            here = now[k, m]
            now[k, m] = here + share * (here - last[k, m])
            last[k, m] = here
