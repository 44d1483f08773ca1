"""Newton rounds of an augmented Lagrangian that go on where the residual grows.

Where blocks are wedged, sweeps may diverge from every solution, and the residual has minima that
are none. The residual of a round's impulses may then rise for some rounds before it meets what is
asked, so that rounds are not undone for it.
"""

from __future__ import annotations

from vv.engines.blocks.geometry import Index
from vv.engines.kernels.arrays import rows, smaller
from vv.engines.kernels.compiled import called
from vv.engines.kernels.triples import add_scaled, at
from vv.engines.rigid.limits import FIRMEST, ROUNDS, SOFT, SOFTEST
from vv.engines.rigid.solver.assembly import apply_nonzero
from vv.engines.rigid.solver.cone import Problem, copy_rows, residual
from vv.engines.rigid.solver.newton import newton_round


@called
def newton_rounds(problem: Problem, tolerance: float, place: Index) -> float:
    """Iterate impulses by rounds; return the residual [m/s].

    place: see `band_ordering`. A round whose iteration does not converge is repeated with softer
    contacts; others make contacts stiffer.
    """
    p, joints, bodies, friction = problem.p, problem.joints, problem.bodies, problem.friction
    v, w = problem.v, problem.w
    before, left, stiffness = rows(len(p)), residual(p, joints, friction, v, w), SOFT
    for _ in range(ROUNDS):
        if left <= tolerance or stiffness < SOFTEST:
            break
        copy_rows(before, p)
        if newton_round(problem, before, tolerance, stiffness, place):
            for c in range(len(p)):
                apply_nonzero(joints, c, bodies, v, w, add_scaled(at(p, c), -1.0, at(before, c)))
            left, stiffness = (
                residual(p, joints, friction, v, w),
                smaller(10.0 * stiffness, FIRMEST),
            )
        else:
            copy_rows(p, before)
            stiffness *= 0.1
    return left
