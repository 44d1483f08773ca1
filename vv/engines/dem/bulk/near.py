"""The search for spheres and walls that may soon touch, by cells; stored friction is copied."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vv.engines.dem.bulk.cells import Cells
from vv.engines.dem.bulk.grains import RADIUS, Flags, Grains, Short
from vv.engines.kernels.bundles import bundle
from vv.engines.kernels.compiled import called, inlined, inlined_called
from vv.engines.kernels.triples import NOWHERE, add_scaled, at, dot, put
from vv.scene import Vector


@bundle
class Near(NamedTuple):
    """Slots for contacts that may close; sphere i has start[i] to start[i + 1] (exclusive).

    one, other (k,): spheres i < j of a pair, or a sphere and a wall. touching (k,): whether they
    touched after the last step; shear (k, 3): the tangential force [N] on the second sphere, or on
    the sphere at a wall, if they touch; both are empty without friction.
    """

    start: Short
    one: Short
    other: Short
    touching: Flags
    shear: Vector


@inlined_called
def no_contacts(n: int) -> Near:
    """Slots for n spheres without any contact."""
    start, none = np.zeros(n + 1, np.uint32), np.zeros(0, np.uint32)
    return Near(start, none, none, np.zeros(0, np.uint8), np.zeros((0, 3)))


@inlined
def within_skin(row: Vector, i: int, j: int, skin: float) -> bool:
    """Whether the gap of two spheres is less than the skin [m]."""
    d, reach = add_scaled(at(row, j), -1.0, at(row, i)), row[i, RADIUS] + row[j, RADIUS] + skin
    return bool(dot(d, d) < reach * reach)


@called
def extended(other: Short, used: int, room: int) -> Short:
    """A copy with room for more numbers."""
    made = np.empty(room, np.uint32)
    for k in range(used):
        made[k] = other[k]
    return made


@called
def near_pairs(grains: Grains, cells: Cells, skin: float, old: Near, rubs: bool) -> Near:
    """The pairs whose gap is less than the skin [m], with the tangential forces of the old slots.

    Pairs of two fixed spheres are left out.
    """
    mass, row, begin, many, nx, ny, nz = (
        grains.mass,
        grains.row,
        cells.begin,
        0,
        cells.nx,
        cells.ny,
        cells.nz,
    )
    n = len(grains.mass)
    start, other = np.zeros(n + 1, np.uint32), np.empty(max(len(old.other), 8 * n), np.uint32)
    for cell in range(nx * ny * nz):
        x, y, z = cell % nx, cell // nx % ny, cell // (nx * ny)
        for i in range(begin[cell], begin[cell + 1]):
            # the rest of this line of cells, and the four neighbouring lines after it
            for line in range(5):
                ahead = y + 1 if line == 1 else y if line == 0 else y + line - 3
                above = z + 1 if line > 1 else z
                if ahead < 0 or ahead >= ny or above >= nz:
                    continue
                base = (above * ny + ahead) * nx
                first = begin[base + max(x - 1, 0)] if line > 0 else i + 1
                for j in range(first, begin[base + min(x + 1, nx - 1) + 1]):
                    if within_skin(row, i, j, skin) and (mass[i] < np.inf or mass[j] < np.inf):
                        if many == len(other):
                            other = extended(other, many, 2 * many)
                        other[many] = j
                        many += 1
            start[i + 1] = many
    made = new_slots(start, extended(other, many, many), rubs)
    copy_friction(made, old, cells.place, True)
    return made


@called
def near_walls(
    grains: Grains, walls: Vector, cells: Cells, skin: float, old: Near, rubs: bool
) -> Near:
    """As `near_pairs`, for walls (w, 4): outward normals and distances from the origin [m]."""
    row, mass, n, many = grains.row, grains.mass, len(grains.mass), 0
    start, other = np.zeros(n + 1, np.uint32), np.empty(n + len(walls), np.uint32)
    for i in range(n):
        for w in range(len(walls) if mass[i] < np.inf else 0):
            if dot(at(row, i), at(walls, w)) - walls[w, 3] < row[i, RADIUS] + skin:
                if many == len(other):
                    other = extended(other, many, 2 * many)
                other[many] = w
                many += 1
        start[i + 1] = many
    made = new_slots(start, extended(other, many, many), rubs)
    copy_friction(made, old, cells.place, False)
    return made


@called
def new_slots(start: Short, other: Short, rubs: bool) -> Near:
    """Slots of contacts that did not touch before."""
    room, one = len(other) if rubs else 0, np.empty(len(other), np.uint32)
    for i in range(len(start) - 1):
        for k in range(start[i], start[i + 1]):
            one[k] = i
    return Near(start, one, other, np.zeros(room, np.uint8), np.zeros((room, 3)))


@called
def copy_friction(made: Near, old: Near, place: Short, pairs: bool) -> None:
    """Copy the tangential forces of touching contacts to the new slots.

    place (n,): new numbers of the spheres by old ones. The force on the second sphere of a pair
    changes sign if the spheres have changed their order.
    """
    start, other, touching, shear = made.start, made.other, made.touching, made.shear
    for i in range(len(place) if len(old.touching) > 0 else 0):
        for k in range(old.start[i], old.start[i + 1]):
            if old.touching[k]:
                a, b, sign = place[i], old.other[k], 1.0
                if pairs:
                    b = place[b]
                    if b < a:
                        a, b, sign = b, a, -1.0
                for q in range(start[a], start[a + 1]):
                    if other[q] == b:
                        touching[q] = 1
                        put(shear, q, add_scaled(NOWHERE, sign, at(old.shear, k)))
