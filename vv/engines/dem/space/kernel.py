"""The compiled kernel of the general model: the leapfrog with the forces of all terms."""

from __future__ import annotations

from vv.engines.dem.limits import BLOW_UP, GAIN
from vv.engines.dem.rows import Index
from vv.engines.dem.space.bodies import Bodies
from vv.engines.dem.space.forces import add_viscous, forces
from vv.engines.dem.space.hooks import Terms, after, begin, move, start, withdraw
from vv.engines.dem.space.neighbours import (
    Near,
    moved_far,
    no_slots,
    search_pairs,
    store_displacements,
)
from vv.engines.dem.space.output import (
    kinetic_energy,
    kinetic_energy_after,
    observe,
    write_energies,
)
from vv.engines.dem.space.room import allocate, zero_rows
from vv.engines.dem.space.steps import drift, kick, kick_spins, place, place_spins
from vv.engines.kernels.arrays import larger, zero_counts
from vv.engines.kernels.compiled import compiled_to_branch
from vv.scene import Vector

START, STEP, END = 0, 1, 2  # stages of viscous forces: those at t = 0, then those of a step


@compiled_to_branch
def move_in_space(
    path: Vector,
    energy: Vector,
    watched: Index,
    stride: int,
    dt: float,
    given: Bodies,
    terms: Terms,
    near: Near | None,
    lag: float,
    back: float,
) -> int:
    """Integrate m u'' = forces, I w' = torques of all terms by the leapfrog; return rows filled.

    given: the spheres; terms: see `vv.engines.dem.space.hooks`; near: data of the neighbour search
    (`neighbours.py`), or None. Viscous forces act on lag v- + (1 - lag) v+: with 1/2 at the
    midpoint, with 1 on the previous mean velocity. back: by how many dt before t = 0 the first
    velocity is set.

    Every `stride` steps a row is written of path (k, b, 6, 9 or 12) and energy (k, 7, 9 or 12): see
    `output.py`. The loop ends before a later row if energy was created (vv.engines.dem.limits). It
    is one function since the hooks must be called in one place, to be compiled once.
    """
    bodies, motion = allocate(given)
    m = len(bodies.mass)
    slots, many, since = no_slots(), zero_counts(1), zero_rows(m)
    begin(terms, bodies, motion)
    put_in = ahead = slipped = dragged = moved = done = 0.0
    normal = sprung = 0.0

    # the state at t = 0 is the first pass of the loop, so that each force is compiled only once
    steps = -1
    for row in range(len(path)):
        for _ in range(stride if row else 1):
            steps += 1
            if steps:
                drift(motion, m, dt)
                move(terms, bodies, motion, steps * dt, dt)
            if near is not None and (steps == 0 or moved_far(motion, since, near)):
                store_displacements(since, motion.u)
                slots = search_pairs(near, motion.u, slots, many)
            normal, sprung, lost, work = forces(terms, bodies, motion, dt, slots, many)
            if steps:
                slipped += lost
                moved += work
            else:
                start(terms, bodies, motion, dt)
            slowed = 0.0, 0.0
            for stage in range(START if steps == 0 else STEP, END):
                span = 0.0 if stage == START else dt
                slowed = add_viscous(terms, bodies, motion, span, slots, many, lag)
                if stage == START or steps:
                    after(terms, bodies, motion, span)
                if stage == START:
                    put_in = normal + sprung + place(terms, bodies, motion, back * dt)
                    put_in += place_spins(motion.w, bodies.spin, motion.turn, bodies, back * dt)
                    withdraw(terms, bodies, motion, slots, many)
            dragged += ahead
            behind, ahead = kick(terms, bodies, motion, dt, lag, slowed)
            if steps:
                dragged += behind
            kick_spins(motion.w, motion.spun, motion.turn, bodies, dt)

        observe(path, row, watched, terms, bodies, motion)
        kinetic = kinetic_energy(bodies, motion)
        held = kinetic, normal, sprung, slipped, 0.5 * dt * dragged
        done = larger(done, write_energies(energy, row, terms, bodies, motion, held, moved))
        most, total = put_in + done, kinetic + normal + sprung
        fastest = kinetic_energy_after(bodies, motion)
        if row and not (total <= GAIN * most and fastest <= BLOW_UP * most):
            return row
    return len(path)
