"""Contacts to be solved, and copies of their impulses and velocities to return to."""

from __future__ import annotations

from typing import NamedTuple

from vv.engines.kernels.bundles import bundle
from vv.engines.kernels.compiled import lent
from vv.engines.kernels.triples import add_scaled, at, put
from vv.engines.rigid.solver.assembly import Bodies, Joints, apply_nonzero
from vv.scene import Vector


@bundle
class Friction(NamedTuple):
    """mu; need: (c,) least normal velocities [m/s]; d, turn: (c, 3); see `cone`."""

    mu: float
    need: Vector
    d: Vector
    turn: Vector


@bundle
class Problem(NamedTuple):
    """Contacts to be solved: impulses p (c, 3) [N s] are sought, whose effect is in v, w (b, 3)."""

    joints: Joints
    bodies: Bodies
    friction: Friction
    p: Vector
    v: Vector
    w: Vector


@lent
def keep(problem: Problem, p: Vector, v: Vector, w: Vector) -> None:
    """Copy impulses into p (c, 3), and velocities and spins into v, w (b, 3)."""
    copy_rows(p, problem.p)
    copy_rows(v, problem.v)
    copy_rows(w, problem.w)


@lent
def restore(problem: Problem, p: Vector, v: Vector, w: Vector) -> None:
    """Give a problem the impulses and velocities that `keep` copied."""
    copy_rows(problem.p, p)
    copy_rows(problem.v, v)
    copy_rows(problem.w, w)


@lent
def apply_changes(problem: Problem, before: Vector, v: Vector, w: Vector) -> None:
    """Add to v, w (b, 3) the effect of the change of impulses since `before` (c, 3)."""
    p, joints, bodies = problem.p, problem.joints, problem.bodies
    for c in range(len(p)):
        apply_nonzero(joints, c, bodies, v, w, add_scaled(at(p, c), -1.0, at(before, c)))


@lent
def copy_rows(kept: Vector, rows: Vector) -> None:
    """Copy rows (k, 3) into kept; for a slice, numba would compile its error messages."""
    for k in range(len(rows)):
        put(kept, k, at(rows, k))
