"""Kernel for the projection of an augmented Lagrangian: impulses that friction allows."""

from __future__ import annotations

import numpy as np

from vv.engines.kernels.arrays import clear, zero_squares
from vv.engines.kernels.compiled import called, lent
from vv.engines.kernels.triples import Triple, add_scaled, at, dot, put
from vv.engines.rigid.solver.assembly import Joints, relative
from vv.engines.rigid.solver.cone import limit
from vv.engines.rigid.solver.problem import Friction, Problem
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
def fill_impulses(problem: Problem, q: Vector, stiffness: float, x: Vector, y: Vector) -> None:
    """Fill p with the projected impulses from q (c, 3) at velocities and spins x, y (b, 3)."""
    p, joints, slope = problem.p, problem.joints, zero_squares(1)[0]
    for c in range(len(p)):
        if joints.across[c] > 0.0:
            u = relative(joints, c, x, y)
            put(p, c, projected_impulse(joints, c, problem.friction, stiffness, at(q, c), u, slope))
