"""A step of DDA for any number of blocks and walls, taken in parts where need be; kernels.

Energies are compared with the funds of a run [J]: what was put in at t = 0, the most that loads and
walls have worked since, a spare for rounding, and the limit beyond which the run has diverged.
"""

from __future__ import annotations

import numpy as np

from vv.engines.dda.general.assemble import apply_loads
from vv.engines.dda.general.augmented.multipliers import (
    add_multiplier_energies,
    iterate_multipliers,
)
from vv.engines.dda.general.augmented.reversal import turn_slide
from vv.engines.dda.general.bodies import (
    Motion,
    centre_displacement,
    copy_rows,
    displace,
    fill_masses,
    only_shifts,
    times_blocks,
)
from vv.engines.dda.general.contact import Touch, find_contacts, restore_states, states_of
from vv.engines.dda.general.energy import (
    BASE,
    CREATED,
    CUT,
    DAMPED,
    FAILED,
    FOUND,
    GRAVITY,
    ITERATIONS,
    KINETIC,
    LIMIT,
    LOAD,
    NORMAL,
    NUMERICAL,
    PUT_IN,
    QUICKEST,
    SHAKING,
    SHEAR,
    SOLVED,
    SPARE,
    WORKED,
    add_contact_energies,
    check_momentum,
    store_energies,
)  # fmt: skip
from vv.engines.dda.general.inertia import inertia_terms, part_to_stop, update_velocities
from vv.engines.dda.general.iterate import iterate
from vv.engines.dda.general.rows import diverged, fill_forces
from vv.engines.dda.general.setting import Part, Rule, Setting, Trial, Work
from vv.engines.dda.general.turning import rotational_loads
from vv.engines.dda.limits import CUTS, GAIN, SOON
from vv.engines.dda.stepping import HALF_LEAP, IMPLICIT
from vv.engines.kernels.arrays import larger
from vv.engines.kernels.compiled import called, lent
from vv.engines.kernels.drive import one_of, travel, value
from vv.engines.kernels.triples import NOWHERE, add_scaled, at, dot, put

FIRST: Rule = (IMPLICIT.alpha_m, IMPLICIT.alpha_f, IMPLICIT.beta, IMPLICIT.gamma)
# needs no accelerations at the start, and ends with those of its forces
HALF: Rule = (HALF_LEAP.alpha_m, HALF_LEAP.alpha_f, HALF_LEAP.beta, HALF_LEAP.gamma)


@called
def take_step(
    work: Work, touch: Touch, setting: Setting, motion: Motion, done: int, dt: float, first: bool
) -> tuple[Touch, bool]:
    """Move all blocks by a step of dt [s]; return their contacts then, and False if it diverges.

    done: the steps since t = 0, negative while walls are at rest; first: of the run. A part that
    does not converge is halved, and one ends where a slide stops.
    """
    start, begin, length, uneven = done * dt, 0.0, dt, False
    while begin < dt:
        part = begin_part(work, setting, motion, start + begin, length, first and begin == 0.0)
        before = states_of(touch)
        ended, trial = solve_part(work, touch, setting, motion, part)
        if not ended and length > dt / CUTS:
            restore_states(touch, before)
            length *= 0.5
            work.worst[CUT] += 1
            continue
        if locates(setting):
            to_stop = part_to_stop(touch, before, trial.relative, setting, motion, part)
            if to_stop * length > SOON * dt and to_stop < 1.0 - SOON:
                restore_states(touch, before)
                length, uneven = to_stop * length, True
                continue
        if ended and turns_back(setting):
            turn_slide(work.u, touch, before, trial, setting, motion, part)
        work.worst[FAILED] += 0 if ended else 1
        book_part(work, touch, trial, setting, motion, part)
        work.ledger[NUMERICAL] += update_velocities(
            motion.velocity, work.rate, work.d, work.mass, setting.bodies, part.rule, length
        )
        if not displaced(work, touch, setting, motion, done >= 0):
            return touch, False  # contacts of diverged blocks cannot be detected
        touch = contacts_after(work, touch, setting, motion)
        begin += length
        if uneven:
            length, uneven = dt - begin, False
        if begin + length > dt * (1.0 + 1e-12) or length < SOON * SOON * dt:
            begin = dt
    return touch, True


@lent
def locates(setting: Setting) -> bool:
    """Whether parts of steps end where slides stop: springs, and one block or only shifts."""
    choices, bodies = setting.choices, setting.bodies
    ends = choices.multipliers == 0 and choices.rule[1] == 0.0 and choices.tolerance < np.inf
    return ends and (len(bodies.mass) == 1 or only_shifts(bodies))


@lent
def turns_back(setting: Setting) -> bool:
    """Whether slides may turn within a part of a step, see `turn_slide`."""
    alone = setting.choices.multipliers > 0 and setting.law.ks > 0.0
    return alone and len(setting.bodies.mass) == 1 and only_shifts(setting.bodies)


