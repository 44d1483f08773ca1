"""Kernels that let contact impulses act on the mean lever arms of a step.

The contact conditions hold with the arms at the end of the step. If impulses acted on these too,
rotation would be of first order.
"""

from __future__ import annotations

import numpy as np

from vv.engines.blocks.geometry import Index
from vv.engines.kernels.arrays import larger, rows, zero_rows
from vv.engines.kernels.compiled import called, inlined, lent
from vv.engines.kernels.triples import Triple, add_scaled, at, cross, dot, put
from vv.engines.rigid.solver.assembly import Joints, apply_nonzero
from vv.engines.rigid.solver.problem import Problem
from vv.scene import Vector

ZERO = (0.0, 0.0, 0.0)


@called
def halfway(joints: Joints, before: Index, began: Joints) -> tuple[Joints, Vector]:
    """The joints at mid-step, and the rotation (c, 3) [rad] of their normals from there to the end.

    joints: at the end of the step; before: (c,) their rows in `began`, the joints at its start, or
    -1 for new contacts, whose arms and normals are taken as constant.
    """
    count = len(before)
    normal, one, two = rows(count), rows(count), rows(count)
    turn = zero_rows(count)
    for c in range(count):
        n, a, b = at(joints.normal, c), at(joints.arm_first, c), at(joints.arm_second, c)
        row = before[c]
        if row >= 0:
            put(turn, c, add_scaled(ZERO, 0.5, cross(at(began.normal, row), n)))
            a = add_scaled(add_scaled(ZERO, 0.5, a), 0.5, at(began.arm_first, row))
            b = add_scaled(add_scaled(ZERO, 0.5, b), 0.5, at(began.arm_second, row))
        put(normal, c, turned_back(turn, c, n))
        put(one, c, a)
        put(two, c, b)
    middle = Joints(
        joints.first, joints.second, normal, one, two, joints.pull, joints.across, joints.along
    )
    return middle, turn


@inlined
def turned_back(turn: Vector, c: int, p: Triple) -> Triple:
    """An impulse p of contact c at the end of a step, rotated back to its direction at mid-step."""
    return add_scaled(p, -1.0, cross(at(turn, c), p))


@lent
def act_at_midstep(problem: Problem, acted: Vector, middle: Joints, turn: Vector) -> float:
    """Update v, w so that the impulses p (c, 3) act at mid-step, and set `acted` to p.

    Before, `acted` acts at mid-step and p - acted at the end of the step. Returns the largest
    change of a body's velocity at a contact [m/s].
    """
    p, joints, bodies, v, w = problem.p, problem.joints, problem.bodies, problem.v, problem.w
    worst = 0.0
    for c in range(len(p)):
        change = add_scaled(at(p, c), -1.0, at(acted, c))
        if dot(change, change) > 0.0:
            a, b = joints.first[c], joints.second[c]
            before = (at(v, a), at(w, a), at(v, b), at(w, b))
            apply_nonzero(middle, c, bodies, v, w, turned_back(turn, c, change))
            apply_nonzero(joints, c, bodies, v, w, add_scaled(ZERO, -1.0, change))
            one, two = at(joints.arm_first, c), at(joints.arm_second, c)
            worst = larger(worst, difference(before[0], at(v, a), before[1], at(w, a), one))
            worst = larger(worst, difference(before[2], at(v, b), before[3], at(w, b), two))
            put(acted, c, at(p, c))
    return worst


@inlined
def difference(v0: Triple, v1: Triple, w0: Triple, w1: Triple, arm: Triple) -> float:
    """The difference of two motions of a body, as a velocity at the end of an arm [m/s]."""
    u = add_scaled(add_scaled(v1, -1.0, v0), 1.0, cross(add_scaled(w1, -1.0, w0), arm))
    return float(np.sqrt(dot(u, u)))
