"""The compiled kernel of DDA for one block that cannot rotate, on a wall: at most 3 unknowns."""

from __future__ import annotations

import numpy as np

from vv.engines.dda.law import OPEN, SLIDE, STICK, share_to_stop
from vv.engines.dda.limits import CUTS, GAIN, SOON
from vv.engines.dda.point.block import Block, Contact, Drives, Friction, Motion, Rule
from vv.engines.dda.point.energies import (
    CARRIED,
    CUT,
    DEEPEST,
    ENERGIES,
    EXCESS,
    FAILED,
    FALLEN,
    PEAK,
    RESIDUAL,
    SHAKEN,
    WORKED,
    add_normal_energies,
    add_opening_energies,
    add_slip_energies,
    add_stick_energies,
    add_works,
    check_momentum,
    write_row,
)
from vv.engines.dda.point.iteration import Posed, Solved, equations_of, iterate
from vv.engines.dda.stepping import Steps
from vv.engines.kernels.arrays import zero_numbers
from vv.engines.kernels.compiled import compiled, inlined
from vv.engines.kernels.drive import rate, travel, value
from vv.engines.kernels.triples import NOWHERE, Triple, add_scaled, dot
from vv.scene import Vector


@compiled
def slide_point(
    path: Vector,
    energy: Vector,
    report: Vector,
    steps: Steps,
    rule: Rule,
    velocity: Triple,
    pressed: bool,
    block: Block,
    friction: Friction | None,
) -> int:
    """Integrate m d'' = m (gravity + shaking) + load + contact by DDA; return the rows filled.

    pressed: whether contact carries the loads at t = 0. d'' = (2/D^2)(d - D v0), v = (2/D) d - v0
    (Yagoda-Biran 2016, Eq. 5 corrected). Rows are those of `move_blocks`: path (k, 6), energy (k,
    13), report (k, 9). It is one function since half of it is the loop, the other half arguments
    and rows.
    """
    motion = Motion(NOWHERE, NOWHERE, velocity, NOWHERE)
    contact = Contact(OPEN, 0.0, NOWHERE, NOWHERE)
    if pressed:
        x, contact = at_rest(block, friction, rule.hold)
        motion = Motion(x, NOWHERE, velocity, NOWHERE)
    spent, worst = zero_numbers(ENERGIES), zero_numbers(PEAK + 1)
    origin, put_in, ever, done = motion.x, 0.0, 0.0, -steps.settling
    for row in range(len(path)):
        for _ in range(steps.stride if row else steps.settling):
            motion, contact = step_block(
                motion, contact, done, steps.dt, rule, block, friction, spent, worst
            )
            done += 1
        if row == 0:
            origin = motion.x
            for k in range(ENERGIES):
                spent[k] = 0.0
        held = write_row(path, energy, row, block, motion, origin, contact, friction, spent)
        for k in range(len(worst)):
            report[row, k] = worst[k]
        if row == 0:
            put_in = held
        ever = max(ever, spent[FALLEN] + spent[WORKED] + spent[CARRIED] + spent[SHAKEN])
        if not held <= GAIN * (put_in + ever):
            return row
    return len(path)


@inlined
def at_rest(block: Block, friction: Friction | None, hold: float) -> tuple[Triple, Contact]:
    """The displacement and contact state in which contact carries the loads; zero if none presses.

    hold: the fraction of friction with which the tangential spring is charged.
    """
    normal, points, spring = block.normal, block.points, NOWHERE
    pull = block.constant_load
    push = max(0.0, -dot(pull, normal)) / points
    if not push > 0.0:
        return NOWHERE, Contact(OPEN, push, NOWHERE, NOWHERE)
    x, state = add_scaled(NOWHERE, -block.gap - push / block.kn, normal), SLIDE
    if friction is not None:
        state = STICK
        pull = add_scaled(pull, -dot(pull, normal), normal)
        size = np.sqrt(dot(pull, pull)) / points
        part = 1.0 if size <= friction.mu * push else friction.mu * push / size
        spring = add_scaled(NOWHERE, hold * part / (points * friction.ks), pull)
    return x, Contact(state, push, NOWHERE, spring)


