"""Solves the contacts of a step by sweeps and, in small scenes and chains, by Newton steps."""

from __future__ import annotations

import numpy as np

from vv.engines.blocks.geometry import Index
from vv.engines.kernels.arrays import clear, in_order, larger, rows, same_rows, smaller
from vv.engines.kernels.compiled import called, lent
from vv.engines.kernels.triples import add_scaled, at, dot
from vv.engines.rigid.general.setting import Setting
from vv.engines.rigid.limits import (
    BLURRED,
    CARRIED,
    CHAIN,
    ENOUGH,
    FAR,
    LEAPT,
    OUTER,
    POLISHED,
    SHINED,
    SMALL,
    SOFT,
    STALLED,
    STEADIED,
    STIFF,
    STUCK,
)
from vv.engines.rigid.solver.assembly import Bodies, Joints, apply_nonzero
from vv.engines.rigid.solver.banded import band_ordering
from vv.engines.rigid.solver.cone import Friction, copy_rows, residual, solve_contacts
from vv.engines.rigid.solver.drift import leap_sweeps
from vv.engines.rigid.solver.momentum import momentum_sweeps
from vv.engines.rigid.solver.newton import newton_round
from vv.engines.rigid.solver.rounds import newton_rounds
from vv.scene import Vector

ZERO = (0.0, 0.0, 0.0)


@called
def converged(
    setting: Setting, joints: Joints, bodies: Bodies, friction: Friction,
    p: Vector, v: Vector, w: Vector, fewest: int, tolerance: float,
) -> tuple[int, float]:  # fmt: skip
    """Iterate impulses p (c, 3) [N s] until the residual is at most `tolerance` [m/s].

    v, w: (b, 3) velocities that include the effect of p. Many blocks that form no chain are solved
    by sweeps with leaps. If these do not reach the setting's tolerance, the solution is started
    again without leaps. If that fails, too, Newton rounds are tried, from the same impulses, from
    none and from the best so far, which is kept otherwise. Returns the number of sweeps and the
    residual.
    """
    blocks = len(setting.mass)
    if blocks <= SMALL:
        return solve_in_turns(setting, joints, bodies, friction, p, v, w, fewest, tolerance)
    place, apart = band_ordering(joints, bodies, blocks)
    if apart <= CHAIN:
        return solve_in_turns(setting, joints, bodies, friction, p, v, w, fewest, tolerance)
    start, start_v, start_w = same_rows(p, len(p)), same_rows(v, len(v)), same_rows(w, len(w))
    sweeps, left = solve_with_leaps(
        setting, joints, bodies, friction, p, v, w, fewest, tolerance, place
    )
    if left <= setting.tolerance:
        return sweeps, left
    best, best_v, best_w = same_rows(p, len(p)), same_rows(v, len(v)), same_rows(w, len(w))
    copy_rows(p, start)
    copy_rows(v, start_v)
    copy_rows(w, start_w)
    more, other = solve_in_turns(setting, joints, bodies, friction, p, v, w, fewest, tolerance)
    if other <= left:
        left = other
        copy_rows(best, p)
        copy_rows(best_v, v)
        copy_rows(best_w, w)
    for anew in range(3 if left > setting.tolerance else 0):
        free_v, free_w = velocities_without(p, joints, bodies, v, w)
        copy_rows(p, best if anew == 2 else start)
        if anew == 1:
            clear(p)
        recomputed(p, joints, bodies, friction, v, w, free_v, free_w)
        last = newton_rounds(p, joints, bodies, friction, v, w, setting.tolerance, place)
        if last <= setting.tolerance:
            return sweeps + more, last
    copy_rows(p, best)
    copy_rows(v, best_v)
    copy_rows(w, best_w)
    return sweeps + more, left


@called
def solve_with_leaps(
    setting: Setting, joints: Joints, bodies: Bodies, friction: Friction,
    p: Vector, v: Vector, w: Vector, fewest: int, tolerance: float, place: Index,
) -> tuple[int, float]:  # fmt: skip
    """Solve by sweeps with leaps, as `converged`.

    If they are stuck, the solution is started again, once, from zero impulses if the residual is
    far above that asked; otherwise Newton steps are taken.
    """
    sweeps, left, anew, more = 0 * fewest, np.inf, False, 1
    free_v, free_w = velocities_without(p, joints, bodies, v, w)
    while sweeps < LEAPT and left > tolerance and more > 0:
        if sweeps >= ENOUGH and left <= setting.tolerance:
            break
        few = smaller(STUCK, LEAPT - sweeps)
        more, left = leap_sweeps(p, joints, bodies, friction, v, w, tolerance, fewest, few)
        sweeps += more
        if left > tolerance:
            left = recomputed(p, joints, bodies, friction, v, w, free_v, free_w)
        if left > FAR * setting.tolerance and not anew:
            clear(p)
            left = recomputed(p, joints, bodies, friction, v, w, free_v, free_w)
            anew = True
        elif left > setting.tolerance:
            left = polish(p, joints, bodies, friction, v, w, tolerance, left, place, SOFT)
    return sweeps, left


