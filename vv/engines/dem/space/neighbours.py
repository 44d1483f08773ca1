"""The neighbour search: pairs of spheres that may soon touch, found by cells; for kernels."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from vv.engines.dem.rows import Index
from vv.engines.dem.space.bodies import Motion
from vv.engines.kernels.arrays import (
    counts,
    larger,
    numbers,
    rows,
    smaller,
    table,
    zero_numbers,
    zero_rows,
)
from vv.engines.kernels.bundles import bundle
from vv.engines.kernels.compiled import called, inlined
from vv.engines.kernels.triples import add_scaled, at, dot, put
from vv.scene import Vector

State = npt.NDArray[np.uint8]
DASHPOT_COLUMNS, OVERLAP = (
    7,
    6,
)  # columns that dashpots store per contact, and the column of the overlap


@bundle
class Slots(NamedTuple):
    """Pairs of unbonded spheres near each other, with spare slots for pairs whose bond breaks.

    both: spheres i < j (k, 2); rows: their rows (k, 2); offset (k, 3) and gap (k,) at t = 0; radii
    (k, 2). Copied to the slots of the next search: shear (k, 3), the tangential force on the second
    sphere [N], and dashpots (k, 7), the data of dashpots (`vv.engines.dem.contact.dashpots`), (0,
    7) without them.
    """

    both: Index
    rows: Index
    offset: Vector
    gap: Vector
    radii: Vector
    shear: Vector
    dashpots: Vector


class Near(NamedTuple):
    """The n spheres that may touch, and the bonds that exclude pairs of them from contact.

    position (n, 3) at t = 0, radius (n,), row in u of each sphere (n,), skin [m]. The bonds are
    sorted by the first sphere: those of sphere i lead to partner[start[i]] up to partner[start[i +
    1]] (exclusive). broken: (b,) not 0 for broken bonds; empty if none can break. viscous: whether
    contacts are viscous.
    """

    position: Vector
    radius: Vector
    row: Index
    skin: float
    start: Index
    partner: Index
    broken: State
    viscous: bool


@called
def no_slots() -> Slots:
    """Slots without any pair."""
    none, three = integer_pairs(0), rows(0)
    return Slots(none, none, three, numbers(0), table(0, 2), three, table(0, DASHPOT_COLUMNS))


@called
def integer_pairs(n: int) -> Index:
    """An array for n pairs of integers."""
    return np.empty((n, 2), np.int64)


@called
def repeated(n: int, value: int) -> Index:
    """An array of n equal integers."""
    made = counts(n)
    for i in range(n):
        made[i] = value
    return made


@inlined
def moved_far(motion: Motion, since: Vector, near: Near) -> bool:
    """Whether a sphere has moved by over half the skin since its displacement `since` (m, 3)."""
    u, limit = motion.u, 0.25 * near.skin * near.skin
    for i in range(len(since)):
        d = add_scaled(at(u, i), -1.0, at(since, i))
        if dot(d, d) > limit:
            return True
    return False


@inlined
def store_displacements(since: Vector, u: Vector) -> None:
    """Store the displacements of the first len(since) rows of u."""
    for i in range(len(since)):
        put(since, i, at(u, i))


@called
def cells(place: Vector, edge: float) -> tuple[Index, Index, Index, Index]:
    """Sort spheres into cells at least `edge` [m] wide, but not many more cells than spheres.

    Returns the number of cells along each axis (3,), the indices of each sphere's cell (3 n,), the
    first sphere of each cell, and for each sphere the next one in its cell (n,), -1 for none.
    """
    n = len(place)
    most = 2 * int(n ** (1.0 / 3.0)) + 1
    count, cell, following = repeated(3, 1), counts(3 * n), counts(n)
    for c in range(3):
        low, high = place[0, c], place[0, c]
        for i in range(n):
            low, high = smaller(low, place[i, c]), larger(high, place[i, c])
        count[c] = larger(1, smaller(most, int((high - low) / edge)))
        for i in range(n):
            cell[3 * i + c] = 0
            if count[c] > 1:
                along = int((place[i, c] - low) / (high - low) * count[c])
                cell[3 * i + c] = smaller(count[c] - 1, along)
    first = repeated(count[0] * count[1] * count[2], -1)
    for i in range(n - 1, -1, -1):
        k = (cell[3 * i] * count[1] + cell[3 * i + 1]) * count[2] + cell[3 * i + 2]
        following[i], first[k] = first[k], i
    return count, cell, first, following


@inlined
def on_bond(i: int, j: int, start: Index, partner: Index, broken: State) -> bool:
    """Whether an unbroken bond joins the spheres i < j."""
    for b in range(start[i], start[i + 1]):
        if partner[b] == j:
            return len(broken) == 0 or broken[b] == 0
    return False


@called
def near_pairs(near: Near, u: Vector) -> Index:
    """The pairs (p, 2) of spheres i < j, sorted by i, whose gap is less than the skin.

    Left out are pairs joined by a bond, and pairs of spheres at rest, whose row is the last one.
    """
    position, radius, row, skin, start, partner, broken, _ = near
    n, ground, widest = len(radius), 0, 0.0
    place = rows(n)
    for i in range(n):
        put(place, i, add_scaled(at(position, i), 1.0, at(u, row[i])))
        ground, widest = larger(ground, row[i]), larger(widest, radius[i])
    count, cell, first, following = cells(place, 2.0 * widest + skin)
    found, many = integer_pairs(8 * n), 0
    for i in range(n):
        for x in neighbour_range(cell[3 * i], count[0]):
            for y in neighbour_range(cell[3 * i + 1], count[1]):
                for z in neighbour_range(cell[3 * i + 2], count[2]):
                    j = first[(x * count[1] + y) * count[2] + z]
                    while j >= 0:
                        if j > i and smaller(row[i], row[j]) < ground:
                            d = add_scaled(at(place, j), -1.0, at(place, i))
                            reach = radius[i] + radius[j] + skin
                            close = dot(d, d) < reach * reach
                            if close and not on_bond(i, j, start, partner, broken):
                                if many == len(found):
                                    found = doubled(found)
                                found[many, 0], found[many, 1] = i, j
                                many += 1
                        j = following[j]
    return found[:many]


@inlined
def neighbour_range(cell: int, count: int) -> range:
    """The indices of a cell and its two neighbours along an axis with `count` cells."""
    return range(larger(0, cell - 1), smaller(count, cell + 2))


@called
def doubled(found: Index) -> Index:
    """A copy of the pairs with twice the length; a slice would compile numba's error messages."""
    more = integer_pairs(2 * len(found))
    for k in range(len(found)):
        more[k, 0], more[k, 1] = found[k, 0], found[k, 1]
    return more


