"""Finds the pairs of spheres that may soon touch, cell by cell, for kernels."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from vv.engines.dem.rows import Index
from vv.engines.dem.space.bodies import Motion
from vv.engines.kernels.bundles import bundle
from vv.engines.kernels.compiled import called, inlined, inlined_called
from vv.engines.kernels.triples import add_scaled, at, dot, put
from vv.scene import Vector

State = npt.NDArray[np.uint8]
MET, OVERLAP = 7, 6  # columns of what dashpots know of a contact, and that of its overlap


@bundle
class Slots(NamedTuple):
    """Pairs that are near each other and not held by a bond, and room for more.

    both: spheres i < j (k, 2); rows: theirs (k, 2); offset (k, 3) and gap (k,) at t = 0; radii
    (k, 2). Kept from slot to slot: shear, the force on the second sphere (k, 3), and met (k, 7),
    what dashpots know of the contact (`vv.engines.dem.terms.dashpots`); (0, 7) without them.
    """

    both: Index
    rows: Index
    offset: Vector
    gap: Vector
    radii: Vector
    shear: Vector
    met: Vector


class Near(NamedTuple):
    """All n spheres that may come to touch, and what keeps pairs of them from it.

    position (n, 3) at t = 0, radius (n,), row in u of each sphere (n,), skin [m], and the bonds by
    i: those of i go from start[i] on (n + 1,) to the spheres partner (b,); broken: (b,) not 0 for
    bonds that have parted; empty if none can. viscous: whether contacts are.
    """

    position: Vector
    radius: Vector
    row: Index
    skin: float
    start: Index
    partner: Index
    broken: State
    viscous: bool


@inlined_called
def no_slots() -> Slots:
    """No pairs yet."""
    none = np.zeros((0, 2), np.intp)
    one, three, met = np.zeros(0), np.zeros((0, 3)), np.zeros((0, MET))
    return Slots(none, none, three, one, np.zeros((0, 2)), three, met)


@inlined
def strayed(motion: Motion, since: Vector, near: Near) -> bool:
    """Whether some sphere has moved by half the skin [m] since it was at `since` (m, 3)."""
    u, limit = motion.u, 0.25 * near.skin * near.skin
    for i in range(len(since)):
        d = add_scaled(at(u, i), -1.0, at(since, i))
        if dot(d, d) > limit:
            return True
    return False


@inlined_called
def cells(place: Vector, edge: float) -> tuple[Index, Index, Index, Index]:
    """Sort spheres into cells at least `edge` [m] wide, but never many more than spheres.

    Returns the cells along each axis (3,), where each sphere is among them (n, 3), the first
    sphere of each cell, and the next in its cell after each sphere (n,), -1 for none.
    """
    n = len(place)
    most = 2 * int(n ** (1.0 / 3.0)) + 1
    count, cell, following = np.ones(3, np.intp), np.zeros((n, 3), np.intp), np.empty(n, np.intp)
    for c in range(3):
        low, high = place[0, c], place[0, c]
        for i in range(n):
            low, high = min(low, place[i, c]), max(high, place[i, c])
        count[c] = max(1, min(most, int((high - low) / edge)))
        for i in range(n):
            if count[c] > 1:
                cell[i, c] = min(count[c] - 1, int((place[i, c] - low) / (high - low) * count[c]))
    first = np.full(count[0] * count[1] * count[2], -1, np.intp)
    for i in range(n - 1, -1, -1):
        k = (cell[i, 0] * count[1] + cell[i, 1]) * count[2] + cell[i, 2]
        following[i], first[k] = first[k], i
    return count, cell, first, following


@inlined
def on_bond(i: int, j: int, start: Index, partner: Index, broken: State) -> bool:
    """Whether a whole bond holds the spheres i < j."""
    for b in range(start[i], start[i + 1]):
        if partner[b] == j:
            return len(broken) == 0 or broken[b] == 0
    return False


@called
def swept(near: Near, u: Vector) -> Index:
    """(p, 2) the pairs of spheres i < j without a bond whose gap is less than the skin, by i.

    Pairs of spheres that both stay in place, in the last of the spheres' rows, are left out.
    """
    position, radius, row, skin, start, partner, broken, _ = near
    n, ground, widest = len(radius), 0, 0.0
    place = np.empty((n, 3))
    for i in range(n):
        put(place, i, add_scaled(at(position, i), 1.0, at(u, row[i])))
        ground, widest = max(ground, row[i]), max(widest, radius[i])
    count, cell, first, following = cells(place, 2.0 * widest + skin)
    found, many = np.empty((8 * n, 2), np.intp), 0
    for i in range(n):
        for x in range(max(0, cell[i, 0] - 1), min(count[0], cell[i, 0] + 2)):
            for y in range(max(0, cell[i, 1] - 1), min(count[1], cell[i, 1] + 2)):
                for z in range(max(0, cell[i, 2] - 1), min(count[2], cell[i, 2] + 2)):
                    j = first[(x * count[1] + y) * count[2] + z]
                    while j >= 0:
                        if j > i and min(row[i], row[j]) < ground:
                            d = add_scaled(at(place, j), -1.0, at(place, i))
                            reach = radius[i] + radius[j] + skin
                            close = dot(d, d) < reach * reach
                            if close and not on_bond(i, j, start, partner, broken):
                                if many == len(found):
                                    more = np.empty((2 * many, 2), np.intp)
                                    more[:many] = found
                                    found = more
                                found[many, 0], found[many, 1] = i, j
                                many += 1
                        j = following[j]
    return found[:many]


@called
def gathered(near: Near, u: Vector, old: Slots, many: Index) -> Slots:
    """The pairs near each other and not held by a bond, with room for as many as have bonds.

    old: the slots before, the first many[0] of them used; many is set to how many are used now.
    """
    position, radius, row = near[0], near[1], near[2]
    pairs = swept(near, u)
    used, room = len(pairs), len(pairs) + len(near[5])
    both, rows, radii = (
        np.zeros((room, 2), np.intp),
        np.zeros((room, 2), np.intp),
        np.zeros((room, 2)),
    )
    offset, gap, shear = np.zeros((room, 3)), np.zeros(room), np.zeros((room, 3))
    met = np.full((room if near.viscous else 0, MET), np.inf)
    last, earlier = np.full(len(radius), -1, np.intp), np.empty(many[0], np.intp)
    for k in range(many[0]):
        i = old.both[k, 0]
        earlier[k], last[i] = last[i], k
    for k in range(used):
        i, j = pairs[k, 0], pairs[k, 1]
        both[k, 0], both[k, 1], rows[k, 0], rows[k, 1] = i, j, row[i], row[j]
        radii[k, 0], radii[k, 1] = radius[i], radius[j]
        put(offset, k, add_scaled(at(position, j), -1.0, at(position, i)))
        gap[k] = math.sqrt(dot(at(offset, k), at(offset, k))) - radius[i] - radius[j]
        before = last[i]
        while before >= 0:
            if old.both[before, 1] == j:
                put(shear, k, at(old.shear, before))
                if near.viscous:
                    met[k, OVERLAP] = old.met[before, OVERLAP]
            before = earlier[before]
    many[0] = used
    return Slots(both, rows, offset, gap, radii, shear, met)
