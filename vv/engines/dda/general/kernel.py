"""The compiled kernel of DDA for any number of blocks and walls."""

from __future__ import annotations

import numpy as np

from vv.engines.blocks.geometry import Index, Planes, Shapes
from vv.engines.dda.general.assemble import apply_loads
from vv.engines.dda.general.augmented.multipliers import (
    add_multiplier_energies,
    energy_of_fall,
    iterate_multipliers,
)
from vv.engines.dda.general.augmented.reversal import turn_slide
from vv.engines.dda.general.bodies import (
    Bodies,
    Motion,
    centre_displacement,
    copy_motion,
    copy_rows,
    displace,
    fill_masses,
    only_shifts,
    times_blocks,
)
from vv.engines.dda.general.contact import Touch, close_initial, contact_arrays, find_contacts
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
    LOAD,
    NORMAL,
    NUMERICAL,
    REPORTS,
    SHAKING,
    SHEAR,
    SOLVED,
    STRAIN,
    TERMS,
    add_contact_energies,
    check_momentum,
    store_energies,
)  # fmt: skip
from vv.engines.dda.general.inertia import Rule, inertia_terms, part_to_stop, update_velocities
from vv.engines.dda.general.iterate import iterate
from vv.engines.dda.general.rows import diverged, fill_forces, write_row
from vv.engines.dda.general.turning import rotational_loads
from vv.engines.dda.limits import CUTS, GAIN, SOON
from vv.engines.dda.stepping import HALF_LEAP, IMPLICIT
from vv.engines.kernels.arrays import (
    clear,
    larger,
    same_counts,
    same_numbers,
    same_rows,
    zero_numbers,
    zero_rows,
    zero_table,
)
from vv.engines.kernels.compiled import called, compiled_to_branch, lent
from vv.engines.kernels.drive import Drive, Starts, one_of, travel, value
from vv.engines.kernels.triples import NOWHERE, add_scaled, at, dot, put
from vv.scene import Mask, Vector

FIRST: Rule = (IMPLICIT.alpha_m, IMPLICIT.alpha_f, IMPLICIT.beta, IMPLICIT.gamma)
# needs no accelerations at the start, and ends with those of its forces
HALF: Rule = (HALF_LEAP.alpha_m, HALF_LEAP.alpha_f, HALF_LEAP.beta, HALF_LEAP.gamma)


@called
def move_walls(
    ahead: Vector, moved: Vector, shift: Vector, base: Drive, starts: Starts, time: float,
    share: float,
) -> None:  # fmt: skip
    """Fill ahead (w, 3): displacements of walls at a time [s]; moved: share of their change."""
    for wall in range(len(shift)):
        put(ahead, wall, travel(one_of(base, starts, wall), time))
        step = add_scaled(at(ahead, wall), -1.0, at(shift, wall))
        put(moved, wall, add_scaled(NOWHERE, share, step))


@lent
def restore_states(touch: Touch, state: Index, push: Vector, direction: Vector) -> None:
    """Restore the states of contacts after an iteration that did not converge."""
    for k in range(len(touch.key)):
        touch.state[k], touch.push[k] = state[k], push[k]
        put(touch.direction, k, at(direction, k))


