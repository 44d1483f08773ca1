"""Kernels for the mean direction of friction over a step of rigid blocks whose slip turns."""

from __future__ import annotations

from vv.engines.kernels.compiled import called, lent
from vv.engines.kernels.drive import mean, one_of, rate
from vv.engines.kernels.triples import Triple, add_scaled, at, dot, put
from vv.engines.rigid.general.setting import Setting
from vv.engines.rigid.slip import bend
from vv.engines.rigid.solver.assembly import Joints, relative
from vv.engines.rigid.solver.cone import Friction
from vv.scene import Vector

NIL = (0.0, 0.0, 0.0)


@lent
def bent(
    setting: Setting, now: float, span: float, joints: Joints, friction: Friction, p: Vector,
    v_old: Vector, w_old: Vector, v: Vector, w: Vector,
) -> bool:  # fmt: skip
    """Set the turn of all slips for their present ends; tell whether there is any."""
    there = False
    for c in range(len(p)):
        n, d = at(joints.normal, c), at(friction.d, c)
        normal = dot(at(p, c), n)
        if dot(d, d) == 0.0 or normal <= 0.0:
            continue
        before, after = relative(joints, c, v_old, w_old), relative(joints, c, v, w)
        sag = sagging(setting, now, span, joints.first[c], n)
        pull = friction.mu * normal * joints.along[c]
        before, after = add_scaled(before, -dot(before, n), n), add_scaled(after, -dot(after, n), n)
        turn = bend(before, sag, after, pull)
        put(friction.turn, c, turn)
        there = there or dot(turn, turn) > 0.0
    return there


@called
def sagging(setting: Setting, now: float, span: float, body: int, normal: Triple) -> Triple:
    """How far drives take slip on a wall halfway from the mean of its first and last [m/s]."""
    sag, wall = NIL, body - len(setting.mass)
    if wall < 0:
        return sag
    sag = add_scaled(sag, 0.5 * span, mean(setting.shaking, now, 0.5 * span))
    sag = add_scaled(sag, -0.5 * span, mean(setting.shaking, now, span))
    base = one_of(setting.drives, setting.drive_start, wall)
    sag = add_scaled(sag, -1.0, rate(base, now + 0.5 * span))
    sag = add_scaled(add_scaled(sag, 0.5, rate(base, now)), 0.5, rate(base, now + span))
    return add_scaled(sag, -dot(sag, normal), normal)
