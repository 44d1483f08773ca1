"""Gathers the data of contacts in scratch, and adds their forces to the spheres."""

from __future__ import annotations

from vv.engines.dem.bonds.block_forces import store_vector, vector_of
from vv.engines.dem.bonds.blocks import WIDE
from vv.engines.dem.bulk.grains import (
    BEFORE,
    RADIUS,
    TURN,
    Grains,
    Short,
    V,
    W,
    columns_of,
    set_columns,
)
from vv.engines.dem.bulk.near import Near
from vv.engines.kernels.compiled import inlined
from vv.engines.kernels.prefetch import begin_to_read
from vv.engines.kernels.triples import NOWHERE, Triple, add_scaled, at, dot, put
from vv.scene import Vector

TOGETHER = 8  # the largest number of contacts that one vector instruction computes
SOON = 24  # how many pairs ahead rows are loaded into the cache
OFFSET, RADII, WAS, RELATIVE, ROLLED, SPINS, SPRING, CHANGED = 0, 3, 5, 6, 9, 12, 15, 18
NORMALS, ALONG, MIDWAY, SLIDE, ACROSS, OLD, STIFF, CAPS, HOW_LONG = 0, 5, 6, 9, 12, 15, 18, 19, 21
INSIDE, ARMS, TRIAL, MORE, TURNS, FADING, TAKEN, FORCE, TORQUE = 22, 23, 25, 28, 31, 32, 31, 6, 9
"""Places of the numbers of a contact in scratch: the data of `gather_motion`, and later results.

All must fit into the first cache beside the data of the spheres. OFFSET: from the first centre to
the second; WAS: whether they touched before, 1 or 0; ROLLED: the sum of radius times spin; SPINS:
the sum of spins; HOW_LONG: for how long they touched in the step [s]; INSIDE: the depth of the
contact point below each surface at the middle of the step [m].
"""


@inlined
def choose_touching(
    grains: Grains,
    pairs: Near,
    scratch: Vector,
    ends: Short,
    c: int,
    some: tuple[int, int],
    friction: tuple[float, float] | None,
) -> int:
    """Put touching pairs among some[0] to some[1] into scratch, branchless; return how many."""
    row, acting = grains.row, grains.acting
    one, other, touching, many = pairs.one, pairs.other, pairs.touching, 0
    end = len(other) - 1
    for k in range(some[0], some[1]):
        soon = other[min(k + SOON, end)]
        begin_to_read(row, soon, 0)
        begin_to_read(row, soon, 8)
        begin_to_read(acting, soon, 0)
        i, j = one[k], other[k]
        d, reach = add_scaled(at(row, j), -1.0, at(row, i)), row[i, RADIUS] + row[j, RADIUS]
        store_vector(scratch, c, OFFSET, many, d)
        scratch[c, RADII * WIDE + many] = row[i, RADIUS]
        scratch[c, (RADII + 1) * WIDE + many] = row[j, RADIUS]
        ends[c, many], ends[c, WIDE + many], ends[c, 2 * WIDE + many] = i, j, k
        touch = dot(d, d) < reach * reach
        if friction is not None:
            scratch[c, WAS * WIDE + many] = touching[k]
            touching[k] = touch
        many += touch
    return many


@inlined
def rounded_up(many: int) -> int:
    """The number of columns, rounded up to whole vector instructions.

    The results in the extra columns are not used; a loop over single contacts would be slower.
    """
    return -(-many // TOGETHER) * TOGETHER


@inlined
def gather_motion(
    row: Vector,
    pairs: Near,
    scratch: Vector,
    ends: Short,
    c: int,
    many: int,
    friction: tuple[float, float] | None,
    viscous: float | None,
) -> None:
    """Copy the relative motion and the tangential forces of the chosen pairs to scratch."""
    if friction is not None:
        shear = pairs.shear
        for q in range(many):
            i, j, k = ends[c, q], ends[c, WIDE + q], ends[c, 2 * WIDE + q]
            store_vector(
                scratch,
                c,
                RELATIVE,
                q,
                add_scaled(columns_of(row, j, V), -1.0, columns_of(row, i, V)),
            )
            w, v = columns_of(row, i, W), columns_of(row, j, W)
            rolled = add_scaled(add_scaled(NOWHERE, row[i, RADIUS], w), row[j, RADIUS], v)
            store_vector(scratch, c, ROLLED, q, rolled)
            store_vector(scratch, c, SPINS, q, add_scaled(w, 1.0, v))
            was = scratch[c, WAS * WIDE + q]
            store_vector(scratch, c, SPRING, q, add_scaled(NOWHERE, was, at(shear, k)))
            if viscous is not None:
                store_vector(scratch, c, CHANGED, q, velocity_change(row, i, j))


@inlined
def velocity_change(row: Vector, i: int, j: int) -> Triple:
    """The change of the relative velocity of centres i and j since the last step [m/s]."""
    now = add_scaled(columns_of(row, j, V), -1.0, columns_of(row, i, V))
    return add_scaled(
        now, -1.0, add_scaled(columns_of(row, j, BEFORE), -1.0, columns_of(row, i, BEFORE))
    )


@inlined
def add_forces(
    grains: Grains,
    pairs: Near,
    scratch: Vector,
    ends: Short,
    c: int,
    many: int,
    beyond: tuple[int, int],
    friction: tuple[float, float] | None,
) -> None:
    """Add the forces of the chosen pairs to the spheres, and store the tangential ones."""
    acting, shear = grains.acting, pairs.shear
    for q in range(many):
        i, j = ends[c, q], ends[c, WIDE + q]
        to = j + (beyond[1] if j >= beyond[0] else 0)
        force = vector_of(scratch, c, FORCE, q)
        put(acting, i, add_scaled(at(acting, i), -1.0, force))
        put(acting, to, add_scaled(at(acting, to), 1.0, force))
        if friction is not None:
            put(shear, ends[c, 2 * WIDE + q], vector_of(scratch, c, ACROSS, q))
            torque = vector_of(scratch, c, TORQUE, q)
            first, second = scratch[c, ARMS * WIDE + q], scratch[c, (ARMS + 1) * WIDE + q]
            set_columns(acting, i, TURN, add_scaled(columns_of(acting, i, TURN), first, torque))
            set_columns(acting, to, TURN, add_scaled(columns_of(acting, to, TURN), second, torque))
