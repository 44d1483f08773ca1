"""The open-close iteration of one block that cannot rotate, inlined into its kernel."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vv.engines.dda.law import OPEN, SLIDE, STICK, respond
from vv.engines.dda.point.block import Block, Contact, Friction, Motion, Rule
from vv.engines.dda.point.energies import MOST, SOLVED
from vv.engines.kernels.compiled import inlined
from vv.engines.kernels.triples import NOWHERE, Triple, add_scaled, dot
from vv.scene import Vector


class Posed(NamedTuple):
    """The equations of a part of a step.

    inertia: 2 m/D^2 [N/m] of a part D [s]; outer: gravity, loads and shaking [N]; normal, tangent:
    the components of the right-hand side [N] with momentum; space: the gap [m] at the beginning;
    moved_n, moved_t: displacement of the wall [m].
    """

    inertia: float
    outer: Triple
    normal: float
    tangent: Triple
    space: float
    moved_n: float
    moved_t: Triple


class Solved(NamedTuple):
    """The result of an iteration.

    contact: the state that the solution calls for; used: the state with which it was solved; rub:
    friction [N] then; d_n, d_t: the displacement [m]; after: the gap [m]; slip: along the wall [m];
    wrong: error of friction [N]; ended: whether the iteration converged.
    """

    contact: Contact
    used: int
    rub: Triple
    d_n: float
    d_t: Triple
    after: float
    slip: Triple
    wrong: float
    ended: bool


@inlined
def equations_of(block: Block, motion: Motion, part: float, wall: Triple, shake: Triple) -> Posed:
    """The equations of a part of a step [s]; wall: its last displacement [m]; shake: [m/s2]."""
    normal, shift = block.normal, motion.shift
    moved = add_scaled(wall, -1.0, shift)
    space = block.gap + dot(normal, add_scaled(motion.x, -1.0, shift))
    c = 2.0 * block.mass / (part * part)
    outer = add_scaled(block.constant_load, block.mass, shake)
    f = add_scaled(outer, c * part, motion.v)
    f_n, moved_n = dot(f, normal), dot(moved, normal)
    f_t, moved_t = add_scaled(f, -f_n, normal), add_scaled(moved, -moved_n, normal)
    return Posed(c, outer, f_n, f_t, space, moved_n, moved_t)


@inlined
def iterate(
    part: Posed,
    initial: Contact,
    rule: Rule,
    block: Block,
    friction: Friction | None,
    worst: Vector,
) -> Solved:
    """Solve with an assumed state of contact until the solution calls for that state."""
    spring, wrong, ended = initial.spring, 0.0, False
    now, force, along = initial.state, initial.push, initial.direction
    for count in range(1, rule.iterations + 1):  # noqa: B007 - count is used below
        used = now
        d_n, d_t, rub = displacements_for(part, used, force, along, spring, block, friction)
        after = part.space + d_n - part.moved_n
        slip = add_scaled(d_t, -1.0, part.moved_t)
        assumed = Contact(used, 0.0, along, spring)
        ease = part.inertia / block.points
        now, force, along = required_state(assumed, after, slip, block.kn, friction, rule, ease)
        ended = now == used
        if friction is not None and used == SLIDE and now == SLIDE:
            off = add_scaled(add_scaled(NOWHERE, friction.mu * force, along), -1.0, rub)
            wrong = np.sqrt(dot(off, off))
            ended = ended and not wrong > rule.tolerance * friction.mu * force
        if ended:
            break
    worst[SOLVED] += count
    worst[MOST] = max(worst[MOST], count)
    return Solved(
        Contact(now, force, along, spring), used, rub, d_n, d_t, after, slip, wrong, ended
    )


@inlined
def displacements_for(
    part: Posed,
    used: int,
    force: float,
    along: Triple,
    spring: Triple,
    block: Block,
    friction: Friction | None,
) -> tuple[float, Triple, Triple]:
    """The displacements along the normal and the wall, and friction [N], for an assumed state."""
    points, c, f_t, rub = block.points, part.inertia, part.tangent, NOWHERE
    closed = points * block.kn if used != OPEN else 0.0
    d_n = (part.normal - closed * (part.space - part.moved_n)) / (c + closed)
    d_t = add_scaled(NOWHERE, 1.0 / c, f_t)
    if friction is not None:
        if used == STICK:
            pull = add_scaled(spring, -1.0, part.moved_t)
            held = add_scaled(f_t, -points * friction.ks, pull)
            d_t = add_scaled(NOWHERE, 1.0 / (c + points * friction.ks), held)
        elif used == SLIDE:
            rub = add_scaled(NOWHERE, friction.mu * force, along)
            d_t = add_scaled(NOWHERE, 1.0 / c, add_scaled(f_t, -points, rub))
    return d_n, d_t, rub


@inlined
def required_state(
    used: Contact,
    after: float,
    slip: Triple,
    kn: float,
    friction: Friction | None,
    rule: Rule,
    ease: float,
) -> tuple[int, float, Triple]:
    """The state, normal force and friction direction that a solution calls for; see `respond`."""
    state, spring, direction, converges = (
        used.state,
        used.spring,
        used.direction,
        rule.tolerance < np.inf,
    )
    if friction is None:
        return respond(
            state, after, slip, spring, direction, kn, None, None, rule.hold, ease, converges
        )
    ks, mu = friction.ks, friction.mu
    return respond(state, after, slip, spring, direction, kn, ks, mu, rule.hold, ease, converges)
