"""Kernels that write a row of results, and detect divergence."""

from __future__ import annotations

import numpy as np

from vv.engines.blocks.geometry import Index
from vv.engines.dda.general.bodies import Bodies, Motion, centre_displacement, fill_gradient
from vv.engines.dda.general.contact import Touch
from vv.engines.dda.general.energy import KINETIC, NORMAL, REPORTS, SHEAR, STRAIN, TERMS
from vv.engines.dda.general.setting import Work
from vv.engines.kernels.arrays import rows
from vv.engines.kernels.compiled import called, lent
from vv.engines.kernels.triples import NOWHERE, Triple, add_scaled, at, put
from vv.scene import Vector


@lent
def diverged(ledger: Vector, most: float) -> bool:
    """Whether kinetic and elastic energy together exceed `most` [J] or are not finite."""
    total = ledger[KINETIC] + ledger[NORMAL] + ledger[SHEAR] + ledger[STRAIN]
    return not (total <= most and total < np.inf)


@lent
def fill_forces(
    pressed: Vector, given: Vector, touch: Touch, bodies: Bodies, shake: Triple, step: float
) -> None:
    """Fill pressed (n, 3) with the forces of contacts and shaking on blocks in a step [N].

    Their impulses [N s] are added to given (n, 3).
    """
    for i in range(len(pressed)):
        put(pressed, i, add_scaled(NOWHERE, bodies.mass[i], shake))
    for k in range(len(touch.key)):
        two = touch.second[k]
        put(pressed, two, add_scaled(at(pressed, two), 1.0, at(touch.force, k)))
        if touch.wall[k] < 0:
            one = touch.first[k]
            put(pressed, one, add_scaled(at(pressed, one), -1.0, at(touch.force, k)))
    for i in range(len(pressed)):
        put(given, i, add_scaled(at(given, i), step, at(pressed, i)))


@called
def write_row(
    path: Vector, energy: Vector, report: Vector, watched: Index, work: Work, bodies: Bodies,
    motion: Motion,
) -> None:  # fmt: skip
    """Write a row: path (b, 21), energy (13,), report (10,)."""
    origin, pressed, given = work.origin, work.pressed, work.given
    tensor = rows(3)
    for b in range(len(watched)):
        i = watched[b]
        rate = centre_displacement(bodies, i, motion.velocity)
        fill_gradient(tensor, bodies, bodies.strains[i], bodies.start[i + 1], motion.strain)
        for c in range(3):
            path[b, c] = motion.centre[i, c] - origin[i, c] - motion.rounded[i, c]
            path[b, 3 + c] = rate[c]
            path[b, 15 + c], path[b, 18 + c] = pressed[i, c], given[i, c]
            for j in range(3):
                path[b, 6 + 3 * c + j] = tensor[c, j]
    for term in range(TERMS):
        energy[term] = work.ledger[term]
    for term in range(REPORTS):
        report[term] = work.worst[term]
