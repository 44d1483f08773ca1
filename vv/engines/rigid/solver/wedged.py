"""Refines the velocities of few blocks that are wedged, beyond the rounding of their impulses.

In a groove of half-angle s, impulses over mass are 1/s times the velocity that contacts take in a
step, and a normal velocity is s times that of the block out of the groove: a residual leaves an
error of 1/s times itself there. Impulses round velocities by more than the residual that this
requires. Newton steps do not: they solve for velocities, and their rounding across the groove is
divided by the stiffness of its contacts.
"""

from __future__ import annotations

import numpy as np

from vv.engines.blocks.geometry import Index
from vv.engines.kernels.arrays import larger, rows, same_rows, zero_rows
from vv.engines.kernels.compiled import called, lent
from vv.engines.kernels.triples import add_scaled, at, dot
from vv.engines.rigid.limits import BLURRED, GRAINS, INNER, REFINED, WEDGED
from vv.engines.rigid.solver.assembly import Joints, relative
from vv.engines.rigid.solver.cone import residual
from vv.engines.rigid.solver.newton import newton_solution
from vv.engines.rigid.solver.problem import Problem, copy_rows
from vv.scene import Vector


@lent
def largest_change(joints: Joints, v: Vector, w: Vector, from_v: Vector, from_w: Vector) -> float:
    """The largest change of a relative velocity [m/s] at any contact."""
    most = 0.0
    for c in range(len(joints.first)):
        u = add_scaled(relative(joints, c, v, w), -1.0, relative(joints, c, from_v, from_w))
        most = larger(most, np.sqrt(dot(u, u)))
    return most


@lent
def largest_push(p: Vector, joints: Joints) -> float:
    """The largest velocity [m/s] that one impulse alone gives its contact."""
    push = 0.0
    for c in range(len(p)):
        push = larger(push, joints.across[c] * np.sqrt(dot(at(p, c), at(p, c))))
    return push


@called
def refine_wedged(
    problem: Problem, free_v: Vector, free_w: Vector, left: float, place: Index
) -> float:
    """Improve v, w and p by Newton rounds where blocks are wedged; return the residual [m/s].

    free_v, free_w: (b, 3) without impulses; left: the residual at the start. Blocks are wedged
    where one impulse alone gives WEDGED times the velocity of all together, which is near 1/s.
    Contacts are so stiff from the first round on that the groove is, too, and ten times stiffer in
    each. Rounds end when velocities change by rounding only; one that does not converge, or
    increases the residual by more than rounding, is undone.
    """
    p, v, w, joints = problem.p, problem.v, problem.w, problem.joints
    push, rest = largest_push(p, joints), zero_rows(len(v))
    taken = largest_change(joints, v, w, free_v, free_w)
    wedged = push / taken if push > WEDGED * taken and taken > 0.0 else 0.0
    grain = GRAINS * largest_change(joints, free_v, free_w, rest, rest)
    stiffness, before = wedged * wedged, rows(len(p))
    for _ in range(REFINED if wedged > 0.0 else 0):
        copy_rows(before, p)
        x, y = same_rows(v, len(v)), same_rows(w, len(w))
        met = newton_solution(problem, before, 10.0 * grain, stiffness, place, x, y, INNER) > 0
        now = residual(p, joints, problem.friction, x, y)
        if not met or now > left + BLURRED * push:
            copy_rows(p, before)
            break
        moved = largest_change(joints, x, y, v, w)
        copy_rows(v, x)
        copy_rows(w, y)
        left, stiffness = now, 10.0 * stiffness
        if moved <= grain:
            break
    return left
