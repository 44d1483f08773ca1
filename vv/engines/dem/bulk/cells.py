"""Sorts the spheres of the bulk model by the cells in which they lie."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vv.engines.dem.bulk.grains import WIDE, Grains, Short
from vv.engines.kernels.bundles import bundle
from vv.engines.kernels.compiled import called
from vv.engines.kernels.triples import Triple, at, put
from vv.scene import Vector

WIDER = 1.25  # factor by which cells grow until there are few enough


@bundle
class Cells(NamedTuple):
    """nx by ny by nz cells, x fastest: cell c has spheres begin[c] to begin[c + 1] (exclusive).

    place (n,): the new number of each sphere, by its old number.
    """

    nx: int
    ny: int
    nz: int
    begin: Short
    place: Short


@called
def cells(grains: Grains, edge: float) -> Cells:
    """Sort spheres into cells at least `edge` [m] wide, but not many more cells than spheres."""
    row, n = grains.row, len(grains.mass)
    low, high = bounding_box(row, n)
    nx, ny, nz = cell_counts(low, high, edge)
    while nx * ny * nz > 4 * n + 64:
        edge *= WIDER
        nx, ny, nz = cell_counts(low, high, edge)
    begin, cell, place = (
        np.zeros(nx * ny * nz + 2, np.uint32),
        np.empty(n, np.uint32),
        np.empty(n, np.uint32),
    )
    for i in range(n):
        x = min(nx - 1, int((row[i, 0] - low[0]) / (high[0] - low[0]) * nx)) if nx > 1 else 0
        y = min(ny - 1, int((row[i, 1] - low[1]) / (high[1] - low[1]) * ny)) if ny > 1 else 0
        z = min(nz - 1, int((row[i, 2] - low[2]) / (high[2] - low[2]) * nz)) if nz > 1 else 0
        cell[i] = (z * ny + y) * nx + x
        begin[cell[i] + 2] += 1
    for c in range(nx * ny * nz):
        begin[c + 2] += begin[c + 1]
    for i in range(n):
        place[i] = begin[cell[i] + 1]
        begin[cell[i] + 1] += 1
    renumber(grains, place)
    return Cells(nx, ny, nz, begin, place)


@called
def bounding_box(row: Vector, n: int) -> tuple[Triple, Triple]:
    """The lowest and the highest coordinates of the first n rows [m]."""
    low, high = at(row, 0), at(row, 0)
    for i in range(1, n):
        x, y, z = at(row, i)
        low = min(low[0], x), min(low[1], y), min(low[2], z)
        high = max(high[0], x), max(high[1], y), max(high[2], z)
    return low, high


@called
def cell_counts(low: Triple, high: Triple, edge: float) -> tuple[int, int, int]:
    """The numbers of cells along the axes, each at least `edge` [m] wide."""
    return (
        max(1, int((high[0] - low[0]) / edge)),
        max(1, int((high[1] - low[1]) / edge)),
        max(1, int((high[2] - low[2]) / edge)),
    )


@called
def renumber(grains: Grains, place: Short) -> None:
    """Renumber the spheres, and store their positions in `since`."""
    row, mass, inertia, original = grains.row, grains.mass, grains.inertia, grains.original
    n = len(place)
    rows, others, numbers = np.empty((n, WIDE)), np.empty((n, 2)), np.empty(n, np.uint32)
    for i in range(n):
        for c in range(WIDE):
            rows[i, c] = row[i, c]
        others[i, 0], others[i, 1], numbers[i] = mass[i], inertia[i], original[i]
    for i in range(n):
        to = place[i]
        for c in range(WIDE):
            row[to, c] = rows[i, c]
        mass[to], inertia[to], original[to] = others[i, 0], others[i, 1], numbers[i]
        put(grains.since, to, at(rows, i))
