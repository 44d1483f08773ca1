"""Kernels for Newton steps, which are shortened where they do not improve their equations.

Where many contacts slip or open at once, whole steps go back and forth between states that all are
wrong. The sum of squares of the equations decides how long a step is (Alart and Curnier 1991).
"""

from __future__ import annotations

from vv.engines.blocks.geometry import Index
from vv.engines.kernels.arrays import larger, numbers, rows
from vv.engines.kernels.compiled import called, lent
from vv.engines.rigid.limits import HALVINGS
from vv.engines.rigid.solver.problem import Problem, apply_changes, copy_rows
from vv.engines.rigid.solver.projection import fill_impulses
from vv.scene import Vector

IMPROVES = 1e-4  # least decrease of the sum of squares, of it and the part of the step


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
