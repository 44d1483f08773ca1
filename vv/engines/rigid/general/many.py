"""Solves the contacts of many blocks, in a kernel apart: scenes of few blocks never compile it."""

from __future__ import annotations

from typing import Any

import numpy as np

from vv.engines.blocks.geometry import Index
from vv.engines.kernels.addressed import address_of, addressed
from vv.engines.kernels.arrays import clear, same_rows, smaller
from vv.engines.kernels.compiled import called, compiled_to_branch
from vv.engines.rigid.general.few import (
    Limits,
    polish,
    recomputed,
    solve_chained,
    velocities_without,
)
from vv.engines.rigid.limits import (
    CARRIED,
    CHAIN,
    ENOUGH,
    FAR,
    LEAPT,
    LONGEST,
    SOFT,
    STEADIED,
    STUCK,
    SWEPT,
    TRIED,
)
from vv.engines.rigid.solver.assembly import Bodies, Joints
from vv.engines.rigid.solver.banded import band_ordering
from vv.engines.rigid.solver.cone import solve_contacts
from vv.engines.rigid.solver.drift import leap_sweeps
from vv.engines.rigid.solver.momentum import momentum_sweeps
from vv.engines.rigid.solver.problem import Friction, Problem, copy_rows, keep, restore
from vv.engines.rigid.solver.rounds import newton_rounds, settled
from vv.scene import Vector


def examples() -> tuple[Any, ...]:
    """Arguments of the types that `solve_many` is called with."""
    one, rows, square = np.zeros(1), np.zeros((1, 3)), np.zeros((1, 3, 3))
    which = np.zeros(1, np.int64)
    joints = Joints(which, which, rows, rows, rows, rows, one, one)
    bodies, friction = Bodies(square, square, rows), Friction(0.0, one, rows, rows)
    return one, Limits(0, 0.0, 0, 0.0), Problem(joints, bodies, friction, rows, rows, rows), 0, 0.0


def address() -> int:
    """The address of `solve_many`, which is compiled if necessary."""
    return address_of(solve_many, examples)


@addressed(examples)
def solve_many_at(
    address: int, left: Vector, limits: Limits, problem: Problem, fewest: int, tolerance: float
) -> int:
    """`solve_many`, whose address is given."""
    return solve_many(left, limits, problem, fewest, tolerance)


@compiled_to_branch
def solve_many(
    left: Vector, limits: Limits, problem: Problem, fewest: int, tolerance: float
) -> int:
    """Solve as `solve_few`; return the number of sweeps, and the residual [m/s] in left (1,)."""
    sweeps, left[0] = solve_or_retry(limits, problem, fewest, tolerance)
    return sweeps


@called
def solve_or_retry(
    limits: Limits, problem: Problem, fewest: int, tolerance: float
) -> tuple[int, float]:
    """Solve as `solve_few`, blocks that form no chain by sweeps with leaps.

    If these do not reach the limit of the residual, the solution is started again without leaps,
    and then with leaps from zero impulses, as those of the step before may lead astray. If that
    fails, too, Newton rounds are tried, from the same impulses, from none and from the best so far,
    which is kept otherwise. The first step of blocks at rest, of which a finer residual is
    asked, is then solved until it bears the weights of all.
    """
    p, v, w = problem.p, problem.v, problem.w
    place, apart = band_ordering(problem.joints, problem.bodies, limits.blocks)
    if apart <= CHAIN:
        return solve_chained(limits, problem, fewest, tolerance, place)
    start, start_v, start_w = same_rows(p, len(p)), same_rows(v, len(v)), same_rows(w, len(w))
    sweeps, left = solve_with_leaps(limits, problem, fewest, tolerance, place)
    if left <= limits.tolerance:
        if tolerance < limits.tolerance:
            left = settled(problem, limits.finest, place)
        return sweeps, left
    best, best_v, best_w = same_rows(p, len(p)), same_rows(v, len(v)), same_rows(w, len(w))
    for way in range(2):
        restore(problem, start, start_v, start_w)
        if way == 0:
            more, other = solve_in_turns(limits, problem, fewest, tolerance, place)
        else:
            more, other = solve_anew(limits, problem, fewest, tolerance, place)
        sweeps += more
        if other <= limits.tolerance:
            return sweeps, other
        if other <= left:
            left = other
            keep(problem, best, best_v, best_w)
    for anew in range(3):
        free_v, free_w = velocities_without(problem)
        copy_rows(p, best if anew == 2 else start)
        if anew == 1:
            clear(p)
        recomputed(problem, free_v, free_w)
        last = newton_rounds(problem, limits.tolerance, place, LONGEST)
        if last <= limits.tolerance:
            return sweeps, last
    restore(problem, best, best_v, best_w)
    return sweeps, left


