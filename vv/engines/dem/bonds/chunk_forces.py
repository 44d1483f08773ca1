"""The forces of all bonds, chunk by chunk; parts of kernels.

Each chunk has its own array of forces; these are added in a fixed order, so that results do not
depend on the number of threads.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from vv.engines.dem.bonds.arrays import BREAKS, BondArrays
from vv.engines.dem.bonds.block_forces import add_block_forces, bonds_in, compute_block, gather_ends
from vv.engines.dem.bonds.blocks import HIT, WIDE
from vv.engines.dem.space.bodies import Motion
from vv.engines.kernels.compiled import lent
from vv.engines.kernels.triples import NOWHERE, put


@lent
def compute_chunk(bonds: BondArrays, c: int, motion: Motion, dt: float) -> None:
    """Compute the forces of the bonds in chunk c, in the rows of its window.

    What may be None is passed on beside the bundle: numba leaves out a branch where an argument is
    None, but not where a field is.
    """
    share, window, held, w = bonds.blocks.share, bonds.blocks.window, bonds.held, motion.w
    base: Any = np.uint64(c * (len(bonds.pushes) // len(held)))  # unsigned: numba tests signs
    for i in range(base + np.uint64(window[c, 0]), base + np.uint64(window[c, 1])):
        put(bonds.pushes, i, NOWHERE)
        if w is not None:
            put(bonds.torques, i, NOWHERE)
    normal, sheared, breaking = 0.0, 0.0, 0
    for k in range(share[c], share[c + 1]):
        gather_ends(bonds, c, k, motion, w)
        found = compute_block(bonds, c, k, dt, bonds.blocks.like, bonds.ks, w, bonds.frail)
        if found > 0:
            breaking += found
            for q in range(bonds_in(bonds, k)):
                if bonds.scratch[c, HIT * WIDE + q] > 0.0:
                    bonds.state[k, q] = BREAKS
        a, b = add_block_forces(bonds, c, k, base, bonds.ks, w)
        normal, sheared = normal + a, sheared + b
    held[c, 0], held[c, 1], held[c, 2] = normal, sheared, breaking


@lent
def compute_chunks(bonds: BondArrays, motion: Motion, dt: float) -> None:
    """Compute the forces of all chunks in turn, by `compute_chunk`."""
    for c in range(len(bonds.held)):
        compute_chunk(bonds, c, motion, dt)