@inlined
def step_block(
    motion: Motion,
    contact: Contact,
    done: int,
    dt: float,
    rule: Rule,
    block: Block,
    friction: Friction | None,
    spent: Vector,
    worst: Vector,
) -> tuple[Motion, Contact]:
    """The motion and contact after a step, which is divided where iterations do not converge.

    It is also divided where a slide stops, so that friction does not act on beyond that. It is one
    function since a part is begun anew from two places.
    """
    begin, part, uneven = 0.0, dt, False
    while begin < dt:
        time = done * dt + begin
        wall, shake = wall_and_shaking(block.drives, done, time, part, rule.shaking_at)
        given = equations_of(block, motion, part, wall, shake)
        found = iterate(given, contact, rule, block, friction, worst)
        if not found.ended and part > dt / CUTS:
            part = 0.5 * part
            worst[CUT] += 1.0
            continue
        d = add_scaled(found.d_t, found.d_n, block.normal)
        new = add_scaled(add_scaled(NOWHERE, 2.0 / part, d), -1.0, motion.v)
        if friction is not None and contact.state == SLIDE and rule.tolerance < np.inf:
            ahead = part * dot(new, contact.direction)
            ahead -= most_of_wall(block.drives, part, given.moved_t, contact.direction)
            if ahead < 0.0:  # it may slide back at the end
                share = part_to_stop(block.drives, done, time, part, motion, contact, found.slip)
                if share * part > SOON * dt and share < 1.0 - SOON:
                    part, uneven = share * part, True
                    continue
        worst[FAILED] += 0.0 if found.ended else 1.0
        contact, pull, held = add_contact_energies(
            given, found, rule.hold, block, friction, spent, worst
        )
        c = given.inertia
        gain = add_scaled(add_scaled(NOWHERE, c, d), -c * part, motion.v)
        check_momentum(worst, gain, given.outer, pull, held)
        worst[DEEPEST] = max(worst[DEEPEST], -found.after)
        add_works(spent, block, rule.dd, d, new, shake)
        motion = displaced_motion(motion, d, add_scaled(NOWHERE, rule.dd, new), wall)
        begin += part
        if uneven:
            part, uneven = dt - begin, False
        if begin + part > dt * (1.0 + 1e-12) or part < SOON * SOON * dt:
            begin = dt
    return motion, contact


@inlined
def most_of_wall(drives: Drives | None, part: float, moved: Triple, direction: Triple) -> float:
    """The most that the velocity of the wall may be at the end of a part, times the part [m].

    moved: its displacement in the part [m], from which it differs by its acceleration.
    """
    if drives is None:
        return 0.0
    return dot(moved, direction) + 0.5 * part * part * drives.most


@inlined
def part_to_stop(
    drives: Drives | None,
    done: int,
    time: float,
    part: float,
    motion: Motion,
    contact: Contact,
    slip: Triple,
) -> float:
    """The fraction of a part of a step [s] after which the slide stops that it begins with, or 1.

    time: at its beginning [s]; contact: then; slip: along the wall in this part [m].
    """
    speed = motion.v
    if drives is not None and done >= 0:
        speed = add_scaled(speed, -1.0, rate(drives.base, time))
    return share_to_stop(part * dot(speed, contact.direction), dot(slip, contact.direction))


@inlined
def wall_and_shaking(
    drives: Drives | None, done: int, time: float, part: float, shaking_at: float
) -> tuple[Triple, Triple]:
    """The displacement of the wall [m] at the end of a part of a step [s], and the shaking [m/s2].

    time: at the beginning of the part [s]; shaking_at: the fraction of it at which shaking is
    evaluated. Both are zero in steps before t = 0.
    """
    wall, shake = NOWHERE, NOWHERE
    if drives is not None and done >= 0:
        wall, shake = (
            travel(drives.base, time + part),
            value(drives.shaking, time + shaking_at * part),
        )
    return wall, shake


@inlined
def add_contact_energies(
    part: Posed,
    found: Solved,
    hold: float,
    block: Block,
    friction: Friction | None,
    spent: Vector,
    worst: Vector,
) -> tuple[Contact, Triple, float]:
    """Add the energies of contact; return its new state, its force and its normal force [N]."""
    used, now, points, spring = found.used, found.contact, block.points, found.contact.spring
    held = add_normal_energies(spent, block, used, part.space, found.after, part.moved_n)
    pull = add_scaled(NOWHERE, points * held, block.normal)
    if friction is not None:
        ks, rub, rubs = friction.ks, found.rub, add_scaled(NOWHERE, -1.0, found.rub)
        if used == STICK:
            spring = add_stick_energies(spent, spring, found.slip, part.moved_t, points, ks)
            rubs = add_scaled(NOWHERE, -ks, spring)
        elif used == SLIDE:
            spring = add_slip_energies(
                spent, spring, found.slip, part.moved_t, rub, block, ks, hold
            )
            if now.state == SLIDE:
                worst[RESIDUAL] = max(worst[RESIDUAL], found.wrong)
        else:
            spring = add_opening_energies(spent, spring, points, ks)
        pull = add_scaled(pull, points, rubs)
        beyond = np.sqrt(dot(rubs, rubs)) - friction.mu * max(held, 0.0)
        worst[EXCESS] = max(worst[EXCESS], beyond)
    return Contact(now.state, now.push, now.direction, spring), pull, held


@inlined
def displaced_motion(motion: Motion, d: Triple, v: Triple, wall: Triple) -> Motion:
    """The motion after a displacement d [m], with velocity v and the wall's displacement."""
    owed = add_scaled(d, -1.0, motion.rounded)
    there = add_scaled(motion.x, 1.0, owed)
    rounded = add_scaled(add_scaled(there, -1.0, motion.x), -1.0, owed)
    return Motion(there, rounded, v, wall)
