"""The compiled kernel of DDA for any number of blocks and walls."""

from __future__ import annotations

import numpy as np

from vv.engines.blocks.geometry import Index
from vv.engines.dda.general.augmented.forces import gap_rounding
from vv.engines.dda.general.augmented.multipliers import energy_of_fall
from vv.engines.dda.general.bodies import Motion, copy_motion, copy_rows, fill_masses
from vv.engines.dda.general.contact import Touch, close_initial, contact_arrays, find_contacts
from vv.engines.dda.general.energy import (
    FUNDS,
    KINETIC,
    LIMIT,
    NORMAL,
    PUT_IN,
    REPORTS,
    SHEAR,
    SPARE,
    STRAIN,
    TERMS,
)
from vv.engines.dda.general.rows import diverged, write_row
from vv.engines.dda.general.setting import Setting, Work
from vv.engines.dda.general.step import store_all, take_step
from vv.engines.dda.stepping import Steps
from vv.engines.kernels.arrays import (
    clear,
    counts,
    numbers,
    same_rows,
    square_of,
    table,
    zero_numbers,
    zero_rows,
    zero_table,
)
from vv.engines.kernels.compiled import called, compiled_to_branch, lent
from vv.scene import Vector


@compiled_to_branch
def move_blocks(
    path: Vector,
    energy: Vector,
    report: Vector,
    watched: Index,
    steps: Steps,
    setting: Setting,
    initial: Motion,
    motion: Motion,
) -> int:
    """Integrate the motion of all blocks by DDA; return the rows filled.

    Before t = 0 shaking and walls are at rest. initial: the motion at the start; motion: is set to
    that at the end.

    Every `steps.stride` steps a row is written: path (k, b, 21) of the observed blocks:
    displacement, velocity, strain tensor, force of contacts and shaking and its impulse since
    t = 0. The force is that of the step before the row; in the first row it is that of the first
    step. energy (k, 13) and report (k, 10): see `energy.py`.
    """
    bodies, done = setting.bodies, -steps.settling
    copy_motion(motion, initial)
    work = working_arrays(len(setting.planes.point), motion)
    touch = first_contacts(work, setting, motion)
    for row in range(len(path)):
        for _ in range(steps.stride if row > 0 else steps.settling):
            first = done == -steps.settling
            touch, fine = take_step(work, touch, setting, motion, done, steps.dt, first)
            if not fine:
                write_row(path[row], energy[row], report[row], watched, work, bodies, motion)
                return row
            done += 1
            if done == 1:
                fill_first_forces(path[0], watched, work)
        if row == 0:
            begin_ledger(work, motion)
        write_row(path[row], energy[row], report[row], watched, work, bodies, motion)
        if diverged(work.ledger, work.funds[LIMIT]):
            return row
    return len(path)


@lent
def fill_first_forces(path: Vector, watched: Index, work: Work) -> None:
    """Write the forces of the first step to the first row (b, 21), which has none of its own."""
    for b in range(len(watched)):
        for c in range(3):
            path[b, 15 + c] = work.pressed[watched[b], c]


@called
def working_arrays(walls: int, motion: Motion) -> Work:
    """The arrays of a run with so many walls, which begins with this motion."""
    q, n = len(motion.velocity), len(motion.centre)
    return Work(
        zero_rows(walls), zero_rows(walls), zero_rows(walls), zero_rows(1),
        zero_table(q, 12), counts(q), table(q, q), numbers(q), numbers(q),
        zero_numbers(q), zero_numbers(q), zero_numbers(q), zero_numbers(q),
        zero_numbers(q), zero_numbers(q), zero_numbers(q), zero_numbers(q),
        zero_numbers(TERMS), zero_numbers(REPORTS), zero_numbers(FUNDS),
        same_rows(motion.centre, n), zero_rows(n), zero_rows(n),
    )  # fmt: skip


@called
def first_contacts(work: Work, setting: Setting, motion: Motion) -> Touch:
    """The contacts at the start; fills masses, energies, and the limit of these."""
    none = contact_arrays(0 * len(work.shift))
    touch = find_contacts(none, setting, motion, work.shift)
    close_initial(touch, motion.strain, setting.law)
    fill_masses(work.mass, setting.bodies, motion)
    store_all(work, touch, setting, motion)
    work.funds[LIMIT] = np.inf
    # positions are rounded, and with them the gaps of springs
    rounded = 0.5 * setting.law.kn * square_of(gap_rounding(motion))
    work.funds[SPARE] = rounded * len(touch.key)
    if setting.choices.multipliers > 0:  # no energy in springs: allow for rounding of forces
        work.funds[SPARE] += energy_of_fall(setting.bodies, setting.reach)
    return touch


@lent
def begin_ledger(work: Work, motion: Motion) -> None:
    """Count displacements, impulses, works and losses from now on, t = 0."""
    ledger = work.ledger
    copy_rows(work.origin, motion.centre)
    clear(motion.rounded)
    clear(work.given)
    for term in range(STRAIN + 1, TERMS):
        ledger[term] = 0.0
    stored = ledger[KINETIC] + ledger[NORMAL] + ledger[SHEAR] + ledger[STRAIN]
    work.funds[PUT_IN] = stored