@called
def solve_in_turns(
    setting: Setting, joints: Joints, bodies: Bodies, friction: Friction,
    p: Vector, v: Vector, w: Vector, fewest: int, tolerance: float,
) -> tuple[int, float]:  # fmt: skip
    """Solve as `converged`, by sweeps of two kinds in turn, and Newton steps where these are cheap.

    Newton steps are cheap in small scenes and in chains of blocks. There they continue beyond the
    residual asked, since residuals add up along a chain. Elsewhere, sweeps with momentum alternate
    with sweeps of conjugate gradients: where blocks are wedged, the former may diverge and the
    latter be slow, and each continues from where the other is stuck. If both are stuck, the
    solution is started again, once, from zero impulses if the residual is far above that asked;
    otherwise Newton steps are taken. It is one function since each choice of a method depends on
    all that was tried before.
    """
    blocks, sweeps, left = len(setting.mass), 0 * fewest, np.inf
    small, place, apart = blocks <= SMALL, in_order(blocks), blocks - 1
    if not small:
        place, apart = band_ordering(joints, bodies, blocks)
    finer = (SHINED if small else POLISHED) * tolerance
    chained, carries, anew = small or apart <= CHAIN, True, False
    free_v, free_w = velocities_without(p, joints, bodies, v, w)
    while sweeps < setting.most and left > tolerance:
        if not small and sweeps >= ENOUGH and left <= setting.tolerance:
            break
        patience = STALLED if chained else CARRIED if carries else STEADIED
        few = smaller(patience, setting.most - sweeps)
        if carries and not chained:
            more, left = momentum_sweeps(p, joints, bodies, friction, v, w, tolerance, fewest, few)
        else:
            more, left = solve_contacts(p, joints, bodies, friction, v, w, tolerance, fewest, few)
        sweeps, carries = sweeps + more, not carries
        if left > tolerance:
            left = recomputed(p, joints, bodies, friction, v, w, free_v, free_w)
        stuck = not chained and sweeps >= STUCK and left > setting.tolerance
        if stuck and not anew and left > FAR * setting.tolerance:
            clear(p)
            left = recomputed(p, joints, bodies, friction, v, w, free_v, free_w)
            anew, carries = True, True
        elif (chained and left > tolerance) or stuck:
            aim, stiffness = (tolerance, SOFT) if stuck else (finer, STIFF)
            left = polish(p, joints, bodies, friction, v, w, aim, left, place, stiffness)
        if more == 0:
            break
    return sweeps, left


@called
def velocities_without(
    p: Vector, joints: Joints, bodies: Bodies, v: Vector, w: Vector
) -> tuple[Vector, Vector]:
    """The velocities and spins (b, 3) without the impulses p (c, 3), whose effect is in v, w."""
    free_v, free_w = same_rows(v, len(v)), same_rows(w, len(w))
    for c in range(len(p)):
        apply_nonzero(joints, c, bodies, free_v, free_w, add_scaled(ZERO, -1.0, at(p, c)))
    return free_v, free_w


@lent
def recomputed(
    p: Vector, joints: Joints, bodies: Bodies, friction: Friction, v: Vector, w: Vector,
    free_v: Vector, free_w: Vector,
) -> float:  # fmt: skip
    """Recompute v, w from the velocities without contact and the impulses p; return the residual.

    Each sweep adds its rounding to the velocities. In a narrow groove, where impulses over mass
    are 1e6 times the resulting velocity, the rounding would exceed the residual asked.
    """
    copy_rows(v, free_v)
    copy_rows(w, free_w)
    for c in range(len(p)):
        apply_nonzero(joints, c, bodies, v, w, at(p, c))
    return residual(p, joints, friction, v, w)


@called
def polish(
    p: Vector, joints: Joints, bodies: Bodies, friction: Friction, v: Vector, w: Vector,
    tolerance: float, left: float, place: Index, stiffness: float,
) -> float:  # fmt: skip
    """Improve p (c, 3), whose effect is in v, w, by Newton rounds; return the residual [m/s].

    left: the residual at the start; place: see `band_ordering`; stiffness: of the first round. A
    round that does not reduce the residual is undone, and the next one is less stiff, unless what
    is left is rounding: stiffer rounds then still improve impulses in a narrow groove.
    """
    before, before_v, before_w = rows(len(p)), rows(len(v)), rows(len(w))
    rounding = 0.0
    for c in range(len(p)):
        push = np.sqrt(dot(at(p, c), at(p, c)))
        rounding = larger(rounding, BLURRED * joints.across[c] * push)
    for _ in range(OUTER):
        if left <= tolerance or stiffness < 1.0:
            break
        copy_rows(before, p)
        copy_rows(before_v, v)
        copy_rows(before_w, w)
        met = newton_round(p, before, joints, bodies, friction, v, w, tolerance, stiffness, place)
        for c in range(len(p)):
            apply_nonzero(joints, c, bodies, v, w, add_scaled(at(p, c), -1.0, at(before, c)))
        now = residual(p, joints, friction, v, w)
        if met and (now < left or now <= rounding):
            left, stiffness = now, 10.0 * stiffness
        else:
            copy_rows(p, before)
            copy_rows(v, before_v)
            copy_rows(w, before_w)
            stiffness *= 0.01
    return left
