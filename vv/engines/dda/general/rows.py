"""Kernels that write down a row of what DDA has come to, and see that it has run away."""

from __future__ import annotations

import numpy as np

from vv.engines.blocks.geometry import Index
from vv.engines.dda.general.bodies import Bodies, Motion, gradient, travelled
from vv.engines.dda.general.energy import KINETIC, NORMAL, REPORTS, SHEAR, STRAIN, TERMS
from vv.engines.kernels.arrays import rows
from vv.engines.kernels.compiled import called, lent
from vv.scene import Vector


@lent
def lost(ledger: Vector, most: float) -> bool:
    """Whether motion, springs and strains hold more than `most` [J], or no finite energy."""
    total = ledger[KINETIC] + ledger[NORMAL] + ledger[SHEAR] + ledger[STRAIN]
    return not (total <= most and total < np.inf)


@called
def note(
    path: Vector, energy: Vector, report: Vector, watched: Index, origin: Vector,
    bodies: Bodies, motion: Motion, ledger: Vector, worst: Vector,
) -> None:  # fmt: skip
    """Write a row: path (b, 15), energy (13,) and report (9,)."""
    tensor = rows(3)
    for b in range(len(watched)):
        i = watched[b]
        rate = travelled(bodies, i, motion.velocity)
        gradient(tensor, bodies, bodies.strains[i], bodies.start[i + 1], motion.strain)
        for c in range(3):
            path[b, c] = motion.centre[i, c] - origin[i, c] - motion.rounded[i, c]
            path[b, 3 + c] = rate[c]
            for j in range(3):
                path[b, 6 + 3 * c + j] = tensor[c, j]
    for term in range(TERMS):
        energy[term] = ledger[term]
    for term in range(REPORTS):
        report[term] = worst[term]
