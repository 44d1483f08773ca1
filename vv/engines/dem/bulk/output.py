"""The output of the bulk kernel: the path of the observed spheres, and the energies."""

from __future__ import annotations

import numpy as np

from vv.engines.dem.bulk.grains import BEFORE, SPUN, Given, Grains, V, W, moving_mass
from vv.engines.dem.rows import Index
from vv.engines.dem.space.ledger import column
from vv.engines.kernels.compiled import called, lent
from vv.engines.kernels.triples import Triple
from vv.scene import Form, Vector

GRAVITY = column(Form.GRAVITY)


@called
def observe(path: Vector, line: int, watched: Index, given: Given, grains: Grains) -> None:
    """Fill a line of path (k, b, 6 or 9): displacement, mean velocity and, if any, mean spin."""
    row, place = grains.row, np.empty(len(grains.mass), np.uint32)
    for i in range(len(place)):
        place[grains.original[i]] = i
    for k in range(len(watched)):
        i = place[watched[k]]
        for c in range(3):
            path[line, k, c] = row[i, c] - given.position[watched[k], c]
            path[line, k, 3 + c] = 0.5 * (row[i, BEFORE + c] + row[i, V + c])
            if path.shape[2] > 6:
                path[line, k, 6 + c] = 0.5 * (row[i, SPUN + c] + row[i, W + c])


@lent
def write_energies(
    energy: Vector,
    line: int,
    held: tuple[float, float, float, float, float],
    given: Given,
    grains: Grains,
    gravity: Triple,
) -> float:
    """Fill a line of energy (k, 7) [J]; return the work of gravity [J].

    held: m v- v+/2 and I w- w+/2, normal springs, tangential springs, dissipated by friction,
    dissipated by drag and viscous contacts.
    """
    work = 0.0
    for i in range(len(grains.mass)):
        for c in range(3):
            u = grains.row[i, c] - given.position[grains.original[i], c]
            work += moving_mass(grains.mass[i]) * gravity[c] * u
    for c in range(5):
        energy[line, c] = held[c]
    energy[line, GRAVITY] = work
    return work
