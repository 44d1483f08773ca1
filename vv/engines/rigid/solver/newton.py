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
from vv.engines.kernels.compiled import called, lent
from vv.engines.kernels.triples import Triple, add_scaled, at, cross, dot, put
from vv.engines.rigid.limits import INNER
from vv.engines.rigid.solver.assembly import Bodies, Joints, apply_nonzero, relative, times
from vv.engines.rigid.solver.banded import eliminate, equation_numbers, half_width
from vv.engines.rigid.solver.cone import Friction, Problem, copy_rows, limit
from vv.scene import Vector

ZERO = (0.0, 0.0, 0.0)


@lent
def projected_impulse(
    joints: Joints, c: int, friction: Friction, stiffness: float,
    q: Triple, u: Triple, slope: Vector,
) -> Triple:  # fmt: skip
    """The projected impulse P(q - D (u - need n)) of contact c; fills slope (3, 3) with -dP/du."""
    n, cap = at(joints.normal, c), friction.mu
    stiff = stiffness / joints.across[c]
    along = stiffness / joints.along[c] if joints.along[c] > 0.0 else 0.0
    clear(slope)
    un = dot(u, n)
    normal = dot(q, n) - stiff * (un - friction.need[c])
    if normal <= 0.0:
        return ZERO
    d, turn = at(friction.d, c), at(friction.turn, c)
    flat = add_scaled(add_scaled(q, -dot(q, n), n), -along, add_scaled(u, -un, n))
    centre, radius = limit(cap * normal, d, turn)
    left = add_scaled(flat, -1.0, centre)
    size = np.sqrt(dot(left, left))
    slips = size > radius
    share = radius / size if slips else 1.0
    e = add_scaled(ZERO, 1.0 / size, left) if slips else ZERO
    drift = ZERO  # derivative of the tangential impulse with respect to the normal one
    if slips:
        drift = add_scaled(add_scaled(ZERO, (1.0 - share) / normal, centre), radius / normal, e)
        drift = add_scaled(drift, share * dot(e, centre) / normal, e)
    for i in range(3):
        for j in range(3):
            flatly = (1.0 if i == j else 0.0) - n[i] * n[j] - e[i] * e[j]
            slope[i, j] = stiff * (n[i] + drift[i]) * n[j] + share * along * flatly
    return add_scaled(add_scaled(centre, share, left), normal, n)


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


@lent
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
    problem: Problem, q: Vector, tolerance: float, stiffness: float, place: Index
) -> bool:
    """Fill p with the impulses after a round from q (c, 3), whose effect is in v, w.

    Returns whether the iteration converged, see `newton_solution`.
    """
    x, y = same_rows(problem.v, len(problem.v)), same_rows(problem.w, len(problem.w))
    return newton_solution(problem, q, tolerance, stiffness, place, x, y)


@called
def newton_solution(
    problem: Problem, q: Vector, tolerance: float, stiffness: float, place: Index,
    x: Vector, y: Vector,
) -> bool:  # fmt: skip
    """Fill p with the impulses after a round, and x, y (b, 3) with the velocities and spins.

    x, y start from their first guess, and q (c, 3) from the impulses whose effect is in v, w.
    Returns whether the iteration converged: no velocity changed by more than a tenth of the
    tolerance [m/s] in the last step. place: see `band_ordering`. It is one function since assembly
    and solution share its arrays.
    """
    p, joints, bodies, friction = problem.p, problem.joints, problem.bodies, problem.friction
    v, w = problem.v, problem.w
    blocks = len(place)
    rows_of, m = equation_numbers(bodies, place)
    half, lever = half_width(joints, rows_of, blocks), longest_arms(joints, blocks)
    z, o = rows(len(v)), rows(len(w))
    slope, right, matrix = zero_squares(1)[0], numbers(m), table(m, 3 * half + 1)
    for _ in range(INNER):
        clear(matrix)
        copy_rows(z, v)
        copy_rows(o, w)
        for c in range(len(p)):
            if joints.across[c] > 0.0:
                u = relative(joints, c, x, y)
                put(p, c, projected_impulse(joints, c, friction, stiffness, at(q, c), u, slope))
                add_stiffness(matrix, joints, c, bodies, rows_of, half, slope, lever)
                apply_nonzero(joints, c, bodies, z, o, add_scaled(at(p, c), -1.0, at(q, c)))
        for i in range(blocks):
            for r in range(6):
                row = rows_of[6 * i + r]
                if row >= 0:
                    gap = z[i, r] - x[i, r] if r < 3 else lever[i] * (o[i, r - 3] - y[i, r - 3])
                    right[row] = gap
        for k in range(m):
            matrix[k, half] += 1.0
        eliminate(matrix, right, half)
        if not all_finite(right):
            return False  # contacts are so stiff that rounding made the equations singular
        if add_step(right, rows_of, lever, x, y) <= 0.1 * tolerance:
            return True
    return False


@lent
def add_step(right: Vector, rows_of: Index, lever: Vector, x: Vector, y: Vector) -> float:
    """Add a solution `right` (m,) to velocities and spins x, y (b, 3).

    rows_of, lever: see `equation_numbers` and `longest_arms`. Returns the largest change of a
    velocity [m/s].
    """
    most = 0.0
    for i in range(len(lever)):
        for r in range(6):
            row = rows_of[6 * i + r]
            if row >= 0 and r < 3:
                x[i, r] += right[row]
                most = larger(most, abs(right[row]))
            elif row >= 0:
                y[i, r - 3] += right[row] / lever[i]
    return most