@called
def search_pairs(near: Near, u: Vector, old: Slots, many: Index) -> Slots:
    """The unbonded pairs near each other, with as many spare slots as there are bonds.

    old: the slots before, of which the first many[0] are in use. many[0] is set to how many of the
    new slots are in use. Stored numbers of pairs in both are copied.
    """
    position, radius, row = near[0], near[1], near[2]
    pairs = near_pairs(near, u)
    used, room = len(pairs), len(pairs) + len(near[5])
    both, held, radii = integer_pairs(room), integer_pairs(room), table(room, 2)
    offset, gap, shear = zero_rows(room), zero_numbers(room), zero_rows(room)
    dashpots = table(room if near.viscous else 0, DASHPOT_COLUMNS)
    for k in range(len(dashpots)):
        for c in range(DASHPOT_COLUMNS):
            dashpots[k, c] = np.inf
    last, earlier = repeated(len(radius), -1), counts(many[0])
    for k in range(many[0]):
        i = old.both[k, 0]
        earlier[k], last[i] = last[i], k
    for k in range(used):
        i, j = pairs[k, 0], pairs[k, 1]
        both[k, 0], both[k, 1], held[k, 0], held[k, 1] = i, j, row[i], row[j]
        radii[k, 0], radii[k, 1] = radius[i], radius[j]
        put(offset, k, add_scaled(at(position, j), -1.0, at(position, i)))
        gap[k] = math.sqrt(dot(at(offset, k), at(offset, k))) - radius[i] - radius[j]
        before = last[i]
        while before >= 0:
            if old.both[before, 1] == j:
                put(shear, k, at(old.shear, before))
                if near.viscous:
                    dashpots[k, OVERLAP] = old.dashpots[before, OVERLAP]
            before = earlier[before]
    many[0] = used
    return Slots(both, held, offset, gap, radii, shear, dashpots)
