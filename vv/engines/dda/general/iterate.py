"""The open-close iteration of a step, or of a part of one, as a kernel."""

from __future__ import annotations

import numpy as np

from vv.engines.blocks.geometry import Index
from vv.engines.dda.general.algebra.linear import factorise, substitute
from vv.engines.dda.general.assemble import assemble_stiffness, contact_force, fill_profile
from vv.engines.dda.general.bodies import Bodies, Motion, times_blocks
from vv.engines.dda.general.contact import Touch, relative_motion
from vv.engines.dda.general.newton import newton
from vv.engines.dda.general.setting import Law, Part, Setting, Trial, Work
from vv.engines.dda.law import OPEN, SLIDE, respond
from vv.engines.kernels.arrays import counts, larger, zero_numbers, zero_rows
from vv.engines.kernels.compiled import called, inlined, lent
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
def iterate(
    touch: Touch, work: Work, setting: Setting, motion: Motion, law: Law, part: Part
) -> tuple[bool, int, Trial]:
    """Solve for the unknowns `work.u` of a part of a step and for the states of all contacts.

    Returns whether the iteration converged, the number of solutions, and the last one. The states,
    normal forces and directions in touch are set to those that the law gives for it.
    """
    trial, choices = trial_of(touch, work.moved), setting.choices
    pose(work, touch, setting, motion, part)
    fresh, ended, solved = True, False, 0
    while not ended and solved < choices.iterations:
        for k in range(len(touch.key)):
            trial.used[k] = touch.state[k]
        if fresh:
            assemble_stiffness(work, touch, trial.used, setting, law, part)
            factorise(work.matrix, work.first)
        fill_right(work, touch, trial, law)
        substitute(work.matrix, work.first, work.right, work.u)
        solved += 1
        ease = inertia_stiffness(touch, trial.used, setting.bodies, part.length, part.weight)
        fresh, ended = respond_all(touch, trial, ease, work.u, law, choices.tolerance)
    if not ended and choices.newton > 0:
        ended, more = newton(touch, trial, work, setting, law, part)
        solved += more
    return ended, solved, trial


@called
def trial_of(touch: Touch, moved: Vector) -> Trial:
    """Arrays for a solution; moved: (w, 3) displacements of walls [m]."""
    count = len(touch.key)
    shut = zero_rows(count)
    for k in range(count):
        if touch.wall[k] >= 0:
            put(shut, k, at(moved, touch.wall[k]))
    return Trial(counts(count), zero_rows(count), shut, zero_rows(count))


@lent
def pose(work: Work, touch: Touch, setting: Setting, motion: Motion, part: Part) -> None:
    """Fill the generalised forces that depend on neither contacts nor unknowns, and the profile."""
    constant, right, outer = work.constant, work.right, work.outer
    fill_profile(work.first, setting.bodies, touch)
    times_blocks(constant, work.mass, setting.bodies, work.predictor)
    times_blocks(right, setting.elastic, setting.bodies, motion.strain)
    for a in range(len(constant)):
        constant[a] = outer[a] + part.weight / part.length * constant[a] - right[a]


@inlined
def fill_right(work: Work, touch: Touch, trial: Trial, law: Law) -> None:
    """Fill the right-hand side of the equations for the states that a solution assumes."""
    right, constant, used, shut = work.right, work.constant, trial.used, trial.shut
    for a in range(len(right)):
        right[a] = constant[a]
    for k in range(len(used)):
        pull = contact_force(
            k, touch, used[k], touch.push[k], at(touch.direction, k), at(shut, k), law
        )
        for m in range(touch.columns[k]):
            right[touch.column[k, m]] += dot(at(touch.field[k], m), pull)


@inlined
def respond_all(
    touch: Touch, trial: Trial, ease: Vector, u: Vector, law: Law, tolerance: float
) -> tuple[bool, bool]:
    """Set contacts to what the law gives for unknowns u (q,), see `respond` for ease (c,).

    Returns whether any of them changes its state, and whether what was assumed is a solution.
    """
    used, kn, ks, mu, hold = trial.used, law.kn, law.ks, law.mu, law.hold
    fresh, ended = False, True
    for k in range(len(used)):
        n = at(touch.normal, k)
        moves = relative_motion(k, touch, u, trial.shut)
        opened = dot(moves, n)
        slip, taken = add_scaled(moves, -opened, n), NOWHERE
        if used[k] == SLIDE:
            taken = add_scaled(NOWHERE, mu * touch.push[k], at(touch.direction, k))
        put(trial.relative, k, moves)
        put(trial.rub, k, taken)
        gap, spring = touch.gap[k] + opened, at(touch.spring, k)
        now, push, direction = respond(
            used[k], gap, slip, spring, at(touch.direction, k), kn, ks, mu, hold, ease[k],
            tolerance < np.inf,
        )  # fmt: skip
        touch.state[k], touch.push[k] = now, push
        put(touch.direction, k, direction)
        if now != used[k]:
            fresh, ended = True, False
        elif now == SLIDE:
            off = add_scaled(add_scaled(NOWHERE, mu * push, direction), -1.0, taken)
            if np.sqrt(dot(off, off)) > tolerance * mu * push:
                ended = False
    return fresh, ended
