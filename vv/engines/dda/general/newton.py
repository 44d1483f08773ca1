"""Newton's iteration on the contacts of a step whose open-close iteration does not converge.

The friction of a contact, its trial force limited to mu N, is a function of the displacements with
a kink where the contact opens and one where it begins to slide. The derivative is taken on the
current side of the kinks, with changes of N (Alart and Curnier 1991, on springs). Where the
function is linear, one iteration is exact; where friction rotates, convergence is quadratic.
"""

from __future__ import annotations

import numpy as np

from vv.engines.blocks.geometry import Index
from vv.engines.dda.general.assemble import fill_profile
from vv.engines.dda.general.bodies import Bodies, times_blocks
from vv.engines.dda.general.contact import Touch
from vv.engines.dda.general.linear import back, eliminate
from vv.engines.dda.law import OPEN, SLIDE, STICK
from vv.engines.dda.limits import LEAST
from vv.engines.kernels.arrays import counts, numbers, table, zero_numbers, zero_rows
from vv.engines.kernels.compiled import called, inlined, lent
from vv.engines.kernels.triples import NOWHERE, Triple, add_scaled, at, dot, put
from vv.scene import Vector


@inlined
def force_decrease(
    n: Triple,
    direction: Triple,
    state: int,
    turn: float,
    kn: float,
    ks: float,
    mu: float,
    a: Triple,
) -> Triple:
    """The decrease of a contact's force [N] for a relative displacement a [m].

    turn: ks mu N/|trial| [N/m].
    """
    opening = dot(n, a)
    flat = add_scaled(a, -opening, n)
    fall = add_scaled(NOWHERE, kn * opening, n)
    if state == STICK:
        return add_scaled(fall, ks, flat)
    fall = add_scaled(fall, -mu * kn * opening, direction)
    return add_scaled(fall, turn, add_scaled(flat, -dot(direction, flat), direction))


@lent
def tangent(
    matrix: Vector, first: Index, mass: Vector, bodies: Bodies, touch: Touch, turn: Vector,
    step: float, weight: float, kn: float, ks: float, mu: float, elastic: Vector,
) -> None:  # fmt: skip
    """Fill matrix (q, q) in its profile: inertia, strains, and derivatives of contact forces."""
    scale = weight / (step * step)
    for a in range(len(first)):
        for b in range(first[a], a + 1):
            matrix[a, b] = matrix[b, a] = 0.0
    for i in range(len(bodies.mass)):
        begin, end = bodies.start[i], bodies.start[i + 1]
        for a in range(begin, end):
            for b in range(begin, end):
                matrix[a, b] = scale * mass[a, b - begin] + elastic[a, b - begin]
    for k in range(len(touch.key)):
        if touch.state[k] != OPEN:
            n, direction = at(touch.normal, k), at(touch.direction, k)
            for j in range(touch.columns[k]):
                fall = force_decrease(
                    n, direction, touch.state[k], turn[k], kn, ks, mu, at(touch.field[k], j)
                )
                for m in range(touch.columns[k]):
                    matrix[touch.column[k, m], touch.column[k, j]] += dot(
                        at(touch.field[k], m), fall
                    )


@lent
def relative_motion(k: int, touch: Touch, d: Vector, shut: Vector) -> Triple:
    """The displacement [m] of the second body of contact k relative to the first, for d (q,)."""
    moves = add_scaled(NOWHERE, -1.0, at(shut, k))
    for m in range(touch.columns[k]):
        moves = add_scaled(moves, d[touch.column[k, m]], at(touch.field[k], m))
    return moves


