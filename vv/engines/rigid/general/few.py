"""Solves the contacts of few blocks, and of chains, by sweeps and Newton steps in turn."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vv.engines.blocks.geometry import Index
from vv.engines.kernels.arrays import in_order, larger, rows, same_rows, smaller
from vv.engines.kernels.bundles import bundle
from vv.engines.kernels.compiled import called, lent
from vv.engines.kernels.triples import add_scaled, at, dot
from vv.engines.rigid.limits import (
    ADDED,
    BLURRED,
    ENOUGH,
    INNER,
    OUTER,
    POLISHED,
    SHINED,
    SMALL,
    STALLED,
    STIFF,
)
from vv.engines.rigid.solver.assembly import apply_nonzero
from vv.engines.rigid.solver.cone import residual, solve_contacts
from vv.engines.rigid.solver.newton import newton_round
from vv.engines.rigid.solver.problem import Problem, apply_changes, copy_rows, keep, restore
from vv.engines.rigid.solver.wedged import refine_wedged
from vv.scene import Vector

ZERO = (0.0, 0.0, 0.0)


@bundle
class Limits(NamedTuple):
    """What a solver of contacts is to reach, and how long it may take.

    The number of blocks; the largest residual asked [m/s]; the largest number of sweeps; and the
    residual [m/s] asked of the first step of many blocks, with which it bears their weights.
    """

    blocks: int
    tolerance: float
    most: int
    finest: float


@called
def solve_few(limits: Limits, problem: Problem, fewest: int, tolerance: float) -> tuple[int, float]:
    """Iterate impulses until the residual is at most `tolerance` [m/s]; refine wedged blocks.

    Returns the number of sweeps and the residual.
    """
    place = in_order(limits.blocks)
    sweeps, left = solve_chained(limits, problem, fewest, tolerance, place)
    free_v, free_w = velocities_without(problem)
    return sweeps, refine_wedged(problem, free_v, free_w, left, place)


@called
def solve_chained(
    limits: Limits, problem: Problem, fewest: int, tolerance: float, place: Index
) -> tuple[int, float]:
    """Solve as `solve_few`, for few blocks or a chain, by sweeps and Newton steps in turn.

    Newton steps are cheap there. Residuals add up along a chain, so that less than the tolerance is
    asked of each contact, and Newton steps continue beyond that.
    """
    small, sweeps, left = limits.blocks <= SMALL, 0 * fewest, np.inf
    finer = (SHINED if small else POLISHED) * tolerance
    free_v, free_w = velocities_without(problem)
    asked = tolerance if small else tolerance / smaller(limits.blocks, ADDED)
    while sweeps < limits.most and left > asked:
        if not small and sweeps >= ENOUGH and left <= limits.tolerance:
            break
        few = smaller(STALLED, limits.most - sweeps)
        more, left = solve_contacts(problem, asked, fewest, few)
        sweeps += more
        if left > asked:
            left = recomputed(problem, free_v, free_w)
        if left > asked:
            left = polish(problem, finer, left, place, STIFF)
        if more == 0:
            break
    return sweeps, left


@called
def velocities_without(problem: Problem) -> tuple[Vector, Vector]:
    """The velocities and spins (b, 3) without the present impulses, whose effect is in v, w."""
    p, v, w, joints, bodies = problem.p, problem.v, problem.w, problem.joints, problem.bodies
    free_v, free_w = same_rows(v, len(v)), same_rows(w, len(w))
    for c in range(len(p)):
        apply_nonzero(joints, c, bodies, free_v, free_w, add_scaled(ZERO, -1.0, at(p, c)))
    return free_v, free_w


@lent
def recomputed(problem: Problem, free_v: Vector, free_w: Vector) -> float:
    """Recompute v, w from the velocities without contact and the impulses p; return the residual.

    Each sweep adds its rounding to the velocities. In a narrow groove, where impulses over mass
    are 1e6 times the resulting velocity, the rounding would exceed the residual asked.
    """
    p, joints, bodies, friction = problem.p, problem.joints, problem.bodies, problem.friction
    v, w = problem.v, problem.w
    copy_rows(v, free_v)
    copy_rows(w, free_w)
    for c in range(len(p)):
        apply_nonzero(joints, c, bodies, v, w, at(p, c))
    return residual(p, joints, friction, v, w)


@called
def polish(
    problem: Problem, tolerance: float, left: float, place: Index, stiffness: float
) -> float:
    """Improve impulses by Newton rounds; return the residual [m/s].

    left: the residual at the start; place: see `band_ordering`; stiffness: of the first round. A
    round that increases the residual by more than rounding is undone, and the next one is less
    stiff. In a narrow groove the first rounds change less than rounding, and stiffer ones solve it.
    """
    p, joints, friction, v, w = problem.p, problem.joints, problem.friction, problem.v, problem.w
    before, before_v, before_w = rows(len(p)), rows(len(v)), rows(len(w))
    rounding = 0.0
    for c in range(len(p)):
        push = np.sqrt(dot(at(p, c), at(p, c)))
        rounding = larger(rounding, BLURRED * joints.across[c] * push)
    for _ in range(OUTER):
        if left <= tolerance or stiffness < 1.0:
            break
        keep(problem, before, before_v, before_w)
        met = newton_round(problem, before, tolerance, stiffness, place, INNER) > 0
        apply_changes(problem, before, v, w)
        now = residual(p, joints, friction, v, w)
        if met and now < left + rounding:
            left, stiffness = now, 10.0 * stiffness
        else:
            restore(problem, before, before_v, before_w)
            stiffness *= 0.01
    return left
