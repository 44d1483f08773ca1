"""Newton rounds that solve the first step of many blocks until it bears what weighs on it.

Residuals add up from course to course: where each contact leaves a little, the top of a wall sinks
by the sum, and the base lacks the force that would have stopped it. Sweeps end far above that.
"""

from __future__ import annotations

from vv.engines.blocks.geometry import Index
from vv.engines.kernels.arrays import rows, same_rows, smaller, zero_squares
from vv.engines.kernels.compiled import called
from vv.engines.kernels.triples import add_scaled, at, put
from vv.engines.rigid.limits import INNER, SETTLES, STIFF, STIFFEST
from vv.engines.rigid.solver.assembly import apply_nonzero, relative
from vv.engines.rigid.solver.cone import Problem, copy_rows, residual
from vv.engines.rigid.solver.newton import newton_solution
from vv.engines.rigid.solver.projection import projected_impulse
from vv.scene import Vector


@called
def settled(problem: Problem, tolerance: float, place: Index) -> float:
    """Improve impulses until the residual is at most `tolerance` [m/s]; return the residual.

    place: see `band_ordering`. The best impulses are kept. A stiff contact makes a large impulse of
    a small velocity, so that the impulses of a round are those at its last velocities.
    """
    p, joints, bodies, friction = problem.p, problem.joints, problem.bodies, problem.friction
    v, w = problem.v, problem.w
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
        for c in range(len(p)):
            apply_nonzero(joints, c, bodies, v, w, add_scaled(at(p, c), -1.0, at(before, c)))
        now, stiffness = residual(p, joints, friction, v, w), smaller(10.0 * stiffness, STIFFEST)
        if now < least:
            least = now
            copy_rows(best, p)
            copy_rows(best_v, v)
            copy_rows(best_w, w)
    copy_rows(p, best)
    copy_rows(v, best_v)
    copy_rows(w, best_w)
    return least


@called
def fill_impulses(problem: Problem, q: Vector, stiffness: float, x: Vector, y: Vector) -> None:
    """Fill p with the projected impulses from q (c, 3) at velocities and spins x, y (b, 3)."""
    p, joints, slope = problem.p, problem.joints, zero_squares(1)[0]
    for c in range(len(p)):
        if joints.across[c] > 0.0:
            u = relative(joints, c, x, y)
            put(p, c, projected_impulse(joints, c, problem.friction, stiffness, at(q, c), u, slope))