@called
def residual_energy(
    d: Vector, touch: Touch, turn: Vector, bodies: Bodies, mass: Vector, constant: Vector,
    shut: Vector, step: float, weight: float, kn: float, ks: float, mu: float, elastic: Vector,
) -> float:  # fmt: skip
    """Set contacts to the states that the law gives for unknowns d (q,); return the residual [J].

    It is the sum of squared residuals of the equations, each divided by the inertia of its unknown.
    """
    q, scale = len(d), weight / (step * step)
    left, strained = numbers(q), numbers(q)
    times_blocks(left, mass, bodies, d)
    times_blocks(strained, elastic, bodies, d)
    for a in range(q):
        left[a] = scale * left[a] + strained[a] - constant[a]
    for k in range(len(touch.key)):
        n, moves = at(touch.normal, k), relative_motion(k, touch, d, shut)
        opened = dot(moves, n)
        trial = add_scaled(at(touch.spring, k), 1.0, add_scaled(moves, -opened, n))
        push, length = -kn * (touch.gap[k] + opened), np.sqrt(dot(trial, trial))
        now, direction, turn[k], pull = (
            STICK,
            NOWHERE,
            0.0,
            add_scaled(add_scaled(NOWHERE, push, n), -ks, trial),
        )
        if push <= 0.0:
            now, push, pull = OPEN, 0.0, NOWHERE
        elif ks * length > mu * push:
            now, turn[k], direction = (
                SLIDE,
                mu * push / length,
                add_scaled(NOWHERE, 1.0 / length, trial),
            )
            pull = add_scaled(add_scaled(NOWHERE, push, n), -mu * push, direction)
        touch.state[k], touch.push[k] = now, push
        put(touch.direction, k, direction)
        for m in range(touch.columns[k]):
            left[touch.column[k, m]] -= dot(at(touch.field[k], m), pull)
    total = 0.0
    for i in range(len(bodies.mass)):
        for a in range(bodies.start[i], bodies.start[i + 1]):
            total += left[a] * left[a] / (scale * mass[a, a - bodies.start[i]])
    return total


@called
def newton(
    d: Vector, touch: Touch, bodies: Bodies, mass: Vector, constant: Vector, shut: Vector,
    step: float, weight: float, kn: float, ks: float, mu: float, tolerance: float, most: int,
    elastic: Vector,
) -> tuple[bool, int, Index, Vector, Vector]:  # fmt: skip
    """As `iterate`, from unknowns d (q,), by at most `most` solutions.

    constant: (q,) generalised forces that depend on neither contacts nor unknowns; shut: (c, 3)
    displacements of walls [m]. An increment is halved until the residual decreases. It is one
    function since equations, solution and line search share its arrays.
    """
    q, count = len(d), len(touch.key)
    first, matrix = counts(q), table(q, q)
    right, ahead, trial = numbers(q), numbers(q), numbers(q)
    used, rub, relative = counts(count), zero_rows(count), zero_rows(count)
    turn = zero_numbers(count)
    fill_profile(first, bodies, touch)
    rest = bodies, mass, constant, shut, step, weight, kn, ks, mu, elastic
    left = residual_energy(d, touch, turn, *rest)
    ended, solved = False, 0
    while not ended and solved < most:
        tangent(matrix, first, mass, bodies, touch, turn, step, weight, kn, ks, mu, elastic)
        eliminate(matrix, first)
        for a in range(q):
            right[a] = constant[a]
        for k in range(count):
            used[k] = touch.state[k]
            if used[k] != OPEN:
                n, direction = at(touch.normal, k), at(touch.direction, k)
                still = add_scaled(
                    add_scaled(at(touch.spring, k), touch.gap[k], n), -1.0, at(shut, k)
                )
                pull = force_decrease(n, direction, used[k], turn[k], kn, ks, mu, still)
                for m in range(touch.columns[k]):
                    right[touch.column[k, m]] -= dot(at(touch.field[k], m), pull)
        back(matrix, first, right, ahead)
        solved += 1
        for k in range(count):
            n, direction, moves = (
                at(touch.normal, k),
                at(touch.direction, k),
                relative_motion(k, touch, ahead, shut),
            )
            opened, taken = dot(moves, n), NOWHERE
            if used[k] == SLIDE:
                taken = add_scaled(NOWHERE, -mu * kn * (touch.gap[k] + opened), direction)
                stretch = add_scaled(at(touch.spring, k), 1.0, add_scaled(moves, -opened, n))
                taken = add_scaled(
                    taken, turn[k], add_scaled(stretch, -dot(direction, stretch), direction)
                )
            put(relative, k, moves)
            put(rub, k, taken)
        now, share, ended = residual_energy(ahead, touch, turn, *rest), 1.0, True
        for k in range(count):
            ended = ended and touch.state[k] == used[k]
            if touch.state[k] == SLIDE:
                force = mu * touch.push[k]
                off = add_scaled(
                    add_scaled(NOWHERE, force, at(touch.direction, k)), -1.0, at(rub, k)
                )
                ended = ended and np.sqrt(dot(off, off)) <= tolerance * force
        while not (ended or now < (1.0 - LEAST * share) * left or share < LEAST):
            share *= 0.5
            for a in range(q):
                trial[a] = d[a] + share * (ahead[a] - d[a])
            now = residual_energy(trial, touch, turn, *rest)
        for a in range(q):
            d[a] = ahead[a] if share == 1.0 else trial[a]
        left = now
    return ended, solved, used, rub, relative
