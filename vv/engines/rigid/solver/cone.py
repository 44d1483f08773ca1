"""Solves contacts with exact Coulomb friction by accelerated projected Gauss-Seidel sweeps.

For each contact, with relative velocity u at the end of the step and impulse p: u.n - need >= 0 is
complementary to p.n >= 0, and the tangential impulse maximises the dissipation within
-mu p.n (d/2 + turn) + disc(mu p.n/2), or within disc(mu p.n) if d = 0. Contacts are swept in order;
the change of a sweep serves as a gradient for nonlinear conjugate gradients (Silcowitz, Niebe and
Erleben 2010). The tangential step size is one number per contact: different step sizes in different
directions would change the direction of friction.
"""

from __future__ import annotations

import numpy as np

from vv.engines.kernels.arrays import clear, larger, rows, zero_numbers, zero_rows
from vv.engines.kernels.compiled import called, inlined, lent
from vv.engines.kernels.triples import Triple, add_scaled, at, dot, put
from vv.engines.rigid.solver.assembly import Bodies, Joints, apply, relative
from vv.engines.rigid.solver.problem import Friction, Problem, keep
from vv.scene import Vector


@inlined
def limit(cap: float, d: Triple, turn: Triple) -> tuple[Triple, float]:
    """Centre and radius [N s] of the disc of tangential impulses at a normal impulse cap/mu."""
    if dot(d, d) == 0.0:
        return (0.0, 0.0, 0.0), cap
    return add_scaled(add_scaled((0.0, 0.0, 0.0), -0.5 * cap, d), -cap, turn), 0.5 * cap


@inlined
def projected(
    along: float, n: Triple, u: Triple, p: Triple, cap: float, d: Triple, turn: Triple
) -> Triple:
    """The tangential impulse after one projected step from p; along: see `Joints`.

    Arguments are numbers and not arrays, to which numba would count references at every contact.
    """
    flat = add_scaled(p, -dot(p, n), n)
    if along > 0.0:
        flat = add_scaled(flat, -1.0 / along, add_scaled(u, -dot(u, n), n))
    centre, radius = limit(cap, d, turn)
    left = add_scaled(flat, -1.0, centre)
    size = np.sqrt(dot(left, left))
    return add_scaled(centre, radius / size if size > radius else 1.0, left)


@inlined
def normal_mobility(across: float, pull: Triple, mu: float) -> float:
    """The mobility [1/kg] by which a normal velocity is divided to get the normal impulse.

    Friction grows with the normal impulse, and through the lever arms changes the normal velocity
    by up to mu times the tangential part of `pull`. Where this exceeds the effect of the normal
    impulse itself, sweeps would diverge unless both are added.
    """
    square = across * across
    lifts = mu * mu * (dot(pull, pull) - square)
    return across + np.sqrt(lifts) if lifts > square else across


@lent
def sweep(
    p: Vector, joints: Joints, bodies: Bodies, friction: Friction, v: Vector, w: Vector
) -> None:
    """One pass over all contacts: the normal impulse of each, then its tangential impulse."""
    for c in range(len(p)):
        n, before = at(joints.normal, c), at(p, c)
        if joints.across[c] <= 0.0:
            continue
        u = relative(joints, c, v, w)
        had = dot(before, n)
        yields = normal_mobility(joints.across[c], at(joints.pull, c), friction.mu)
        normal = larger(0.0, had - (dot(u, n) - friction.need[c]) / yields)
        if normal == 0.0 and dot(before, before) == 0.0:
            continue
        u = add_scaled(u, normal - had, at(joints.pull, c))
        d, turn = at(friction.d, c), at(friction.turn, c)
        along = projected(joints.along[c], n, u, before, friction.mu * normal, d, turn)
        after = add_scaled(along, normal, n)
        apply(joints, c, bodies, v, w, add_scaled(after, -1.0, before))
        put(p, c, after)