@compiled_to_branch
def move_blocks(  # noqa: PLR0912, PLR0915 - one loop, whose parts share all its variables
    path: Vector,
    energy: Vector,
    report: Vector,
    watched: Index,
    stride: int,
    dt: float,
    settling: int,
    tolerance: float,
    iterations: int,
    newton: int,
    rule: Rule,
    shaking_at: float,
    terms: int,
    turns: int,
    follow: int,
    dd: float,
    hold: float,
    multipliers: int,
    bodies: Bodies,
    initial: Motion,
    motion: Motion,
    shapes: Shapes,
    moves: Mask,
    planes: Planes,
    base: Drive,
    starts: Starts,
    shaking: Drive,
    depth: Vector,
    reach: float,
    kn: float,
    ks: float,
    mu: float,
    elastic: Vector,
) -> int:
    """Integrate the motion of all blocks by DDA; return the rows filled.

    settling: steps before t = 0, with shaking and walls at rest; rule: of all steps but the first,
    which has DDA's own; tolerance, iterations, newton, shaking_at, terms, turns, follow, dd,
    multipliers: see `Formulation`; hold: 1 where its `charged` is true, else 0; initial: the motion
    at the start; motion: is set to that at the end; base, starts: see `drives`; shaking: an
    acceleration of all bodies; kn, ks [N/m] and mu of each contact point; reach [m]: see
    `find_contacts`; elastic: (q, 12) stiffness of strains [N m], laid out as `fill_masses`.

    Every `stride` steps a row is written: path (k, b, 21) of the observed blocks: displacement,
    velocity, strain tensor, force of contacts and shaking and its impulse since t = 0. The force is
    that of the step before the row; in the first row it is that of the first step. energy (k, 13)
    and report (k, 9): see `energy.py`. It is one function since all parts of a step share its
    variables.
    """
    walls, q = len(planes.point), len(initial.velocity)
    shift, ahead, moved = zero_rows(walls), zero_rows(walls), zero_rows(walls)
    mass, outer, flow = zero_table(q, 12), zero_numbers(q), zero_numbers(q)
    d, pull, turn = zero_numbers(q), zero_numbers(q), zero_numbers(q)
    u, predictor, rate = zero_numbers(q), zero_numbers(q), zero_numbers(q)
    now = FIRST if multipliers == 0 else HALF
    # for generalised alpha, the first step must end with the acceleration at its end
    shaken_at = shaking_at if rule[1] == 0.0 else 1.0
    store, stores = (kn, ks) if multipliers == 0 else (0.0, 0.0)
    alone, shifts = len(bodies.mass) == 1, only_shifts(bodies)
    locates = (alone or shifts) and multipliers == 0 and rule[1] == 0.0 and tolerance < np.inf
    turns_back = alone and shifts and multipliers > 0 and ks > 0.0
    ledger, worst, done = zero_numbers(TERMS), zero_numbers(REPORTS), -settling
    put_in, ever, most, spare = 0.0, 0.0, np.inf, 0.0
    if multipliers > 0:  # no energy in springs: allow for rounding
        spare = energy_of_fall(bodies, reach)
    copy_motion(motion, initial)
    touch = find_contacts(
        contact_arrays(0 * walls), bodies, motion, shapes, moves, planes, shift, depth, reach
    )
    close_initial(touch, motion.strain, kn, ks, mu, hold)
    fill_masses(mass, bodies, motion)
    store_energies(ledger, touch, bodies, motion, mass, store, stores, elastic)
    origin = same_rows(motion.centre, len(motion.centre))
    pressed, given = zero_rows(len(origin)), zero_rows(len(origin))

    for row in range(len(path)):
        for _ in range((stride if row else 0) + (settling if row == 0 else 0)):
            begin, part, uneven = 0.0, dt, False
            while begin < dt:
                shake, share = NOWHERE, 1.0 - now[1]
                if done >= 0:
                    move_walls(ahead, moved, shift, base, starts, done * dt + begin + part, share)
                    shake = value(shaking, done * dt + begin + shaken_at * part)
                weight = inertia_terms(predictor, motion.velocity, rate, now, part)
                count = len(touch.key)
                state, push = same_counts(touch.state, count), same_numbers(touch.push, count)
                direction = same_rows(touch.direction, count)
                apply_loads(outer, bodies, shake)
                rotational_loads(turn, bodies, motion, mass, elastic, part, terms, turns)
                for a in range(q):
                    outer[a] += turn[a]
                if multipliers == 0:
                    ended, solved, used, rub, relative = iterate(
                        u, touch, bodies, motion, mass, outer, moved, predictor, part, weight,
                        kn, ks, mu, hold, tolerance, iterations, newton, elastic,
                    )  # fmt: skip
                else:
                    spring = same_rows(touch.spring, count)
                    ended, solved, used, rub, relative = iterate_multipliers(
                        u, touch, bodies, motion, mass, outer, moved, predictor, part, weight,
                        kn, ks, mu, hold, tolerance, iterations, newton, elastic, multipliers,
                    )  # fmt: skip
                worst[SOLVED] += solved
                worst[ITERATIONS] = larger(worst[ITERATIONS], float(solved))
                if not ended and part > dt / CUTS:
                    restore_states(touch, state, push, direction)
                    if multipliers > 0:
                        copy_rows(touch.spring, spring)
                    part *= 0.5
                    worst[CUT] += 1
                    continue
                if locates:
                    time = done * dt + begin
                    to_stop = part_to_stop(
                        touch, state, direction, motion, relative, base, starts, time, part
                    )
                    if to_stop * part > SOON * dt and to_stop < 1.0 - SOON:
                        restore_states(touch, state, push, direction)
                        part, uneven = to_stop * part, True
                        continue
                if turns_back and ended:
                    turn_slide(
                        u, touch, state, direction, used, rub, relative, bodies, motion, base,
                        starts, done * dt + begin, part, ks, mu,
                    )  # fmt: skip
                worst[FAILED] += 0 if ended else 1
                over = 1.0 / share
                if multipliers == 0:
                    add_contact_energies(
                        ledger, worst, pull, touch, used, rub, relative, moved, over, kn, ks, mu,
                        hold,
                    )  # fmt: skip
                else:
                    add_multiplier_energies(
                        ledger, worst, pull, touch, used, rub, relative, moved, ks, mu
                    )
                fill_forces(pressed, given, touch, bodies, shake, part)
                check_momentum(
                    worst, pull, outer, u, predictor, part, weight, bodies, motion, mass, elastic
                )
                for a in range(q):
                    d[a] = over * u[a]
                for i in range(len(bodies.mass)):
                    line = centre_displacement(bodies, i, d)
                    ledger[GRAVITY] += dot(line, at(bodies.weight, i))
                    ledger[LOAD] += dot(line, at(bodies.load, i))
                    ledger[SHAKING] += bodies.mass[i] * dot(line, shake)
                ledger[NUMERICAL] += (0.5 - now[1]) * times_blocks(flow, elastic, bodies, d)
                ledger[NUMERICAL] += update_velocities(
                    motion.velocity, rate, d, mass, bodies, now, part
                )
                now, shaken_at = rule, shaking_at
                if multipliers > 0:  # accelerations of impacts do not act in the next step
                    for a in range(q):
                        rate[a] = 0.0
                displace(motion, bodies, shapes, d, terms, follow)
                store_energies(ledger, touch, bodies, motion, mass, store, stores, elastic)
                if row > 0:
                    works = ledger[GRAVITY] + ledger[LOAD] + ledger[BASE] + ledger[SHAKING]
                    ever = larger(ever, works)
                    most = GAIN * (put_in + ever) + spare
                if diverged(ledger, most):  # contacts of diverged blocks cannot be detected
                    write_row(path[row], energy[row], report[row], watched, origin,
                         bodies, motion, pressed, given, ledger, worst)  # fmt: skip
                    return row
                ledger[DAMPED] += (1.0 - dd * dd) * ledger[KINETIC]
                for a in range(q):
                    motion.velocity[a] *= dd
                kept = dd * dd * ledger[KINETIC] + ledger[NORMAL] + ledger[SHEAR]
                for a in range(q):  # inertia also changes with the new positions
                    kept -= turn[a] * d[a]
                copy_rows(shift, ahead)
                touch = find_contacts(
                    touch, bodies, motion, shapes, moves, planes, shift, depth, reach
                )
                fill_masses(mass, bodies, motion)
                store_energies(ledger, touch, bodies, motion, mass, store, stores, elastic)
                anew = ledger[KINETIC] + ledger[NORMAL] + ledger[SHEAR] - kept
                ledger[FOUND] += anew
                ledger[CREATED] += larger(0.0, anew)
                begin += part
                if uneven:
                    part, uneven = dt - begin, False
                if begin + part > dt * (1.0 + 1e-12) or part < SOON * SOON * dt:
                    begin = dt
            done += 1
            if done == 1:
                for b in range(len(watched)):
                    for c in range(3):
                        path[0, b, 15 + c] = pressed[watched[b], c]
        if row == 0:
            copy_rows(origin, motion.centre)
            clear(motion.rounded)
            clear(given)
            for term in range(STRAIN + 1, TERMS):
                ledger[term] = 0.0
            put_in = ledger[KINETIC] + ledger[NORMAL] + ledger[SHEAR] + ledger[STRAIN]
        write_row(
            path[row], energy[row], report[row], watched, origin, bodies, motion, pressed, given,
            ledger, worst,
        )  # fmt: skip
        if diverged(ledger, most):
            return row
    return len(path)
