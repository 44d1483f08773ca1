"""Kernels for the mean direction of friction over a step of blocks whose slip changes direction."""

from __future__ import annotations

import numpy as np

from vv.engines.kernels.arrays import zero_rows
from vv.engines.kernels.compiled import called, lent
from vv.engines.kernels.drive import mean, one_of, rate
from vv.engines.kernels.triples import Triple, add_scaled, at, dot, put
from vv.engines.rigid.general.setting import Setting
from vv.engines.rigid.slip import bend
from vv.engines.rigid.solver.assembly import Bodies, Joints, apply_nonzero, relative, times
from vv.engines.rigid.solver.problem import Friction, Problem
from vv.scene import Vector

ZERO = (0.0, 0.0, 0.0)
ALIKE = 1e-7  # sine of the angle below which two normals are the same


@called
def set_turns(
    setting: Setting, now: float, span: float, problem: Problem, v_old: Vector, w_old: Vector
) -> bool:
    """Set friction.turn (see `bend`) from the present velocities; return whether any is nonzero."""
    joints, bodies, friction = problem.joints, problem.bodies, problem.friction
    p, v, w = problem.p, problem.v, problem.w
    there, dv, dw = False, zero_rows(len(v)), zero_rows(len(w))
    add_friction(joints, bodies, friction, p, dv, dw)
    for c in range(len(p)):
        if not slips(joints, friction, p, c):
            continue
        before, after = flat(joints, c, v_old, w_old), flat(joints, c, v, w)
        sag = sag_by_motions(setting, now, span, joints, c)
        if dot(sag, sag) > 0.0:
            sag = along_groove(sag, joints, c, p, len(setting.mass))
        pulled = flat(joints, c, dv, dw)
        turn = bend(before, sag, after, np.sqrt(dot(pulled, pulled)))
        put(friction.turn, c, turn)
        there = there or dot(turn, turn) > 0.0
    return there


@lent
def add_friction(
    joints: Joints, bodies: Bodies, friction: Friction, p: Vector, v: Vector, w: Vector
) -> None:
    """Add to v, w (b, 3) what friction gives the bodies if it keeps its mean direction in a step.

    Where slip turns, impulses are shorter than what friction adds up to.
    """
    for c in range(len(p)):
        n = at(joints.normal, c)
        normal = dot(at(p, c), n)
        along = add_scaled(at(p, c), -normal, n)
        size = np.sqrt(dot(along, along))
        if size > 0.0 and slips(joints, friction, p, c):
            along = add_scaled(ZERO, friction.mu * normal / size, along)
        apply_nonzero(joints, c, bodies, v, w, along)


@lent
def slips(joints: Joints, friction: Friction, p: Vector, c: int) -> bool:
    """Whether contact c is pressed and slips at the start of the step."""
    d = at(friction.d, c)
    return dot(d, d) > 0.0 and dot(at(p, c), at(joints.normal, c)) > 0.0


@lent
def flat(joints: Joints, c: int, v: Vector, w: Vector) -> Triple:
    """The tangential part of the relative velocity at contact c [m/s]."""
    n, u = at(joints.normal, c), relative(joints, c, v, w)
    return add_scaled(u, -dot(u, n), n)


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