@lent
def residual(p: Vector, joints: Joints, friction: Friction, v: Vector, w: Vector) -> float:
    """The largest change of velocity [m/s] by a projected step at any contact (natural map)."""
    worst = 0.0
    for c in range(len(p)):
        if joints.across[c] <= 0.0:
            continue
        n, u, now = at(joints.normal, c), relative(joints, c, v, w), at(p, c)
        had = dot(now, n)
        normal = larger(0.0, had - (dot(u, n) - friction.need[c]) / joints.across[c])
        worst = larger(worst, abs(normal - had) * joints.across[c])
        d, turn = at(friction.d, c), at(friction.turn, c)
        along = projected(joints.along[c], n, u, now, friction.mu * had, d, turn)
        change = add_scaled(along, -1.0, add_scaled(now, -had, n))
        worst = larger(worst, np.sqrt(dot(change, change)) * joints.along[c])
    return worst


@called
def solve_contacts(problem: Problem, tolerance: float, fewest: int, most: int) -> tuple[int, float]:
    """Iterate impulses until the residual is at most `tolerance` [m/s].

    At least `fewest` sweeps are made, unless the residual is zero. Returns the number of sweeps and
    the residual, which exceeds the tolerance if `most` sweeps were not enough.
    """
    p, joints, bodies, friction = problem.p, problem.joints, problem.bodies, problem.friction
    v, w = problem.v, problem.w
    before, before_v, before_w = rows(len(p)), rows(len(v)), rows(len(w))
    direction, direction_v, direction_w = zero_rows(len(p)), zero_rows(len(v)), zero_rows(len(w))
    last, left = 0.0, residual(p, joints, friction, v, w)
    sweeps = 0
    while (left > tolerance or (sweeps < fewest and left > 0.0)) and sweeps < most:
        keep(problem, before, before_v, before_w)
        sweep(p, joints, bodies, friction, v, w)
        sweeps += 1
        size, largest = change_of(p, before, joints)
        if (largest <= tolerance and sweeps >= fewest) or sweeps == most:
            left = residual(p, joints, friction, v, w)
            if left <= tolerance or sweeps == most:
                break
        share = size / last if last > 0.0 else 0.0
        last = size
        goes_on = share <= 1.0
        follow_direction(direction, before, p, share, goes_on)
        follow_direction(direction_v, before_v, v, share, goes_on)
        follow_direction(direction_w, before_w, w, share, goes_on)
    return sweeps, left


@lent
def change_of(p: Vector, before: Vector, joints: Joints) -> tuple[float, float]:
    """The squared norm [N2 s2] of the change of impulses, and its largest effect [m/s]."""
    size, largest = 0.0, 0.0
    for c in range(len(p)):
        change = add_scaled(at(p, c), -1.0, at(before, c))
        square = dot(change, change)
        size += square
        stiff = larger(joints.across[c], joints.along[c])
        largest = larger(largest, square * (stiff * stiff))
    return size, np.sqrt(largest)


@lent
def follow_direction(
    direction: Vector, before: Vector, now: Vector, share: float, goes_on: bool
) -> None:
    """Add `share` times the search direction `direction` (k, 3) to `now`, and update the direction.

    The new direction is share times the old one plus the last change, or zero if it is restarted
    (not `goes_on`). Velocities depend linearly on impulses, so that the same holds for both.
    """
    for k in range(len(direction)):
        change = add_scaled(at(now, k), -1.0, at(before, k))
        ahead = add_scaled((0.0, 0.0, 0.0), share, at(direction, k))
        if goes_on:
            put(direction, k, add_scaled(ahead, 1.0, change))
            put(now, k, add_scaled(at(now, k), 1.0, ahead))
        else:
            put(direction, k, (0.0, 0.0, 0.0))


@called
def push_out(
    joints: Joints, bodies: Bodies, gap: Vector, x: Vector, turn: Vector, sweeps: int
) -> None:
    """Fill x, turn (b, 3) [m, rad] with the displacements after which no gap (c,) [m] is negative.

    They are the least ones in the norm of the masses, approximated by `sweeps` sweeps; velocities
    do not change.
    """
    pushed = zero_numbers(len(gap))
    clear(x)
    clear(turn)
    for _ in range(sweeps):
        for c in range(len(gap)):
            if joints.across[c] > 0.0:
                n = at(joints.normal, c)
                left = gap[c] + dot(n, relative(joints, c, x, turn))
                more = larger(-pushed[c], -left / joints.across[c])
                pushed[c] += more
                apply(joints, c, bodies, x, turn, add_scaled((0.0, 0.0, 0.0), more, n))
