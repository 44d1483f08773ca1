"""Kernels for the mean direction of friction over a step of blocks whose slip changes direction."""

from __future__ import annotations

import numpy as np

from vv.engines.kernels.compiled import called, lent
from vv.engines.kernels.drive import mean, one_of, rate
from vv.engines.kernels.triples import Triple, add_scaled, at, dot, put
from vv.engines.rigid.general.setting import Setting
from vv.engines.rigid.slip import bend
from vv.engines.rigid.solver.assembly import Joints, relative, times
from vv.engines.rigid.solver.cone import Friction
from vv.scene import Vector

ZERO = (0.0, 0.0, 0.0)
ALIKE = 1e-7  # sine of the angle below which two normals are the same


@lent
def set_turns(
    setting: Setting, now: float, span: float, joints: Joints, friction: Friction, p: Vector,
    v_old: Vector, w_old: Vector, v: Vector, w: Vector,
) -> bool:  # fmt: skip
    """Set friction.turn (see `bend`) from the present velocities; return whether any is nonzero."""
    there = False
    for c in range(len(p)):
        n, d = at(joints.normal, c), at(friction.d, c)
        normal = dot(at(p, c), n)
        if dot(d, d) == 0.0 or normal <= 0.0:
            continue
        before, after = relative(joints, c, v_old, w_old), relative(joints, c, v, w)
        sag = sag_by_motions(setting, now, span, joints, c)
        if dot(sag, sag) > 0.0:
            sag = along_groove(sag, joints, c, p, len(setting.mass))
        pull = friction.mu * normal * joints.along[c]
        before, after = add_scaled(before, -dot(before, n), n), add_scaled(after, -dot(after, n), n)
        turn = bend(before, sag, after, pull)
        put(friction.turn, c, turn)
        there = there or dot(turn, turn) > 0.0
    return there


@called
def sag_by_motions(setting: Setting, now: float, span: float, joints: Joints, c: int) -> Triple:
    """The velocity at mid-step minus the mean of those at its ends, by prescribed motions [m/s].

    It is that of a block relative to its wall, without contact forces; zero between two blocks.
    """
    sag, wall, block = ZERO, joints.first[c] - len(setting.mass), joints.second[c]
    if wall < 0:
        return sag
    sag = add_scaled(sag, 0.5 * span, mean(setting.shaking, now, 0.5 * span))
    sag = add_scaled(sag, -0.5 * span, mean(setting.shaking, now, span))
    sag = times(setting.inverse, block, add_scaled(ZERO, setting.mass[block], sag))
    base = one_of(setting.drives, setting.drive_start, wall)
    sag = add_scaled(sag, -1.0, rate(base, now + 0.5 * span))
    return add_scaled(add_scaled(sag, 0.5, rate(base, now)), 0.5, rate(base, now + span))


@lent
def along_groove(sag: Triple, joints: Joints, c: int, p: Vector, blocks: int) -> Triple:
    """The part of a velocity at contact c that the walls pressed on its block allow.

    On walls with one normal it is the part in their plane, on walls with two normals that along
    their groove; on walls with three it is zero.
    """
    n, out = at(joints.normal, c), ZERO
    sag = add_scaled(sag, -dot(sag, n), n)
    for k in range(len(p)):
        m = at(joints.normal, k)
        presses = joints.second[k] == joints.second[c] and dot(at(p, k), m) > 0.0
        if not presses or joints.first[k] < blocks:
            continue
        m = add_scaled(add_scaled(m, -dot(m, n), n), -dot(m, out), out)
        size = np.sqrt(dot(m, m))
        if size > ALIKE:
            if dot(out, out) > 0.0:
                return ZERO
            out = add_scaled(ZERO, 1.0 / size, m)
            sag = add_scaled(sag, -dot(sag, out), out)
    return sag
