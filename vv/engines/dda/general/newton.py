"""Newton's iteration on the contacts of a step whose open-close iteration does not converge.

The friction of a contact, its trial force limited to mu N, is a function of the displacements with
a kink where the contact opens and one where it begins to slide. The derivative is taken on the
current side of the kinks, with changes of N (Alart and Curnier 1991, on springs). Where the
function is linear, one iteration is exact; where friction rotates, convergence is quadratic.
"""

from __future__ import annotations

import numpy as np

from vv.engines.dda.general.algebra.linear import back, eliminate
from vv.engines.dda.general.assemble import assemble_tangent, force_decrease
from vv.engines.dda.general.bodies import times_blocks
from vv.engines.dda.general.contact import Touch, opening, relative_motion
from vv.engines.dda.general.setting import Law, Part, Setting, Trial, Work
from vv.engines.dda.law import OPEN, SLIDE, STICK
from vv.engines.dda.limits import LEAST
from vv.engines.kernels.arrays import numbers, zero_numbers
from vv.engines.kernels.compiled import called, lent
from vv.engines.kernels.triples import NOWHERE, Triple, add_scaled, at, dot, put
from vv.scene import Vector


@called
def residual_energy(
    d: Vector, touch: Touch, turn: Vector, shut: Vector, work: Work, setting: Setting, law: Law,
    part: Part,
) -> float:  # fmt: skip
    """Set contacts to the states that the law gives for unknowns d (q,); return the residual [J].

    It is the sum of squared residuals of the equations, each divided by the inertia of its unknown.
    turn: (c,) is set, see `force_decrease`; shut: (c, 3) displacements of walls [m].
    """
    q, scale, bodies = len(d), part.weight / (part.length * part.length), setting.bodies
    left, strained, mass, constant = numbers(q), numbers(q), work.mass, work.constant
    times_blocks(left, mass, bodies, d)
    times_blocks(strained, setting.elastic, bodies, d)
    for a in range(q):
        left[a] = scale * left[a] + strained[a] - constant[a]
    for k in range(len(touch.key)):
        moves, opened = relative_motion(k, touch, d, shut), opening(k, touch, d, shut)
        pull = respond_exactly(k, touch, turn, moves, opened, law)
        for m in range(touch.columns[k]):
            left[touch.column[k, m]] -= dot(at(touch.field[k], m), pull)
    total = 0.0
    for i in range(len(bodies.mass)):
        for a in range(bodies.start[i], bodies.start[i + 1]):
            total += left[a] * left[a] / (scale * mass[a, a - bodies.start[i]])
    return total


@lent
def respond_exactly(
    k: int, touch: Touch, turn: Vector, moves: Triple, opened: float, law: Law
) -> Triple:
    """Set contact k to the state that the law gives for its displacement [m]; return its force.

    opened: the part of `moves` along its normal, see `opening`.
    """
    kn, ks, mu = law.kn, law.ks, law.mu
    n = at(touch.normal, k)
    trial = add_scaled(at(touch.spring, k), 1.0, add_scaled(moves, -opened, n))
    push, length = -kn * (touch.gap[k] + opened), np.sqrt(dot(trial, trial))
    now, direction, turn[k] = STICK, NOWHERE, 0.0
    pull = add_scaled(add_scaled(NOWHERE, push, n), -ks, trial)
    if push <= 0.0:
        now, push, pull = OPEN, 0.0, NOWHERE
    elif ks * length > mu * push:
        now, turn[k] = SLIDE, mu * push / length
        direction = add_scaled(NOWHERE, 1.0 / length, trial)
        pull = add_scaled(add_scaled(NOWHERE, push, n), -mu * push, direction)
    touch.state[k], touch.push[k] = now, push
    put(touch.direction, k, direction)
    return pull


