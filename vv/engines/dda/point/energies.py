"""The energy ledger of the reduced model, and the largest errors of a step; parts of its kernel.

Energies [J] and errors have the columns of the results of `move_blocks`.
"""

from __future__ import annotations

import numpy as np

from vv.engines.dda.law import OPEN
from vv.engines.dda.point.block import Block, Contact, Friction, Motion
from vv.engines.kernels.compiled import inlined
from vv.engines.kernels.triples import NOWHERE, Triple, add_scaled, dot
from vv.scene import Vector

KINETIC, NORMAL, SHEAR = 0, 1, 2
RUBBED, LOST, DAMPED, FALLEN, WORKED, CARRIED, SHAKEN, CREATED = 4, 5, 6, 7, 8, 9, 10, 12
ENERGIES = 13
RESIDUAL, MOST, DEEPEST, CUT, FAILED, SOLVED, EXCESS, ADRIFT, PEAK = range(9)


@inlined
def add_normal_energies(
    spent: Vector, block: Block, used: int, before: float, after: float, moved: float
) -> float:
    """Add the energies of the normal spring in a part of a step; return its force [N].

    used: the state of contact; before, after: the gap [m]; moved: of the wall along the normal [m].
    """
    points, kn = block.points, block.kn
    first, last = max(-before, 0.0), max(-after, 0.0)
    held = -kn * after if used != OPEN else 0.0
    left = 0.5 * kn * (first * first - last * last) - held * (after - before)
    spent[LOST] += points * left
    spent[CREATED] += max(0.0, -points * left)
    spent[CARRIED] += points * held * moved
    return held


@inlined
def add_stick_energies(
    spent: Vector, spring: Triple, slip: Triple, moved: Triple, points: int, ks: float
) -> Triple:
    """Add the energies of a tangential spring that sticks; return its new stretch [m]."""
    old = 0.5 * points * ks * dot(spring, spring)
    spring = add_scaled(spring, 1.0, slip)
    spent[LOST] += points * ks * dot(spring, slip)
    spent[LOST] += old - 0.5 * points * ks * dot(spring, spring)
    spent[CARRIED] -= points * ks * dot(spring, moved)
    return spring


@inlined
def add_slip_energies(
    spent: Vector,
    spring: Triple,
    slip: Triple,
    moved: Triple,
    rub: Triple,
    block: Block,
    ks: float,
    hold: float,
) -> Triple:
    """Add the energies of a contact that slides; return its new stretch [m]; rub: friction [N]."""
    points = block.points
    old = 0.5 * points * ks * dot(spring, spring)
    was, spring = spring, add_scaled(NOWHERE, hold / ks, rub)
    jump = add_scaled(spring, -1.0, was)
    spent[LOST] += points * hold * dot(rub, jump)
    spent[LOST] += old - 0.5 * points * ks * dot(spring, spring)
    gained = -points * dot(rub, add_scaled(slip, -hold, jump))
    spent[RUBBED] -= gained
    spent[CREATED] += max(0.0, gained)
    spent[CARRIED] -= points * dot(rub, moved)
    return spring


@inlined
def add_opening_energies(spent: Vector, spring: Triple, points: int, ks: float) -> Triple:
    """Add the energy lost by a tangential spring when its contact opens; return zero stretch."""
    spent[LOST] += 0.5 * points * ks * dot(spring, spring)
    return NOWHERE


@inlined
def add_works(
    spent: Vector, block: Block, dd: float, d: Triple, new: Triple, shake: Triple
) -> None:
    """Add the work of gravity, loads and shaking over d [m], and the loss by kinetic damping.

    new: the velocity before damping [m/s].
    """
    mass = block.mass
    spent[FALLEN] += mass * dot(block.gravity, d)
    spent[WORKED] += dot(block.load, d)
    spent[SHAKEN] += mass * dot(shake, d)
    spent[DAMPED] += 0.5 * mass * (1.0 - dd * dd) * dot(new, new)


@inlined
def check_momentum(worst: Vector, gain: Triple, outer: Triple, pull: Triple, held: float) -> None:
    """Store the largest error of the momentum balance and the largest force [N].

    gain: rate of momentum; pull: force of contact; held: normal force of each of its points.
    """
    off = add_scaled(add_scaled(gain, -1.0, outer), -1.0, pull)
    worst[ADRIFT] = max(worst[ADRIFT], np.sqrt(dot(off, off)))
    peak = max(worst[PEAK], held, np.sqrt(dot(gain, gain)), np.sqrt(dot(outer, outer)))
    worst[PEAK] = peak


@inlined
def write_row(
    path: Vector, energy: Vector, row: int, block: Block, motion: Motion, origin: Triple,
    contact: Contact, friction: Friction | None, spent: Vector,
) -> float:  # fmt: skip
    """Fill a row of path and energy; return kinetic and elastic energy together [J]."""
    points, mass = block.points, block.mass
    moved = add_scaled(motion.x, -1.0, origin)
    apart = add_scaled(motion.x, -1.0, motion.shift)
    over = max(0.0, -(block.gap + dot(block.normal, apart)))
    for c in range(3):
        path[row, c], path[row, 3 + c] = moved[c], motion.v[c]
    for k in range(ENERGIES):
        energy[row, k] = spent[k]
    energy[row, KINETIC] = 0.5 * mass * dot(motion.v, motion.v)
    energy[row, NORMAL] = 0.5 * points * block.kn * over * over
    if friction is not None:
        spring = contact.spring
        energy[row, SHEAR] = 0.5 * points * friction.ks * dot(spring, spring)
    held: float = energy[row, KINETIC] + energy[row, NORMAL] + energy[row, SHEAR]
    return held
