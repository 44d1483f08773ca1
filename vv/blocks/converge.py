"""The contact solver of a step: sweeps, and in small scenes Newton steps where these stall."""

from __future__ import annotations

import numpy as np

from vv.blocks.assembly import Bodies, Joints, load_on
from vv.blocks.cone import Friction, keep, residual, solve_contacts
from vv.blocks.limits import OUTER, SMALL, STALLED, STIFF
from vv.blocks.newton import balanced
from vv.blocks.rigid_setting import Setting
from vv.compiled import called
from vv.scene import Vector
from vv.triples import at, plus


@called
def converged(
    setting: Setting, joints: Joints, bodies: Bodies, friction: Friction,
    p: Vector, v: Vector, w: Vector, fewest: int,
) -> tuple[int, float]:  # fmt: skip
    """Sweep until the residual is met, in small scenes with Newton steps where sweeps stall."""
    small, sweeps, left = len(setting.mass) <= SMALL, 0 * fewest, np.inf
    while sweeps < setting.most and left > setting.tolerance:
        few = min(STALLED, setting.most - sweeps) if small else setting.most
        more, left = solve_contacts(
            p, joints, bodies, friction, v, w, setting.tolerance, fewest, few
        )
        sweeps += more
        if small and left > setting.tolerance:
            left = polish(p, joints, bodies, friction, v, w, setting.tolerance, left)
        if more == 0:
            break
    return sweeps, left


@called
def polish(
    p: Vector, joints: Joints, bodies: Bodies, friction: Friction, v: Vector, w: Vector,
    tolerance: float, left: float,
) -> float:  # fmt: skip
    """Improve p (c, 3), whose effect is in v and w and whose residual is `left`; return what is.

    A round that makes the residual [m/s] no smaller is undone, and the next less stiff.
    """
    before, before_v, before_w = p.copy(), v.copy(), w.copy()
    stiffness = STIFF
    for _ in range(OUTER):
        if left <= tolerance or stiffness < 1.0:
            break
        keep(before, p)
        keep(before_v, v)
        keep(before_w, w)
        met = balanced(p, before, joints, bodies, friction, v, w, tolerance, stiffness)
        for c in range(len(p)):
            load_on(joints, c, bodies, v, w, plus(at(p, c), -1.0, at(before, c)))
        now = residual(p, joints, friction, v, w)
        if met and now < left:
            left, stiffness = now, 10.0 * stiffness
        else:
            keep(p, before)
            keep(v, before_v)
            keep(w, before_w)
            stiffness *= 0.01
    return left