@called
def begin_part(
    work: Work, setting: Setting, motion: Motion, time: float, length: float, first: bool
) -> Part:
    """Fill what a part of a step is solved with; first: of the run, which has a rule of its own."""
    choices, rule = setting.choices, setting.choices.rule
    shaken_at = choices.shaking_at
    if first:  # for generalised alpha, it must end with the acceleration at its end
        shaken_at = shaken_at if rule[1] == 0.0 else 1.0
        rule = FIRST if choices.multipliers == 0 else HALF
    shake = NOWHERE
    if time >= 0.0:
        move_walls(work, setting, time + length, 1.0 - rule[1])
        shake = value(setting.shaking, time + shaken_at * length)
    put(work.shake, 0, shake)
    weight = inertia_terms(work.predictor, motion.velocity, work.rate, rule, length)
    apply_loads(work.outer, setting.bodies, shake)
    rotational_loads(
        work.turn, setting.bodies, motion, work.mass, setting.elastic, length, choices.terms,
        choices.turns,
    )  # fmt: skip
    for a in range(len(work.outer)):
        work.outer[a] += work.turn[a]
    return Part(time, length, rule, weight)


@called
def move_walls(work: Work, setting: Setting, time: float, share: float) -> None:
    """Fill `ahead`: displacements of walls at a time [s], and `moved`: a share of their change."""
    for wall in range(len(work.shift)):
        put(work.ahead, wall, travel(one_of(setting.base, setting.starts, wall), time))
        step = add_scaled(at(work.ahead, wall), -1.0, at(work.shift, wall))
        put(work.moved, wall, add_scaled(NOWHERE, share, step))


@called
def solve_part(
    work: Work, touch: Touch, setting: Setting, motion: Motion, part: Part
) -> tuple[bool, Trial]:
    """Solve a part of a step; return whether the iteration converged, and its last solution."""
    if setting.choices.multipliers == 0:
        ended, count, trial = iterate(touch, work, setting, motion, setting.law, part)
    else:
        ended, count, trial = iterate_multipliers(touch, work, setting, motion, part)
    work.worst[SOLVED] += count
    work.worst[ITERATIONS] = larger(work.worst[ITERATIONS], float(count))
    return ended, trial


@called
def book_part(
    work: Work, touch: Touch, trial: Trial, setting: Setting, motion: Motion, part: Part
) -> None:
    """Add works and losses of a part of a step to the ledger; set the displacements `work.d`."""
    ledger, bodies, d, shake = work.ledger, setting.bodies, work.d, at(work.shake, 0)
    over = 1.0 / (1.0 - part.rule[1])
    if setting.choices.multipliers == 0:
        add_contact_energies(work, touch, trial, over, setting.law)
    else:
        add_multiplier_energies(work, touch, trial, setting.law)
    fill_forces(work.pressed, work.given, touch, bodies, shake, part.length)
    check_momentum(work, setting, motion, part)
    for a in range(len(d)):
        d[a] = over * work.u[a]
    for i in range(len(bodies.mass)):
        line = centre_displacement(bodies, i, d)
        ledger[GRAVITY] += dot(line, at(bodies.weight, i))
        ledger[LOAD] += dot(line, at(bodies.load, i))
        ledger[SHAKING] += bodies.mass[i] * dot(line, shake)
    strained = times_blocks(work.flow, setting.elastic, bodies, d)
    ledger[NUMERICAL] += (0.5 - part.rule[1]) * strained


@called
def displaced(
    work: Work, touch: Touch, setting: Setting, motion: Motion, since_start: bool
) -> bool:
    """Displace all blocks by `work.d`; return whether the energy is within the limit."""
    ledger, funds, choices = work.ledger, work.funds, setting.choices
    if choices.multipliers > 0:  # accelerations of impacts do not act in the next step
        for a in range(len(work.rate)):
            work.rate[a] = 0.0
    displace(motion, setting.bodies, setting.shapes, work.d, choices.terms, choices.follow)
    store_all(work, touch, setting, motion)
    if since_start:
        work.worst[QUICKEST] = larger(work.worst[QUICKEST], ledger[KINETIC])
        works = ledger[GRAVITY] + ledger[LOAD] + ledger[BASE] + ledger[SHAKING]
        funds[WORKED] = larger(funds[WORKED], works)
        funds[LIMIT] = GAIN * (funds[PUT_IN] + funds[WORKED]) + funds[SPARE]
    return not diverged(ledger, funds[LIMIT])


@called
def contacts_after(work: Work, touch: Touch, setting: Setting, motion: Motion) -> Touch:
    """Damp velocities and find contacts anew; book what energy is lost and created by both."""
    ledger, dd = work.ledger, setting.choices.dd
    ledger[DAMPED] += (1.0 - dd * dd) * ledger[KINETIC]
    kept = dd * dd * ledger[KINETIC] + ledger[NORMAL] + ledger[SHEAR]
    for a in range(len(motion.velocity)):  # inertia also changes with the new positions
        motion.velocity[a] *= dd
        kept -= work.turn[a] * work.d[a]
    copy_rows(work.shift, work.ahead)
    found = find_contacts(touch, setting, motion, work.shift)
    fill_masses(work.mass, setting.bodies, motion)
    store_all(work, found, setting, motion)
    anew = ledger[KINETIC] + ledger[NORMAL] + ledger[SHEAR] - kept
    ledger[FOUND] += anew
    ledger[CREATED] += larger(0.0, anew)
    return found


@called
def store_all(work: Work, touch: Touch, setting: Setting, motion: Motion) -> None:
    """Store present energies in the ledger; contacts with multipliers store none."""
    kn, ks = setting.law.kn, setting.law.ks
    if setting.choices.multipliers > 0:
        kn, ks = 0.0, 0.0
    store_energies(work.ledger, touch, setting.bodies, motion, work.mass, kn, ks, setting.elastic)
