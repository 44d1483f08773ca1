"""Newton rounds of an augmented Lagrangian that go on where the residual grows.

Where blocks are wedged, sweeps may diverge from every solution, and the residual has minima that
are none. The residual of a round's impulses may then rise for some rounds before it meets what is
asked, so that rounds are not undone for it.
"""

from __future__ import annotations

from vv.engines.blocks.geometry import Index
from vv.engines.kernels.arrays import rows, same_rows, smaller
from vv.engines.kernels.compiled import called
from vv.engines.kernels.triples import add_scaled, at
from vv.engines.rigid.limits import FIRMEST, PAUSE, SEARCHED, SOFT, SOFTEST
from vv.engines.rigid.solver.assembly import apply_nonzero
from vv.engines.rigid.solver.cone import Problem, copy_rows, residual
from vv.engines.rigid.solver.newton import newton_round


@called
def newton_rounds(problem: Problem, tolerance: float, place: Index, most: int) -> float:
    """Iterate impulses by rounds and keep the best; return the residual [m/s].

    most: of Newton steps, after which no round begins; place: see `band_ordering`. A round whose
    iteration does not converge is repeated with softer contacts. Others make contacts stiffer, at
    once or, after failures, only after twice as many as after the failure before.
    """
    p, joints, bodies, friction = problem.p, problem.joints, problem.bodies, problem.friction
    v, w = problem.v, problem.w
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
        for c in range(len(p)):
            apply_nonzero(joints, c, bodies, v, w, add_scaled(at(p, c), -1.0, at(before, c)))
        left, waits = residual(p, joints, friction, v, w), waits - 1
        if waits <= 0:
            stiffness = smaller(10.0 * stiffness, FIRMEST)
        if left < least:
            least = left
            copy_rows(best, p)
            copy_rows(best_v, v)
            copy_rows(best_w, w)
    copy_rows(p, best)
    copy_rows(v, best_v)
    copy_rows(w, best_w)
    return least
