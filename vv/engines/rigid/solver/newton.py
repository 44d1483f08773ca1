"""A round of an augmented Lagrangian for contacts with friction, solved by Newton steps.

For given impulses q, velocities z solve z = z(q) + W J^T (P(q - D (J z - need)) - q). P is the
projection on the impulses that contact and friction allow (see `cone.py`) and D is stiff; the
projected impulses are the new q. The number of rounds does not grow for loads shared by many
contacts, heavy blocks on light ones, or wedged contacts (Alart and Curnier 1991; Simo and Laursen
1992).
"""

from __future__ import annotations

import numpy as np

from vv.engines.blocks.geometry import Index
from vv.engines.kernels.arrays import (
    all_finite,
    clear,
    larger,
    numbers,
    rows,
    same_rows,
    table,
    zero_numbers,
    zero_squares,
)
from vv.engines.kernels.compiled import called, inlined, lent
from vv.engines.kernels.triples import Triple, add_scaled, at, cross, dot, put
from vv.engines.rigid.limits import INNER
from vv.engines.rigid.solver.assembly import Bodies, Joints, apply_nonzero, relative, times
from vv.engines.rigid.solver.augmented import add_step, fill_gaps, projected_impulse, shorten
from vv.engines.rigid.solver.banded import eliminate, equation_numbers, half_width
from vv.engines.rigid.solver.problem import Problem, copy_rows
from vv.scene import Vector

ZERO = (0.0, 0.0, 0.0)


@called
def longest_arms(joints: Joints, blocks: int) -> Vector:
    """The longest lever arm (n,) [m] of each block, which makes velocities of its spins.

    Pivots are chosen among velocities and spins, and must not depend on the unit of length.
    """
    lever = zero_numbers(blocks)
    for c in range(len(joints.first)):
        for side in range(2):
            i = joints.second[c] if side else joints.first[c]
            if i < blocks:
                arm = at(joints.arm_second if side else joints.arm_first, c)
                lever[i] = larger(lever[i], np.sqrt(dot(arm, arm)))
    for i in range(blocks):
        if lever[i] == 0.0:
            lever[i] = 1.0  # it has no contacts, or none with a lever arm
    return lever


@inlined
def velocity_per_unknown(joints: Joints, c: int, side: int, k: int, lever: float) -> Triple:
    """The change of the relative velocity at contact c per unit of unknown k of a body, 0 <= k < 6.

    side: 0 for the first body, 1 for the second. Unknowns 3 to 5 are spins times a lever [m].
    """
    axis = (1.0 * (k % 3 == 0), 1.0 * (k % 3 == 1), 1.0 * (k % 3 == 2))
    if k >= 3:
        arm = at(joints.arm_second if side else joints.arm_first, c)
        axis = add_scaled(ZERO, 1.0 / lever, cross(axis, arm))
    return axis if side else add_scaled(ZERO, -1.0, axis)


@lent
def add_stiffness(
    matrix: Vector, joints: Joints, c: int, bodies: Bodies, rows_of: Index, half: int,
    slope: Vector, lever: Vector,
) -> None:  # fmt: skip
    """Add W J^T slope J of contact c to a matrix for `eliminate`; rows_of: equation numbers."""
    blocks = len(rows_of) // 6
    for side in range(2):
        j = joints.second[c] if side else joints.first[c]
        for k in range(6 if j < blocks else 0):
            if rows_of[6 * j + k] < 0:
                continue
            u = velocity_per_unknown(joints, c, side, k, lever[j])
            p = (dot(at(slope, 0), u), dot(at(slope, 1), u), dot(at(slope, 2), u))
            for other in range(2):
                i = joints.second[c] if other else joints.first[c]
                if i < blocks:
                    pull = p if other else add_scaled(ZERO, -1.0, p)
                    arm = at(joints.arm_second if other else joints.arm_first, c)
                    v = times(bodies.inverse, i, pull)
                    w = times(bodies.inverse_spin, i, cross(arm, pull))
                    here = rows_of[6 * j + k] + half
                    for r in range(6):
                        row = rows_of[6 * i + r]
                        if row >= 0:
                            matrix[row, here - row] += v[r] if r < 3 else lever[i] * w[r - 3]


@called
def newton_round(
    problem: Problem, q: Vector, tolerance: float, stiffness: float, place: Index, most: int
) -> int:
    """Fill p with the impulses after a round from q (c, 3), whose effect is in v, w.

    most, and what is returned: see `newton_solution`.
    """
    x, y = same_rows(problem.v, len(problem.v)), same_rows(problem.w, len(problem.w))
    return newton_solution(problem, q, tolerance, stiffness, place, x, y, most)


@called
def newton_solution(
    problem: Problem, q: Vector, tolerance: float, stiffness: float, place: Index,
    x: Vector, y: Vector, most: int,
) -> int:  # fmt: skip
    """Fill p with the impulses after a round, and x, y (b, 3) with the velocities and spins.

    x, y start from their first guess, and q (c, 3) from the impulses whose effect is in v, w.
    Returns the number of iterations until no velocity changed by more than a tenth of the tolerance
    [m/s], or -most if that many were not enough. With more than INNER, steps that do not improve
    the equations are shortened. place: see `band_ordering`. It is one function since assembly and
    solution share its arrays.
    """
    p, joints, bodies, friction = problem.p, problem.joints, problem.bodies, problem.friction
    v, w = problem.v, problem.w
    blocks = len(place)
    rows_of, m = equation_numbers(bodies, place)
    half, lever = half_width(joints, rows_of, blocks), longest_arms(joints, blocks)
    z, o = rows(len(v)), rows(len(w))
    slope, right, matrix = zero_squares(1)[0], numbers(m), table(m, 3 * half + 1)
    for taken in range(most):
        clear(matrix)
        copy_rows(z, v)
        copy_rows(o, w)
        for c in range(len(p)):
            if joints.across[c] > 0.0:
                u = relative(joints, c, x, y)
                put(p, c, projected_impulse(joints, c, friction, stiffness, at(q, c), u, slope))
                if dot(at(p, c), at(p, c)) > 0.0:  # otherwise it is open
                    add_stiffness(matrix, joints, c, bodies, rows_of, half, slope, lever)
                apply_nonzero(joints, c, bodies, z, o, add_scaled(at(p, c), -1.0, at(q, c)))
        squares = fill_gaps(right, rows_of, lever, z, o, x, y)
        for row in range(m):
            matrix[row, half] += 1.0
        eliminate(matrix, right, half)
        if not all_finite(right):
            return -most  # contacts are so stiff that rounding made the equations singular
        if add_step(right, 1.0, rows_of, lever, x, y) <= 0.1 * tolerance:
            return taken + 1
        if most > INNER:
            shorten(problem, q, stiffness, rows_of, lever, right, squares, x, y)
    return -most
