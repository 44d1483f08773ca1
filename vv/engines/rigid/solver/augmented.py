"""Kernels for the equations of an augmented Lagrangian: impulses that friction allows, and steps.

Where many contacts slip or open at once, whole Newton steps go back and forth between states that
all are wrong. The sum of squares of the equations decides how long a step is (Alart and Curnier
1991).
"""

from __future__ import annotations

import numpy as np

from vv.engines.blocks.geometry import Index
from vv.engines.kernels.arrays import clear, larger, numbers, rows, zero_squares
from vv.engines.kernels.compiled import called, lent
from vv.engines.kernels.triples import Triple, add_scaled, at, dot, put
from vv.engines.rigid.limits import HALVINGS
from vv.engines.rigid.solver.assembly import Joints, relative
from vv.engines.rigid.solver.cone import limit
from vv.engines.rigid.solver.problem import Friction, Problem, apply_changes, copy_rows
from vv.scene import Vector

ZERO = (0.0, 0.0, 0.0)
IMPROVES = 1e-4  # least decrease of the sum of squares, of it and the part of the step


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
def fill_impulses(problem: Problem, q: Vector, stiffness: float, x: Vector, y: Vector) -> None:
    """Fill p with the projected impulses from q (c, 3) at velocities and spins x, y (b, 3)."""
    p, joints, slope = problem.p, problem.joints, zero_squares(1)[0]
    for c in range(len(p)):
        if joints.across[c] > 0.0:
            u = relative(joints, c, x, y)
            put(p, c, projected_impulse(joints, c, problem.friction, stiffness, at(q, c), u, slope))


@lent
def add_step(
    step: Vector, part: float, rows_of: Index, lever: Vector, x: Vector, y: Vector
) -> float:
    """Add a part of a step (m,) to velocities and spins x, y (b, 3).

    rows_of, lever: see `equation_numbers` and `longest_arms`. Returns the largest change of a
    velocity [m/s].
    """
    most = 0.0
    for i in range(len(lever)):
        for r in range(6):
            row = rows_of[6 * i + r]
            if row >= 0 and r < 3:
                x[i, r] += part * step[row]
                most = larger(most, abs(part * step[row]))
            elif row >= 0:
                y[i, r - 3] += part * step[row] / lever[i]
    return most


@lent
def fill_gaps(
    gap: Vector, rows_of: Index, lever: Vector, z: Vector, o: Vector, x: Vector, y: Vector
) -> float:
    """Fill gap (m,) [m/s] with z - x and o - y (b, 3); return the sum of its squares.

    rows_of, lever: see `equation_numbers` and `longest_arms`.
    """
    total = 0.0
    for i in range(len(lever)):
        for r in range(6):
            row = rows_of[6 * i + r]
            if row >= 0:
                gap[row] = z[i, r] - x[i, r] if r < 3 else lever[i] * (o[i, r - 3] - y[i, r - 3])
                total += gap[row] * gap[row]
    return total


@called
def shorten(
    problem: Problem, q: Vector, stiffness: float, rows_of: Index, lever: Vector,
    step: Vector, squares: float, x: Vector, y: Vector,
) -> None:  # fmt: skip
    """Halve a step (m,), which x, y (b, 3) contain, until the equations are better than before it.

    squares: the sum of their squares before it. q, stiffness: see `newton_solution`. Fills p.
    """
    v, w = problem.v, problem.w
    z, o, gap, part = rows(len(v)), rows(len(w)), numbers(len(step)), 1.0
    for _ in range(HALVINGS):
        copy_rows(z, v)
        copy_rows(o, w)
        fill_impulses(problem, q, stiffness, x, y)
        apply_changes(problem, q, z, o)
        if fill_gaps(gap, rows_of, lever, z, o, x, y) < (1.0 - IMPROVES * part) * squares:
            break
        part *= 0.5
        add_step(step, -part, rows_of, lever, x, y)
