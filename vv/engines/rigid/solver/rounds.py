"""Newton rounds of an augmented Lagrangian, of which the best impulses are kept.

Where blocks are wedged, sweeps may diverge from every solution, and the residual has minima that
are none. The residual of a round's impulses may then rise for some rounds before it meets what is
asked, so that rounds are not undone for it.

In the first step of many blocks, residuals add up from course to course: where each contact leaves
a little, the top of a wall sinks by the sum, and the base lacks the force that would have stopped
it. Sweeps end far above that, so that rounds go on until the blocks bear what weighs on them.
"""

from __future__ import annotations

from vv.engines.blocks.geometry import Index
from vv.engines.kernels.arrays import rows, same_rows, smaller
from vv.engines.kernels.compiled import called
from vv.engines.rigid.limits import (
    FIRMEST,
    INNER,
    PAUSE,
    SEARCHED,
    SETTLES,
    SOFT,
    SOFTEST,
    STIFF,
    STIFFEST,
)
from vv.engines.rigid.solver.augmented import fill_impulses
from vv.engines.rigid.solver.cone import residual
from vv.engines.rigid.solver.newton import newton_round, newton_solution
from vv.engines.rigid.solver.problem import Problem, apply_changes, copy_rows, keep, restore


@called
def newton_rounds(problem: Problem, tolerance: float, place: Index, most: int) -> float:
    """Iterate impulses by rounds and keep the best; return the residual [m/s].

    most: of Newton steps, after which no round begins; place: see `band_ordering`. A round whose
    iteration does not converge is repeated with softer contacts. Others make contacts stiffer, at
    once or, after failures, only after twice as many as after the failure before.
    """
    p, joints, friction, v, w = problem.p, problem.joints, problem.friction, problem.v, problem.w
    best, best_v, best_w = same_rows(p, len(p)), same_rows(v, len(v)), same_rows(w, len(w))
    before, left, stiffness = rows(len(p)), residual(p, joints, friction, v, w), SOFT
    least, steps, waits, pause = left, 0 * most, 0 * most, PAUSE + 0 * most
    while left > tolerance and stiffness >= SOFTEST and steps < most:
        copy_rows(before, p)
        taken = newton_round(problem, before, tolerance, stiffness, place, SEARCHED)
        steps += abs(taken)
        if taken < 0:
            copy_rows(p, before)
            stiffness, waits, pause = 0.1 * stiffness, pause, 2 * pause
            continue
        apply_changes(problem, before, v, w)
        left, waits = residual(p, joints, friction, v, w), waits - 1
        if waits <= 0:
            stiffness = smaller(10.0 * stiffness, FIRMEST)
        if left < least:
            least = left
            keep(problem, best, best_v, best_w)
    restore(problem, best, best_v, best_w)
    return least


@called
def settled(problem: Problem, tolerance: float, place: Index) -> float:
    """Improve impulses until the residual is at most `tolerance` [m/s]; return the residual.

    place: see `band_ordering`. The best impulses are kept. A stiff contact makes a large impulse of
    a small velocity, so that the impulses of a round are those at its last velocities.
    """
    p, joints, friction, v, w = problem.p, problem.joints, problem.friction, problem.v, problem.w
    best, best_v, best_w = same_rows(p, len(p)), same_rows(v, len(v)), same_rows(w, len(w))
    before, least, stiffness = rows(len(p)), residual(p, joints, friction, v, w), STIFF
    for _ in range(SETTLES):
        if least <= tolerance:
            break
        copy_rows(before, p)
        x, y = same_rows(v, len(v)), same_rows(w, len(w))
        if newton_solution(problem, before, tolerance, stiffness, place, x, y, INNER) < 0:
            break
        fill_impulses(problem, before, stiffness, x, y)
        apply_changes(problem, before, v, w)
        now, stiffness = residual(p, joints, friction, v, w), smaller(10.0 * stiffness, STIFFEST)
        if now < least:
            least = now
            keep(problem, best, best_v, best_w)
    restore(problem, best, best_v, best_w)
    return least
