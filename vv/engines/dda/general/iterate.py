"""The open-close iteration of a step, or of a part of one, as a kernel."""

from __future__ import annotations

import numpy as np

from vv.engines.blocks.geometry import Index
from vv.engines.dda.general.assemble import assemble_stiffness, contact_force, fill_profile
from vv.engines.dda.general.bodies import Bodies, Motion, times_blocks
from vv.engines.dda.general.contact import Touch
from vv.engines.dda.general.linear import factorise, substitute
from vv.engines.dda.general.newton import newton
from vv.engines.dda.law import OPEN, SLIDE, respond
from vv.engines.kernels.arrays import counts, larger, numbers, table, zero_numbers, zero_rows
from vv.engines.kernels.compiled import called
from vv.engines.kernels.triples import NOWHERE, add_scaled, at, dot, put
from vv.scene import Vector


@called
def inertia_stiffness(
    touch: Touch, state: Index, bodies: Bodies, step: float, weight: float
) -> Vector:
    """The stiffness [N/m] by which inertia resists slip at contacts (c,): weight m/D^2 each."""
    closed = zero_numbers(len(bodies.mass))
    for k in range(len(touch.key)):
        if state[k] != OPEN:
            closed[touch.second[k]] += 1.0
            if touch.wall[k] < 0:
                closed[touch.first[k]] += 1.0
    ease = zero_numbers(len(touch.key))
    for k in range(len(touch.key)):
        two = touch.second[k]
        compliance = larger(closed[two], 1.0) / bodies.mass[two]
        if touch.wall[k] < 0:
            one = touch.first[k]
            compliance += larger(closed[one], 1.0) / bodies.mass[one]
        ease[k] = weight / (step * step * compliance)
    return ease


@called
def iterate(  # noqa: PLR0912 - a branch per contact state
    d: Vector, touch: Touch, bodies: Bodies, motion: Motion, mass: Vector, outer: Vector,
    moved: Vector, predictor: Vector, step: float, weight: float, kn: float, ks: float, mu: float,
    hold: float, tolerance: float, iterations: int, most: int, elastic: Vector,
) -> tuple[bool, int, Index, Vector, Vector]:  # fmt: skip
    """Solve for the unknowns d (q,) of a step [s] and for the states of all contacts.

    outer: (q,) generalised loads; moved: (w, 3) displacements of walls [m]; predictor (q,), weight:
    the inertia terms, see `inertia`; iterations: of the open-close iteration; most: solutions by
    Newton's iteration if that does not converge.

    Returns whether the iteration converged, the number of solutions, and per contact what the last
    one assumed, states (c,) and friction (c, 3) [N], and its relative displacement (c, 3) [m]. The
    states, normal forces and directions in touch are set to those that the law gives for it. It is
    one function since solution and contact law share its arrays in each iteration.
    """
    q, count = len(d), len(touch.key)
    first, matrix = counts(q), table(q, q)
    right, constant = numbers(q), numbers(q)
    used, rub = counts(count), zero_rows(count)
    relative, shut = zero_rows(count), zero_rows(count)
    fill_profile(first, bodies, touch)
    times_blocks(constant, mass, bodies, predictor)
    times_blocks(right, elastic, bodies, motion.strain)
    for a in range(q):
        constant[a] = outer[a] + weight / step * constant[a] - right[a]
    for k in range(count):
        if touch.wall[k] >= 0:
            put(shut, k, at(moved, touch.wall[k]))
    fresh, ended, solved = True, False, 0
    while not ended and solved < iterations:
        for k in range(count):
            used[k] = touch.state[k]
        if fresh:
            assemble_stiffness(
                matrix, first, mass, bodies, touch, used, step, weight, kn, ks, elastic
            )
            factorise(matrix, first)
        for a in range(q):
            right[a] = constant[a]
        for k in range(count):
            pull = contact_force(
                k, touch, used[k], touch.push[k], at(touch.direction, k), at(shut, k), kn, ks, mu
            )
            for m in range(touch.columns[k]):
                right[touch.column[k, m]] += dot(at(touch.field[k], m), pull)
        substitute(matrix, first, right, d)
        solved += 1
        fresh, ended = False, True
        ease = inertia_stiffness(touch, used, bodies, step, weight)
        for k in range(count):
            n = at(touch.normal, k)
            moves = add_scaled(NOWHERE, -1.0, at(shut, k))
            for m in range(touch.columns[k]):
                moves = add_scaled(moves, d[touch.column[k, m]], at(touch.field[k], m))
            opened = dot(moves, n)
            slip, taken = add_scaled(moves, -opened, n), NOWHERE
            if used[k] == SLIDE:
                taken = add_scaled(NOWHERE, mu * touch.push[k], at(touch.direction, k))
            put(relative, k, moves)
            put(rub, k, taken)
            gap, spring, direction = (
                touch.gap[k] + opened,
                at(touch.spring, k),
                at(touch.direction, k),
            )
            now, push, direction = respond(
                used[k], gap, slip, spring, direction, kn, ks, mu, hold, ease[k], tolerance < np.inf
            )
            touch.state[k], touch.push[k] = now, push
            put(touch.direction, k, direction)
            if now != used[k]:
                fresh, ended = True, False
            elif now == SLIDE:
                off = add_scaled(add_scaled(NOWHERE, mu * push, direction), -1.0, taken)
                if np.sqrt(dot(off, off)) > tolerance * mu * push:
                    ended = False
    if ended or most == 0:
        return ended, solved, used, rub, relative
    ended, more, used, rub, relative = newton(
        d, touch, bodies, mass, constant, shut, step, weight, kn, ks, mu, tolerance, most, elastic
    )
    return ended, solved + more, used, rub, relative