@called
def solve_with_leaps(
    limits: Limits, problem: Problem, fewest: int, tolerance: float, place: Index
) -> tuple[int, float]:
    """Solve by sweeps with leaps, as `solve_or_retry`.

    If they are stuck, the solution is started again, once, from zero impulses if the residual is
    far above that asked; otherwise Newton steps are taken, and after SWEPT sweeps Newton rounds,
    which leave what whole steps do not. Sweeps go on from there.
    """
    sweeps, left, anew, more = 0 * fewest, np.inf, False, 1
    free_v, free_w = velocities_without(problem)
    while sweeps < LEAPT and left > tolerance and more > 0:
        if sweeps >= ENOUGH and left <= limits.tolerance:
            break
        few = smaller(STUCK, LEAPT - sweeps)
        more, left = leap_sweeps(problem, tolerance, fewest, few)
        sweeps += more
        if left > tolerance:
            left = recomputed(problem, free_v, free_w)
        if left > FAR * limits.tolerance and not anew:
            clear(problem.p)
            left = recomputed(problem, free_v, free_w)
            anew = True
        elif left > limits.tolerance:
            if sweeps < SWEPT:
                left = polish(problem, tolerance, left, place, SOFT)
            else:
                left = newton_rounds(problem, tolerance, place, TRIED)
    return sweeps, left


@called
def solve_anew(
    limits: Limits, problem: Problem, fewest: int, tolerance: float, place: Index
) -> tuple[int, float]:
    """Solve by sweeps with leaps, as `solve_or_retry`, from zero impulses."""
    free_v, free_w = velocities_without(problem)
    clear(problem.p)
    recomputed(problem, free_v, free_w)
    return solve_with_leaps(limits, problem, fewest, tolerance, place)


@called
def solve_in_turns(
    limits: Limits, problem: Problem, fewest: int, tolerance: float, place: Index
) -> tuple[int, float]:
    """Solve as `solve_or_retry`, by sweeps with momentum and sweeps of conjugate gradients in turn.

    Where blocks are wedged, the former may diverge and the latter be slow, and each continues from
    where the other is stuck. If both are stuck, the solution is started again, once, from zero
    impulses if the residual is far above that asked; otherwise Newton steps are taken.
    """
    sweeps, left, carries, anew, more = 0 * fewest, np.inf, True, False, 1
    free_v, free_w = velocities_without(problem)
    while sweeps < limits.most and left > tolerance and more > 0:
        if sweeps >= ENOUGH and left <= limits.tolerance:
            break
        few = smaller(CARRIED if carries else STEADIED, limits.most - sweeps)
        if carries:
            more, left = momentum_sweeps(problem, tolerance, fewest, few)
        else:
            more, left = solve_contacts(problem, tolerance, fewest, few)
        sweeps, carries = sweeps + more, not carries
        if left > tolerance:
            left = recomputed(problem, free_v, free_w)
        stuck = sweeps >= STUCK and left > limits.tolerance
        if stuck and not anew and left > FAR * limits.tolerance:
            clear(problem.p)
            left = recomputed(problem, free_v, free_w)
            anew, carries = True, True
        elif stuck:
            left = polish(problem, tolerance, left, place, SOFT)
    return sweeps, left
