"""Kernels that write down a row of what DDA has come to, and see that it has run away."""

from __future__ import annotations

import numpy as np

from vv.blocks.dda_bodies import Bodies, Motion, travelled
from vv.blocks.dda_energy import KINETIC, NORMAL, REPORTS, SHEAR, STRAIN, TERMS
from vv.blocks.geometry import Index
from vv.compiled import called
from vv.scene import Vector


@called
def lost(ledger: Vector, most: float) -> bool:
    """Whether motion, springs and strains hold more than `most` [J], or no finite energy."""
    total = ledger[KINETIC] + ledger[NORMAL] + ledger[SHEAR] + ledger[STRAIN]
    return not (total <= most and total < np.inf)


@called
def note(
    path: Vector, energy: Vector, report: Vector, watched: Index, origin: Vector,
    bodies: Bodies, motion: Motion, ledger: Vector, worst: Vector,
) -> None:  # fmt: skip
    """Write a row: path (b, 6), energy (13,) and report (9,)."""
    for b in range(len(watched)):
        rate = travelled(bodies, watched[b], motion.velocity)
        for c in range(3):
            path[b, c] = motion.centre[watched[b], c] - origin[watched[b], c]
            path[b, 3 + c] = rate[c]
    for term in range(TERMS):
        energy[term] = ledger[term]
    for term in range(REPORTS):
        report[term] = worst[term]