@called
def newton(
    touch: Touch, trial: Trial, work: Work, setting: Setting, law: Law, part: Part
) -> tuple[bool, int]:
    """As `iterate`, from the unknowns and the constant forces and profile in `work`.

    Returns whether it converged, and the number of solutions. An increment is halved until the
    residual decreases.
    """
    q, d, shut, tolerance = len(work.u), work.u, trial.shut, setting.choices.tolerance
    ahead, halved, turn = numbers(q), numbers(q), zero_numbers(len(touch.key))
    left = residual_energy(d, touch, turn, shut, work, setting, law, part)
    ended, solved, share = False, 0, 1.0
    while not ended and solved < setting.choices.newton:
        assemble_tangent(touch, turn, work, setting, law, part)
        eliminate(work.matrix, work.first)
        fill_tangent_right(work, touch, trial, turn, law)
        back(work.matrix, work.first, work.right, ahead)
        solved += 1
        fill_trial(trial, touch, ahead, turn, law)
        now, share = residual_energy(ahead, touch, turn, shut, work, setting, law, part), 1.0
        ended = is_solution(touch, trial, law.mu, tolerance)
        while not (ended or now < (1.0 - LEAST * share) * left or share < LEAST):
            share *= 0.5
            for a in range(q):
                halved[a] = d[a] + share * (ahead[a] - d[a])
            now = residual_energy(halved, touch, turn, shut, work, setting, law, part)
        for a in range(q):
            d[a] = ahead[a] if share == 1.0 else halved[a]
        left = now
    if share < 1.0:
        assume_present_states(trial, touch, d, law.mu)
    return ended, solved


@lent
def assume_present_states(trial: Trial, touch: Touch, d: Vector, mu: float) -> None:
    """Fill a trial with unknowns d (q,) and the states and friction that the law gives for them.

    After an increment that was halved, which no solution of the equations assumed. What is left
    violates the equations of motion, and works and losses are those of the displacements made.
    """
    for k in range(len(trial.used)):
        trial.used[k] = touch.state[k]
        put(trial.relative, k, relative_motion(k, touch, d, trial.shut))
        friction = mu * touch.push[k] if touch.state[k] == SLIDE else 0.0
        put(trial.rub, k, add_scaled(NOWHERE, friction, at(touch.direction, k)))


@lent
def fill_tangent_right(work: Work, touch: Touch, trial: Trial, turn: Vector, law: Law) -> None:
    """Fill the right-hand side of Newton's equations; the solution assumes the present states."""
    right, constant, used = work.right, work.constant, trial.used
    for a in range(len(right)):
        right[a] = constant[a]
    for k in range(len(used)):
        used[k] = touch.state[k]
        if used[k] != OPEN:
            n, direction, shut = at(touch.normal, k), at(touch.direction, k), at(trial.shut, k)
            closing = dot(shut, n)
            flat = add_scaled(at(touch.spring, k), -1.0, add_scaled(shut, -closing, n))
            pull = force_decrease(
                n, direction, used[k], turn[k], law.kn, law.ks, law.mu, touch.gap[k] - closing, flat
            )
            for m in range(touch.columns[k]):
                right[touch.column[k, m]] -= dot(at(touch.field[k], m), pull)


@lent
def fill_trial(trial: Trial, touch: Touch, d: Vector, turn: Vector, law: Law) -> None:
    """Fill displacements of contacts and friction of a solution d (q,) of Newton's equations."""
    for k in range(len(turn)):
        n, direction = at(touch.normal, k), at(touch.direction, k)
        moves = relative_motion(k, touch, d, trial.shut)
        opened, taken = opening(k, touch, d, trial.shut), NOWHERE
        if trial.used[k] == SLIDE:
            taken = add_scaled(NOWHERE, -law.mu * law.kn * (touch.gap[k] + opened), direction)
            stretch = add_scaled(at(touch.spring, k), 1.0, add_scaled(moves, -opened, n))
            turned = add_scaled(stretch, -dot(direction, stretch), direction)
            taken = add_scaled(taken, turn[k], turned)
        put(trial.relative, k, moves)
        put(trial.rub, k, taken)


@lent
def is_solution(touch: Touch, trial: Trial, mu: float, tolerance: float) -> bool:
    """Whether the present states and friction of contacts are those that a solution assumed."""
    same = True
    for k in range(len(trial.used)):
        same = same and touch.state[k] == trial.used[k]
        if touch.state[k] == SLIDE:
            force = mu * touch.push[k]
            due = add_scaled(NOWHERE, force, at(touch.direction, k))
            off = add_scaled(due, -1.0, at(trial.rub, k))
            same = same and np.sqrt(dot(off, off)) <= tolerance * force
    return same
